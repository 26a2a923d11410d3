#include "rig_mix.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "../experiment_parts.h"

namespace cosserat_cable::generator {
namespace {

const double kPi = std::acos(-1.0);
constexpr double kLargePart = 0.8, kShortPart = 0.55, kTorsionPart = 0.6;  // of the length

CableData part(CableData cable, double factor) {
  cable.length *= factor;
  return cable;
}

/// What all records of a mix have in common.
struct Bench {
  CableData cable;
  double frequency;  // of the first mode [Hz]
  double rate;       // of sampling [Hz]
  double roll;       // of the large ring-down's plane from a1
  Disc disc;
};

Bench newBench(const CableData& cable, Random* random) {
  Bench bench;
  bench.cable = cable;
  bench.frequency = bendingFrequency(cable) / (2.0 * kPi);
  bench.rate = std::clamp(random->uniform(25.0, 45.0) * bench.frequency, 100.0, 400.0);
  bench.roll = random->uniform(-kPi, kPi);
  CableData twisted = cable;
  bench.disc = randomDisc(&twisted, kTorsionPart * cable.length, random);
  bench.disc.dashpot = 0.0;
  return bench;
}

Experiment ringdownOf(const Bench& b, const std::string& name, double length, double amplitude,
                      double tilt, double roll, Random* random) {
  const double swings = 9.0 / (b.frequency / (length * length));
  Experiment e = ringdown(name, part(b.cable, length), tilt, amplitude,
                          std::clamp(swings, 1.2, 4.0), random, roll);
  e.times = jitteredTimes(std::clamp(swings, 1.2, 4.0), b.rate, kJitter, random);
  return e;
}

Experiment drivenOf(const Bench& b, const std::string& name, double length,
                    const std::vector<ExcitationLine>& lines, double duration, Random* random) {
  // Near the larger ring-down's plane, where an obstacle would be.
  const double roll = b.roll + random->uniform(-0.8, 0.8);
  Experiment e =
      driven(name, part(b.cable, length), random->uniform(0.1, 0.4), roll, lines, duration, random);
  e.times = jitteredTimes(duration, b.rate, kJitter, random);
  return e;
}

Experiment torsionOf(const Bench& b, const std::string& name, double length, Random* random) {
  const bool guided = random->chance(0.3);
  Experiment e = torsion(name, b.cable, length * b.cable.length, b.disc, guided, 2.0, random);
  if (!guided) addPositions(random->uniform(0.4, 0.7) * e.cable.length, &e);
  e.times = jitteredTimes(2.0, 200.0, kJitter, random);
  return e;
}

Experiment rigOf(Rig rig, const Bench& b, Random* random) {
  const double L = b.cable.length, f = b.frequency, across = b.roll + 0.5 * kPi;
  const double tilt = random->uniform(0.05, 0.4), small = random->uniform(0.03, 0.05);
  const double sweep = std::clamp(16.0 / f, 2.5, 5.0);
  switch (rig) {
    case Rig::kSmall:
      return ringdownOf(b, "ringdown_small", 1.0, small, tilt, across, random);
    case Rig::kLarge:
      return ringdownOf(b, "ringdown_large", kLargePart, random->uniform(0.15, 0.22), tilt, b.roll,
                        random);
    case Rig::kShort:
      return ringdownOf(b, "ringdown_short", kShortPart, small, tilt, across, random);
    case Rig::kSame:
      return ringdownOf(b, "ringdown_same", 1.0, small, tilt, b.roll, random);
    case Rig::kSmallAtLarge:
      return ringdownOf(b, "ringdown_again", kLargePart, small, tilt, b.roll, random);
    case Rig::kSteep:
      return ringdownOf(b, "ringdown_tilted", 0.7, small, tilt + 0.7, across + 0.8, random);
    case Rig::kSweep:
      return drivenOf(b, "sweep", 1.0, {{0.015 * L, 0.6 * f, 1.8 * f, 0.0}}, sweep, random);
    case Rig::kWideSweep:
      return drivenOf(b, "sweep_wide", 1.0, {{0.008 * L, 0.5 * f, 7.0 * f, 0.0}}, sweep, random);
    case Rig::kTone:
      return drivenOf(b, "tone", 1.0, {{0.02 * L, 0.8 * f, 0.8 * f, 0.0}}, 2.5, random);
    case Rig::kTorsion:
      return torsionOf(b, "torsion", kTorsionPart, random);
    case Rig::kTorsionShort:
      return torsionOf(b, "torsion_short", 0.5 * kTorsionPart, random);
    case Rig::kArch: {
      Experiment e = arch("arch", b.cable, random->chance(0.5), 2.0, random);
      const double top = e.drive->lines.front().last_frequency;
      e.times = jitteredTimes(2.0, std::clamp(12.0 * top, 100.0, 400.0), kJitter, random);
      return e;
    }
    case Rig::kBend:
      return slowBend("bend", b.cable, 0, random->uniform(0.4, 0.8), random);
    case Rig::kBendAcross:
      return slowBend("bend_across", b.cable, 1, random->uniform(0.4, 0.8), random);
  }
  throw std::logic_error("unknown rig");
}

}  // namespace

CableData blindCable(Random* random) {
  constexpr double kGravity = 9.81;
  CableData c;
  double frequency = 0.0;
  for (;;) {
    c.length = random->logUniform(0.15, 1.0);
    c.diameter = random->logUniform(2.5e-3, 12e-3);
    c.rhoA = random->logUniform(0.01, 0.3);
    c.EI = random->logUniform(5e-4, 0.1);
    frequency = bendingFrequency(c);
    const double weight = c.rhoA * kGravity * std::pow(c.length, 3) / c.EI;
    if (weight < 8.0 && frequency > 2.0 * kPi * 2.0 && frequency < 2.0 * kPi * 14.0) break;
  }
  c.GJ = c.EI * random->uniform(0.6, 1.6);
  c.eta_EI = 2.0 * random->logUniform(0.01, 0.05) * c.EI / frequency;
  c.eta_GJ = 2.0 * random->logUniform(0.01, 0.08) * c.GJ / (2.0 * kPi * 5.0);
  return c;
}

RigMix mixRigs(const std::set<Rig>& rigs, bool torsion, Random* random) {
  RigMix mix;
  mix.cable = blindCable(random);
  const Bench bench = newBench(mix.cable, random);
  for (const Rig rig : rigs) mix.seen.push_back(rigOf(rig, bench, random));
  if (torsion) {
    mix.unseen = torsionOf(bench, "unseen", 0.45, random);
    return mix;
  }
  const double L = mix.cable.length, g = bench.frequency / 0.81;
  const auto phase = [random] { return random->uniform(0.0, 2.0 * kPi); };
  mix.unseen = drivenOf(bench, "unseen", 0.9,
                        {{0.025 * L, 0.45 * g, 0.45 * g, phase()},
                         {0.025 * L, 0.95 * g, 0.95 * g, phase()},
                         {0.008 * L, 1.4 * g, 1.4 * g, phase()}},
                        3.0, random);
  return mix;
}

}  // namespace cosserat_cable::generator
