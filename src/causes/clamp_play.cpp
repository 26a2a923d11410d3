// `clamp_play`: clamps in which the cable's end is loose in bending.
#include "cosserat_cable/rod/clamp_play.h"

#include "clamp_fields.h"
#include "cosserat_cable/causes/cause.h"

namespace cosserat_cable {
namespace {

void Enter(const CableExtension& extension, rod::RodModel* rod) {
  ForEachClamp(extension, rod, [](rod::EndModel* end, const ClampNumbers& of) {
    if (of("gap") == 0) return;
    for (const int axis : {0, 1}) end->rotation[axis] = false;
    end->laws.push_back(std::make_shared<rod::ClampPlay>(of("gap"), of("stiffness")));
  });
}

}  // namespace

Cause ClampPlayCause() {
  using Need = ExtensionField::Need;
  Cause cause;
  ExtensionLaw& law = cause.law.emplace();
  law.name = "clamp_play";
  law.shape = "clamps {a: {gap: ..., stiffness: ...}, b: ...}";
  for (const std::string clamp : {"a.", "b."}) {
    law.fields.push_back({clamp + "gap", "rad",
                          NumberSpec::AtLeast(0, "rad").AtMost(1.5).Hint("is it in degrees?"),
                          Need::kInGroup});
    law.fields.push_back({clamp + "stiffness", "N m/rad",
                          NumberSpec::Above(0, "N m/rad").AtMost(1e9), Need::kInGroup});
  }
  law.enter = Enter;
  cause.name = law.name;
  cause.words = "backlash at a clamp";
  using Role = HypothesisNumber::Role;
  for (const std::string clamp : {"a.", "b."})
    cause.hypotheses.push_back({{{{"extensions.clamp_play." + clamp + "gap", Role::kSize, 0.1},
                                  {"extensions.clamp_play." + clamp + "stiffness", Role::kBeside,
                                   200, NumberScale::kClampBending}}}});
  for (const std::string clamp : {"a.", "b."})
    for (const double gap : {0.03, 0.1, 0.3})
      for (const double stiffness : {1.5, 4.0, 16.0})
        cause.from_simpler.push_back(
            {{{{"extensions.clamp_play." + clamp + "gap", Role::kFree, gap,
                NumberScale::kSimplerAngle},
               {"extensions.clamp_play." + clamp + "stiffness", Role::kFree, stiffness,
                NumberScale::kSimplerStiffness}}}});
  cause.contains = {"clamp_compliance"};
  return cause;
}

}  // namespace cosserat_cable
