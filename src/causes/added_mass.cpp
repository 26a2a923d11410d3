// `added_mass`: a small body on the cable that its `masses` do not name, to be found.
#include "cosserat_cable/cable/cable_key_specs.h"
#include "cosserat_cable/causes/cause.h"
#include "cosserat_cable/input/number_text.h"

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
  const auto mark = key.marks.front().find("s");
  problems->Add(mark == key.marks.front().end() ? key.mark : mark->second,
                "got " + FormatNumber(s->second) +
                    ", expected an arc length on the cable, at most " +
                    FormatNumber(*cable.length.value) + " m");
}

}  // namespace

Cause AddedMassCause() {
  Cause cause;
  ExtensionLaw& law = cause.law.emplace();
  law.name = "added_mass";
  law.shape = "a body {s: ..., mass: ...}";
  law.fields = {{"s", "m", ArcLengthSpec()},
                {"mass", "kg", NumberSpec::AtLeast(0, "kg").AtMost(100).Hint("is it in g?")}};
  law.check = Check;
  law.enter = Enter;
  cause.name = law.name;
  cause.words = "a lumped mass that the model does not have";
  using Role = HypothesisNumber::Role;
  for (const double s : {0.25, 0.5, 0.75, 1.0})
    cause.hypotheses.push_back(
        {{{{"extensions.added_mass.mass"},
           {"extensions.added_mass.s", Role::kFree, s, NumberScale::kLength}}}});
  return cause;
}

}  // namespace cosserat_cable
