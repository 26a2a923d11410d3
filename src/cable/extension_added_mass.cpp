// `added_mass`: a small body on the cable that its `masses` do not name, to be found.
#include "cable_key_specs.h"
#include "cosserat_cable/input/number_text.h"
#include "extension_law.h"

namespace cosserat_cable {
namespace {

void Enter(const CableExtension& extension, rod::RodModel* rod) {
  const auto& body = extension.parts.front();
  if (body.at("mass") == 0) return;
  rod->bodies.push_back({body.at("s"), body.at("mass")});
}

void Check(const ExtensionKey& key, const CableKeys& cable, Problems* problems) {
  const auto& body = key.extension.parts.front();
  const auto s = body.find("s");
  if (s == body.end() || !cable.length.value || s->second <= *cable.length.value) return;
  problems->Add(key.marks.front().at("s"), "got " + FormatNumber(s->second) +
                                               ", expected an arc length on the cable, at most " +
                                               FormatNumber(*cable.length.value) + " m");
}

}  // namespace

ExtensionLaw AddedMassExtension() {
  ExtensionLaw law;
  law.name = "added_mass";
  law.shape = "a body {s: ..., mass: ...}";
  law.fields = {{"s", "m", ArcLengthSpec()},
                {"mass", "kg", NumberSpec::AtLeast(0, "kg").AtMost(100).Hint("is it in g?")}};
  law.check = Check;
  law.enter = Enter;
  return law;
}

}  // namespace cosserat_cable
