#include "suites.h"

#include <map>
#include <stdexcept>

#include "../outside/kinds.h"

namespace cosserat_cable::generator {
namespace {

/// One after the other, so that as many seeds have all of them equally often.
const EffectKind& nextOf(const std::vector<const EffectKind*>& kinds, std::uint64_t seed) {
  return *kinds[seed % kinds.size()];
}

}  // namespace

std::set<Rig> commonRigs() { return {Rig::kSmall, Rig::kLarge, Rig::kSweep}; }

std::set<Rig> tellingRigs(const std::string& cause, bool torsional) {
  static const std::map<std::string, std::set<Rig>> telling = {
      {"maxwell", {Rig::kShort, Rig::kWideSweep}},
      {"structural_damping", {Rig::kShort, Rig::kWideSweep}},
      {"section_friction", {Rig::kSmallAtLarge, Rig::kBend}},
      {"nonlinear_stiffness", {Rig::kSmallAtLarge, Rig::kBend}},
      {"anisotropy", {Rig::kSame, Rig::kTorsion}},
      {"rest_curvature", {Rig::kSteep, Rig::kBend}},
      {"bend_twist_coupling", {Rig::kSame, Rig::kTorsion}},
      {"clamp_compliance", {Rig::kShort, Rig::kBend}},
      {"clamp_damping", {Rig::kShort, Rig::kWideSweep}},
      {"clamp_friction", {Rig::kSmallAtLarge, Rig::kShort}},
      {"clamp_play", {Rig::kSmallAtLarge, Rig::kShort}},
      {"air_drag", {Rig::kSmallAtLarge, Rig::kShort}},
      {"external_damping", {Rig::kShort, Rig::kWideSweep}},
      {"added_mass", {Rig::kShort, Rig::kWideSweep}},
      {"contact", {Rig::kSmallAtLarge}},
      {"drift", {Rig::kSame, Rig::kSmallAtLarge}},
      {"clock", {Rig::kWideSweep}},
      {"sensor", {Rig::kSteep, Rig::kWideSweep}},
      {"base_motion", {Rig::kSteep, Rig::kWideSweep}}};
  if (torsional) return {Rig::kTorsion, Rig::kTorsionShort};
  return telling.at(cause);
}

void fillUp(size_t count, std::set<Rig>* rigs, Random* random) {
  static const std::vector<Rig> some = {Rig::kShort,     Rig::kTorsion,      Rig::kArch,
                                        Rig::kBend,      Rig::kSmallAtLarge, Rig::kSteep,
                                        Rig::kWideSweep, Rig::kSame};
  while (rigs->size() < count) {
    rigs->insert(some[static_cast<size_t>(random->uniform(0.0, static_cast<double>(some.size())))]);
  }
}

Case singleCase(const BlindPlan& plan, Random* random) {
  Case c;
  const EffectKind& kind =
      plan.effect.empty() ? nextOf(effectKinds(), plan.seed) : effectKind(plan.effect);
  c.kinds = {&kind};
  c.label = kind.name;
  const bool torsional = c.label == "clamp_damping" && random->chance(0.5);
  if (torsional) c.form = "torsion";
  c.unseen_torsion = torsional;
  c.known_starts = c.label == "clock";
  c.rigs = commonRigs();
  for (const Rig rig : tellingRigs(c.label, torsional)) c.rigs.insert(rig);
  fillUp(random->chance(0.5) ? 4 : 5, &c.rigs, random);
  c.expected.verdict = "named";
  c.expected.causes = {c.label};
  if (c.label == "clamp_damping" && !torsional) c.expected.also = {"clamp_compliance"};
  return c;
}

Case nullCase(const BlindPlan&, Random* random) {
  Case c;
  c.label = "none";
  c.rigs = {random->chance(0.5) ? Rig::kSmall : Rig::kLarge};
  fillUp(random->chance(0.5) ? 3 : 4, &c.rigs, random);
  if (random->chance(0.5)) c.rigs.insert(Rig::kSweep);
  c.expected.verdict = "none";
  return c;
}

Case outsideCase(const BlindPlan& plan, Random* random) {
  Case c;
  const EffectKind* kind = nullptr;
  std::string known;
  for (const EffectKind* one : outsideKinds()) {
    if (plan.effect == one->name) kind = one;
    known += std::string(" ") + one->name;
  }
  if (plan.effect.empty()) kind = &nextOf(outsideKinds(), plan.seed);
  if (!kind) throw std::invalid_argument("unknown law " + plan.effect + "; there are" + known);
  c.kinds = {kind};
  c.label = kind->name;
  c.rigs = commonRigs();
  c.rigs.insert(Rig::kSmallAtLarge);
  fillUp(random->chance(0.5) ? 4 : 5, &c.rigs, random);
  c.expected.verdict = "unexplained";
  return c;
}

}  // namespace cosserat_cable::generator
