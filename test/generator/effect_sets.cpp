#include "effect_sets.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "effects/kinds.h"
#include "experiment_parts.h"

namespace cosserat_cable::generator {
namespace {

using Eigen::Vector3d;

const double kPi = std::acos(-1.0);

Vector3d acrossClamp(const Experiment& e, const Vector3d& position) {
  const Vector3d x = e.a.R.transpose() * (position - e.a.p);
  return {x.x(), x.y(), 0.0};
}

CableData at(CableData cable, double length) {
  cable.length = length;
  return cable;
}

/// A cable whose damping leaves room for more.
CableData quietCable(Random* random) {
  CableData cable = randomCable(random);
  cable.eta_EI = 2.0 * random->logUniform(0.008, 0.04) * cable.EI / bendingFrequency(cable);
  cable.eta_GJ = 2.0 * random->logUniform(0.008, 0.04) * cable.GJ / (2.0 * kPi * 5.0);
  return cable;
}

Experiment sweep(const CableData& cable, double roll, double duration, Random* random) {
  const double f = bendingFrequency(cable) / (2.0 * kPi);
  return driven("sweep", cable, random->uniform(0.1, 0.4), roll,
                {{0.015 * cable.length, 0.6 * f, 1.8 * f, 0.0}}, duration, random);
}

MeasurementSet finished(MeasurementSet set, std::vector<Experiment> experiments, Random* random) {
  set.experiments = measure(experiments, set.snr, random);
  return set;
}

MeasurementSet started(const std::string& rig, std::uint64_t seed, double snr,
                       const CableData& cable, Random* random) {
  MeasurementSet set = newSet(rig, seed, snr);
  set.truth = cable;
  set.uncertain = {"EI", "GJ", "eta_EI", "eta_GJ"};
  guess(&set, random);
  return set;
}

}  // namespace

EffectScale effectScale(const std::vector<Experiment>& experiments, const CableData& truth) {
  constexpr double kNear = 0.25;  // of the amplitude: how far beyond the rest an obstacle is
  EffectScale scale;
  scale.cable = truth;
  scale.shortest = truth.length;
  scale.frequency = bendingFrequency(truth);
  scale.torsion = scale.frequency;
  scale.amplitude = 0.0;
  Vector3d pull = Vector3d::UnitX();
  std::vector<Vector3d> places;  // of tips, at rest and where they start
  for (const Experiment& e : experiments) {
    scale.shortest = std::min(scale.shortest, e.cable.length);
    if (e.disc) scale.torsion = std::sqrt(truth.GJ / (e.cable.length * e.disc->inertia));
    if (e.b) continue;
    RodDynamics rod = makeRig(e, Resolution());
    const Eigen::VectorXd rest = restOf(e, &rod), zero = Eigen::VectorXd::Zero(rest.size());
    const Vector3d tip =
        rod.pointMotion({0.0, rest, zero, zero}, rod.shape().integralTo(e.cable.length)).position;
    places.push_back(acrossClamp(e, tip));
    if (!e.held) continue;
    places.push_back(acrossClamp(e, *e.held));
    const double amplitude = (*e.held - tip).norm() / e.cable.length;
    if (amplitude > scale.amplitude) {
      scale.amplitude = amplitude;
      pull = acrossClamp(e, *e.held - tip + e.a.p);
    }
  }
  if (scale.amplitude == 0.0) scale.amplitude = 0.1;  // nothing is let go
  pull.normalize();
  double least = 0.0;
  for (const Vector3d& place : places) least = std::min(least, pull.dot(place));
  scale.azimuth = std::atan2(pull.y(), pull.x());
  scale.obstacle = -least + kNear * scale.amplitude * truth.length + 0.5 * truth.diameter;
  return scale;
}

void applyEffects(const EffectPlan& plan, std::vector<Experiment>* experiments,
                  MeasurementSet* set) {
  const bool any = std::any_of(plan.names.begin(), plan.names.end(),
                               [](const std::string& name) { return name != "none"; });
  if (any) {
    set->effects = chooseEffects(plan.names, plan.size, effectScale(*experiments, set->truth));
  }
  for (const std::string& assignment : plan.assignments) setEffectValue(assignment, &set->effects);
  for (Experiment& e : *experiments) {
    e.effects = set->effects;
    // Where a force brings the cable as it is; the plain one's place may be out of its reach.
    if (any && e.held && e.pull.norm() > 0.0) e.held = pulledEnd(e, e.pull, e.pull.norm());
  }
}

EffectSets effectSets(std::uint64_t seed, double snr, const EffectPlan& effects) {
  constexpr double kDriven = 3.0;  // [s]
  Random random(seed);
  const CableData cable = quietCable(&random);
  const double L = cable.length, f = bendingFrequency(cable) / (2.0 * kPi);
  EffectSets sets;
  sets.seen = started("effects", seed, snr, cable, &random);

  CableData twisted = cable;
  Disc disc = randomDisc(&twisted, 0.6 * L, &random);
  disc.dashpot = 0.0;
  const double duration = std::clamp(8.0 / f, 1.0, 2.5);
  const double roll = random.uniform(-kPi, kPi);
  std::vector<Experiment> all;
  all.push_back(ringdown("ringdown_small", cable, random.uniform(0.05, 0.3),
                         random.uniform(0.03, 0.05), duration, &random, roll + 1.2));
  all.push_back(ringdown("ringdown_large", at(cable, 0.8 * L), random.uniform(0.05, 0.3),
                         random.uniform(0.15, 0.22), 0.8 * duration, &random, roll));
  all.push_back(torsion("torsion", cable, 0.6 * L, disc, random.chance(0.5), 1.5, &random));
  // Near the larger ring-down's plane, where an obstacle would be.
  all.push_back(sweep(cable, roll + random.uniform(-0.8, 0.8), kDriven, &random));
  const CableData other = at(cable, 0.9 * L);
  const double g = f / 0.81;
  all.push_back(driven("unseen", other, random.uniform(0.1, 0.4), roll + random.uniform(-0.8, 0.8),
                       {{0.025 * L, 0.45 * g, 0.45 * g, random.uniform(0.0, 6.0)},
                        {0.025 * L, 0.95 * g, 0.95 * g, random.uniform(0.0, 6.0)},
                        {0.008 * L, 1.4 * g, 1.4 * g, random.uniform(0.0, 6.0)}},
                       kDriven, &random));
  applyEffects(effects, &all, &sets.seen);
  sets.unseen = sets.seen;
  sets.unseen.rig = "effects-unseen";
  sets.seen = finished(sets.seen, {all.begin(), all.end() - 1}, &random);
  sets.unseen = finished(sets.unseen, {all.back()}, &random);
  return sets;
}

MeasurementSet driveSet(std::uint64_t seed, double snr, const EffectPlan& effects) {
  Random random(seed);
  const CableData cable = quietCable(&random);
  MeasurementSet set = started("drive", seed, snr, cable, &random);
  std::vector<Experiment> all = {sweep(cable, random.uniform(-kPi, kPi), 3.0, &random)};
  applyEffects(effects, &all, &set);
  return finished(set, all, &random);
}

MeasurementSet archSet(std::uint64_t seed, double snr, const EffectPlan& effects) {
  Random random(seed);
  const CableData cable = quietCable(&random);
  MeasurementSet set = started("arch", seed, snr, cable, &random);
  std::vector<Experiment> all;
  for (const bool across : {false, true}) {
    all.push_back(arch(across ? "arch_across" : "arch_in_plane", cable, across, 1.2, &random));
    all.back().times = jitteredTimes(1.2, 500.0, kJitter, &random);
  }
  applyEffects(effects, &all, &set);
  return finished(set, all, &random);
}

MeasurementSet bendSet(std::uint64_t seed, double snr, const EffectPlan& effects) {
  Random random(seed);
  const CableData cable = quietCable(&random);
  MeasurementSet set = started("bend", seed, snr, cable, &random);
  set.uncertain = {"EI"};
  std::vector<Experiment> all;
  for (int plane = 0; plane < 2; ++plane) {
    all.push_back(slowBend(plane == 0 ? "bend_a1" : "bend_a2", cable, plane, plane == 0 ? 0.4 : 0.8,
                           &random));
  }
  applyEffects(effects, &all, &set);
  return finished(set, all, &random);
}

}  // namespace cosserat_cable::generator
