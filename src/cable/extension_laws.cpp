// The register of extensions: a line to declare each, and one to list it.
#include "extension_law.h"

namespace cosserat_cable {

ExtensionLaw MaxwellLaw();
ExtensionLaw ClampComplianceLaw();
ExtensionLaw ClampDampingLaw();

const std::vector<ExtensionLaw>& ExtensionLaws() {
  static const std::vector<ExtensionLaw> laws = {
      MaxwellLaw(),
      ClampComplianceLaw(),
      ClampDampingLaw(),
  };
  return laws;
}

}  // namespace cosserat_cable
