// Suites about what is hard to tell apart: look-alikes, what recalibration absorbs, two at once,
// and what records cannot show.

#include <iterator>

#include "suites.h"

namespace cosserat_cable::generator {
namespace {

struct Twins {
  const EffectKind *one, *other;
  std::string one_form, other_form;
  std::set<Rig> alike;    ///< records in which they look the same
  std::set<Rig> telling;  ///< records in which they do not
  bool tip_only = false;  ///< of the former
};

const Twins& twinsOf(std::uint64_t seed) {
  static const std::vector<Twins> all = {{&kStructuralDamping,
                                          &kMaxwell,
                                          "",
                                          "",
                                          {Rig::kSmall, Rig::kShort},
                                          {Rig::kLarge, Rig::kWideSweep, Rig::kTorsion}},
                                         {&kAnisotropy,
                                          &kBendTwistCoupling,
                                          "",
                                          "",
                                          {Rig::kSmall, Rig::kSame},
                                          {Rig::kTorsion, Rig::kLarge, Rig::kBend}},
                                         {&kClampCompliance,
                                          &kAddedMass,
                                          "",
                                          "",
                                          {Rig::kSmall, Rig::kShort},
                                          {Rig::kBend, Rig::kWideSweep, Rig::kLarge}},
                                         {&kClampCompliance,
                                          &kClampPlay,
                                          "",
                                          "",
                                          {Rig::kSmall, Rig::kShort},
                                          {Rig::kBend, Rig::kLarge, Rig::kSmallAtLarge}},
                                         {&kDrift,
                                          &kSectionFriction,
                                          "",
                                          "",
                                          {Rig::kLarge},
                                          {Rig::kSmallAtLarge, Rig::kSweep, Rig::kBend}},
                                         {&kDrift,
                                          &kNonlinearStiffness,
                                          "",
                                          "",
                                          {Rig::kLarge},
                                          {Rig::kSmallAtLarge, Rig::kSweep, Rig::kBend}},
                                         {&kClock,
                                          &kSensor,
                                          "delay",
                                          "low_pass",
                                          {Rig::kTone},
                                          {Rig::kWideSweep, Rig::kSmall, Rig::kSweep}},
                                         {&kRestCurvature,
                                          &kBaseMotion,
                                          "",
                                          "tilt",
                                          {Rig::kSmall},
                                          {Rig::kSteep, Rig::kBend, Rig::kShort},
                                          true},
                                         {&kSensor,
                                          &kBaseMotion,
                                          "tilt",
                                          "tilt",
                                          {Rig::kSmall},
                                          {Rig::kSteep, Rig::kBend, Rig::kShort},
                                          true},
                                         {&kAirDrag,
                                          &kExternalDamping,
                                          "",
                                          "",
                                          {Rig::kSmall, Rig::kShort},
                                          {Rig::kLarge, Rig::kSmallAtLarge, Rig::kWideSweep}},
                                         {&kBaseMotion,
                                          &kSensor,
                                          "amplitude",
                                          "scale",
                                          {Rig::kTone},
                                          {Rig::kSmall, Rig::kSweep, Rig::kSteep},
                                          true}};
  return all[(seed / 2) % all.size()];
}

/// Even seeds have one of them at work, odd ones the other.
Case eitherOf(const Twins& twins, std::uint64_t seed) {
  const bool first = seed % 2 == 0;
  Case c;
  c.kinds = {first ? twins.one : twins.other};
  c.rival = first ? twins.other : twins.one;
  c.rival_form = first ? twins.other_form : twins.one_form;
  c.form = first ? twins.one_form : twins.other_form;
  c.label = c.kinds.front()->name;
  c.rigs = twins.alike;
  c.known_starts = true;
  return c;
}

const EffectKind* const kPairs[][2] = {{&kAirDrag, &kClampCompliance},
                                       {&kMaxwell, &kAddedMass},
                                       {&kSectionFriction, &kSensor},
                                       {&kAnisotropy, &kExternalDamping},
                                       {&kRestCurvature, &kAirDrag},
                                       {&kClampFriction, &kClock},
                                       {&kNonlinearStiffness, &kBaseMotion},
                                       {&kDrift, &kAddedMass},
                                       {&kContact, &kExternalDamping},
                                       {&kStructuralDamping, &kClampPlay},
                                       {&kBendTwistCoupling, &kAirDrag},
                                       {&kClampDamping, &kRestCurvature},
                                       {&kClock, &kAnisotropy},
                                       {&kSensor, &kClampCompliance},
                                       {&kBaseMotion, &kStructuralDamping}};

}  // namespace

Case twinsCase(const BlindPlan& plan, Random*) {
  const Twins& twins = twinsOf(plan.seed);
  Case c = eitherOf(twins, plan.seed);
  c.rival = nullptr;
  for (const Rig rig : twins.telling) c.rigs.insert(rig);
  c.expected.verdict = "named";
  c.expected.causes = {c.label};
  if (c.label == "clamp_damping") c.expected.also = {"clamp_compliance"};
  return c;
}

Case twinsWithoutCase(const BlindPlan& plan, Random*) {
  const Twins& twins = twinsOf(plan.seed);
  Case c = eitherOf(twins, plan.seed);
  c.tip_only = twins.tip_only;
  c.expected.verdict = "ambiguous";
  c.expected.causes = {c.label, c.rival->name};
  return c;
}

Case absorbedCase(const BlindPlan& plan, Random*) {
  Case c;
  switch (plan.seed % 5) {
    case 0:
      c.kinds = {&kClampCompliance};  // one length: a softer cable
      break;
    case 1:
      c.kinds = {&kSensor};  // nothing says how far it really swings
      c.form = "scale";
      c.unknown_starts = true;
      break;
    case 2:
      c.kinds = {&kClock};  // a softer cable
      c.form = "scale";
      break;
    case 3:
      c.kinds = {&kExternalDamping};  // one frequency: more eta_EI
      break;
    default:
      c.kinds = {&kAddedMass};  // one length: a softer cable
  }
  c.label = c.kinds.front()->name;
  c.rigs = {Rig::kSmall};
  c.known_starts = !c.unknown_starts;
  c.fixed_size = true;
  c.expected.verdict = "none";
  c.expected.tolerated = {"ambiguous"};
  return c;
}

Case pairsCase(const BlindPlan& plan, Random* random) {
  const auto& pair = kPairs[plan.seed % std::size(kPairs)];
  Case c;
  c.kinds = {pair[0], pair[1]};
  c.label = std::string(pair[0]->name) + "+" + pair[1]->name;
  c.rigs = commonRigs();
  for (const EffectKind* kind : pair) {
    c.expected.causes.push_back(kind->name);
    if (kind == &kClock) c.known_starts = true;
    if (kind == &kClampDamping) c.expected.also = {"clamp_compliance"};
    for (const Rig rig : tellingRigs(kind->name, false)) c.rigs.insert(rig);
  }
  fillUp(5, &c.rigs, random);
  c.expected.verdict = "named";
  return c;
}

Case unidentifiableCase(const BlindPlan& plan, Random*) {
  Case c;
  c.label = "none";
  c.known_starts = true;
  switch (plan.seed % 3) {
    case 0:  // it hangs there
      c.rigs = {Rig::kBend};
      c.steps = 1;
      c.expected.undetermined = {"EI", "eta_EI", "GJ", "eta_GJ"};
      break;
    case 1:  // nothing moves
      c.rigs = {Rig::kBend, Rig::kBendAcross};
      c.expected.undetermined = {"eta_EI", "GJ", "eta_GJ"};
      break;
    default:  // nothing bends
      c.rigs = {Rig::kTorsion};
      c.expected.undetermined = {"EI", "eta_EI"};
  }
  c.expected.verdict = "none";
  c.expected.tolerated = {"ambiguous"};
  return c;
}

}  // namespace cosserat_cable::generator
