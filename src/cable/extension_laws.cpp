// The register of extensions: a line to declare each, and one to list it.
#include <stdexcept>

#include "extension_law.h"

namespace cosserat_cable {

ExtensionLaw MaxwellLaw();
ExtensionLaw ClampComplianceLaw();
ExtensionLaw ClampDampingLaw();
ExtensionLaw DriftLaw();

const std::vector<ExtensionLaw>& ExtensionLaws() {
  static const std::vector<ExtensionLaw> laws = {
      MaxwellLaw(),
      ClampComplianceLaw(),
      ClampDampingLaw(),
      DriftLaw(),
  };
  return laws;
}

const ExtensionLaw& LawOf(const CableExtension& extension) {
  for (const ExtensionLaw& law : ExtensionLaws())
    if (law.name == extension.name) return law;
  throw std::invalid_argument("a cable cannot have the extension '" + extension.name + "'");
}

std::vector<std::string> NumberPaths(const ExtensionField& field) {
  if (!field.pair) return {field.path};
  return {field.path + "1", field.path + "2"};
}

}  // namespace cosserat_cable
