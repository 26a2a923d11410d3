// `clamp_friction`: clamps that turn in bending or in torsion against a spring and a dry friction;
// a disc whose bearing rubs.
#include "cosserat_cable/rod/clamp_friction.h"

#include "clamp_fields.h"
#include "cosserat_cable/causes/cause.h"

namespace cosserat_cable {
namespace {

using About = rod::ClampFriction::About;

// The maps of the law: in bending a and b, about a3 these.
constexpr const char* kTorsionOfA = "a_torsion";
constexpr const char* kTorsionOfB = "b_torsion";

void Rub(const ClampNumbers& of, About about, rod::EndModel* end) {
  const double stuck = of("stuck"), slip_moment = of("slip_moment"), spring = of("spring");
  const bool rubs = stuck > 0 && slip_moment > 0;
  if (!rubs && spring == 0) return;
  for (const int axis : {0, 1, 2}) {
    if ((axis == 2) != (about == About::kTorsion)) continue;
    end->rotation[axis] = false;
    end->stiffness[axis] += spring;
  }
  if (rubs) end->laws.push_back(std::make_shared<rod::ClampFriction>(stuck, slip_moment, about));
}

void Enter(const CableExtension& extension, rod::RodModel* rod) {
  ForEachClamp(extension, rod,
               [](rod::EndModel* end, const ClampNumbers& of) { Rub(of, About::kBending, end); });
  ForEachGroup(extension, {{kTorsionOfA, &rod->a}, {kTorsionOfB, &rod->b}},
               [](rod::EndModel* end, const ClampNumbers& of) { Rub(of, About::kTorsion, end); });
}

}  // namespace

Cause ClampFrictionCause() {
  using Need = ExtensionField::Need;
  Cause cause;
  ExtensionLaw& law = cause.law.emplace();
  law.name = "clamp_friction";
  law.shape = "clamps {a: {stuck: ..., slip_moment: ..., spring: ...}, b: ..., a_torsion: ...}";
  const NumberSpec stiffness = NumberSpec::AtLeast(0, "N m/rad").AtMost(1e9);
  for (const std::string group : {"a", "b", kTorsionOfA, kTorsionOfB}) {
    const std::string clamp = group + ".";
    law.fields.push_back({clamp + "stuck", "N m/rad", stiffness, Need::kInGroup});
    law.fields.push_back(
        {clamp + "slip_moment", "N m", NumberSpec::AtLeast(0, "N m").AtMost(1e6), Need::kInGroup});
    law.fields.push_back({clamp + "spring", "N m/rad", stiffness, Need::kInGroup});
  }
  law.enter = Enter;
  cause.name = law.name;
  cause.words = "dry friction or partial slip at a clamp";
  using Role = HypothesisNumber::Role;
  // Thresholds in parts of the largest moment: from nearly all of the motion slipping to little.
  for (const std::string clamp : {"a.", "b."})
    for (const double moment : {0.03, 0.1, 0.3})
      cause.hypotheses.push_back({{{{"extensions.clamp_friction." + clamp + "stuck", Role::kInverse,
                                     20, NumberScale::kClampBending},
                                    {"extensions.clamp_friction." + clamp + "spring",
                                     Role::kInverse, 10, NumberScale::kClampBending},
                                    {"extensions.clamp_friction." + clamp + "slip_moment",
                                     Role::kFree, moment, NumberScale::kClampMoment}}}});
  for (const std::string clamp : {"a.", "b."})
    for (const double moment : {0.03, 0.1, 0.3, 0.8})
      for (const double spring : {0.4, 1.0})
        for (const double stuck : {1.0, 4.0})
          cause.from_simpler.push_back({{{{"extensions.clamp_friction." + clamp + "stuck",
                                           Role::kFree, stuck, NumberScale::kSimplerStiffness},
                                          {"extensions.clamp_friction." + clamp + "spring",
                                           Role::kFree, spring, NumberScale::kSimplerStiffness},
                                          {"extensions.clamp_friction." + clamp + "slip_moment",
                                           Role::kFree, moment, NumberScale::kClampMoment}}}});
  for (const double moment : {0.03, 0.1, 0.3})
    cause.hypotheses.push_back({{{{"extensions.clamp_friction.a_torsion.stuck", Role::kInverse, 20,
                                   NumberScale::kClampTorsion},
                                  {"extensions.clamp_friction.a_torsion.spring", Role::kInverse, 10,
                                   NumberScale::kClampTorsion},
                                  {"extensions.clamp_friction.a_torsion.slip_moment", Role::kFree,
                                   moment, NumberScale::kTwistMoment}}}});
  // The bearing of a disc, which turns by more than what sticks there gives way.
  cause.hypotheses.push_back({{{{"extensions.clamp_friction.b_torsion.slip_moment", Role::kSize, 1,
                                 NumberScale::kTwistMoment},
                                {"extensions.clamp_friction.b_torsion.stuck", Role::kHeld, 100,
                                 NumberScale::kClampTorsion},
                                {"extensions.clamp_friction.b_torsion.spring", Role::kHeld, 0}}}});
  cause.contains = {"clamp_compliance"};
  return cause;
}

}  // namespace cosserat_cable
