// The register of extensions: a line to declare each, and one to list it.
#include "extension_law.h"

namespace cosserat_cable {

ExtensionLaw MaxwellLaw();
ExtensionLaw ClampComplianceLaw();
ExtensionLaw ClampDampingLaw();
ExtensionLaw ClampFrictionLaw();
ExtensionLaw ClampPlayLaw();
ExtensionLaw AirDragLaw();
ExtensionLaw ExternalDampingLaw();
ExtensionLaw AddedMassLaw();
ExtensionLaw ContactExtensionLaw();

const std::vector<ExtensionLaw>& ExtensionLaws() {
  static const std::vector<ExtensionLaw> laws = {
      MaxwellLaw(), ClampComplianceLaw(), ClampDampingLaw(), ClampFrictionLaw(),    ClampPlayLaw(),
      AirDragLaw(), ExternalDampingLaw(), AddedMassLaw(),    ContactExtensionLaw(),
  };
  return laws;
}

}  // namespace cosserat_cable
