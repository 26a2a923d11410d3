#include "sample_sets.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace cosserat_cable::generator {
namespace {

using Eigen::Vector3d;
using Quantity = Channel::Quantity;

constexpr double kGravity = 9.81;
constexpr double kMu1 = 1.8751040687119611;  // clamped-free beam
constexpr double kJitter = 0.2;              // of the sampling period
constexpr double kWrongBy = 1.25;            // at most, the guess of a stiffness
const double kPi = std::acos(-1.0);

double bendingFrequency(const CableData& c) {  // [rad/s], straight, without gravity
  return kMu1 * kMu1 * std::sqrt(c.EI / c.rhoA) / (c.length * c.length);
}

/// A frame whose a3 points along `axis`, rolled at random.
Eigen::Matrix3d frameAlong(const Vector3d& axis, Random* random) {
  const Eigen::Quaterniond q = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), axis);
  return (q * Eigen::AngleAxisd(random->uniform(-kPi, kPi), Vector3d::UnitZ())).toRotationMatrix();
}

Vector3d anyPlace(Random* random) {
  return {random->uniform(-0.5, 0.5), random->uniform(-0.5, 0.5), random->uniform(0.0, 1.0)};
}

/// @param tilt of the clamp's axis from straight down [rad].
Experiment ringdown(const std::string& name, const CableData& cable, double tilt, double amplitude,
                    double duration, Random* random) {
  Experiment e;
  e.name = name;
  e.kind = "ringdown";
  e.cable = cable;
  e.a.p = anyPlace(random);
  const double heading = random->uniform(-kPi, kPi);
  const Vector3d axis(std::sin(tilt) * std::cos(heading), std::sin(tilt) * std::sin(heading),
                      -std::cos(tilt));
  e.a.R = frameAlong(axis, random);
  const double roll = random->uniform(-kPi, kPi);
  const Vector3d pull = e.a.R * Vector3d(std::cos(roll), std::sin(roll), 0.0);
  e.held = pulledEnd(e, pull, amplitude * cable.length);
  const double inner = cable.length * random->uniform(0.4, 0.8);
  for (const auto& [point, station] :
       {std::pair{"tip_", cable.length}, std::pair{"inner_", inner}}) {
    for (int i = 0; i < 3; ++i) {
      e.channels.push_back({point + std::string(1, "xyz"[i]), station, Quantity::kPosition, i});
    }
  }
  const double rate = random->logUniform(200.0, 1000.0);
  e.times = jitteredTimes(duration, rate, kJitter, random);
  return e;
}

/// Adds a velocity along the world axis in which the end starts nearest to the clamp. Not an
/// acceleration: at the release it is a wave front, which no model of a rod resolves.
void addVelocity(Experiment* e) {
  int axis = 0;
  (*e->held - e->a.p).cwiseAbs().minCoeff(&axis);
  e->channels.push_back({"tip_velocity", e->cable.length, Quantity::kVelocity, axis});
}

Experiment torsion(const std::string& name, const CableData& cable, double length, const Disc& disc,
                   bool guided, double duration, Random* random) {
  Experiment e;
  e.name = name;
  e.kind = "torsion";
  e.cable = cable;
  e.cable.length = length;
  e.a.p = anyPlace(random);
  e.a.R = frameAlong(-Vector3d::UnitZ(), random);
  e.disc = disc;
  e.guided = guided;
  e.twisted = random->uniform(0.3, 1.2) * (random->chance(0.5) ? 1.0 : -1.0);
  e.channels.push_back({"angle", length, Quantity::kAngle, 2});
  e.times = jitteredTimes(duration, random->logUniform(200.0, 1000.0), kJitter, random);
  return e;
}

/// Mass of a disc of this inertia that stretches the cable by 1 % at most.
double discMass(double inertia, const CableData& cable, Random* random) {
  const double radius = random->uniform(0.02, 0.05);
  const double EA = 16.0 * cable.EI / (cable.diameter * cable.diameter);
  return std::min({2.0 * inertia / (radius * radius), 0.3, 0.01 * EA / kGravity});
}

void guess(MeasurementSet* set, Random* random) {
  set->EI_guess = set->truth.EI * random->logUniform(1.0 / kWrongBy, kWrongBy);
  set->GJ_guess = set->truth.GJ * random->logUniform(1.0 / kWrongBy, kWrongBy);
}

MeasurementSet begin(const std::string& rig, std::uint64_t seed, double snr) {
  MeasurementSet set;
  set.rig = rig;
  set.seed = seed;
  set.snr = snr;
  return set;
}

/// A cable that holds itself up well enough, and swings at 2 to 20 Hz.
CableData randomCable(Random* random) {
  CableData c;
  for (;;) {
    c.length = random->logUniform(0.15, 0.6);
    c.diameter = random->logUniform(3e-3, 12e-3);
    c.rhoA = random->logUniform(0.02, 0.3);
    c.EI = random->logUniform(1e-3, 3e-2);
    const double weight = c.rhoA * kGravity * std::pow(c.length, 3) / c.EI;
    const double frequency = bendingFrequency(c) / (2.0 * kPi);
    if (weight < 8.0 && frequency > 2.0 && frequency < 20.0) break;
  }
  c.GJ = c.EI * random->uniform(0.6, 1.6);
  const double ratio = random->logUniform(0.01, 0.15);
  c.eta_EI = 2.0 * ratio * c.EI / bendingFrequency(c);
  return c;
}

/// A disc that turns at 3.5 to 6 Hz at mid length; sets the cable's [eta_GJ] for a damping ratio of
/// 0.01 to 0.1 there.
Disc randomDisc(CableData* cable, double mid_length, Random* random) {
  const double omega = 2.0 * kPi * random->uniform(3.5, 6.0);
  const double ratio = random->logUniform(0.01, 0.1);
  cable->eta_GJ = 2.0 * ratio * cable->GJ / omega;
  Disc disc;
  disc.inertia = cable->GJ / (mid_length * omega * omega);
  disc.mass = discMass(disc.inertia, *cable, random);
  disc.dashpot = random->logUniform(0.1, 1.0) * cable->eta_GJ / mid_length;
  return disc;
}

double ringdownTime(const CableData& cable) {
  return std::clamp(10.0 * 2.0 * kPi / bendingFrequency(cable), 1.0, 3.0);
}

double torsionTime(const CableData& cable, double length, const Disc& disc) {
  const double omega = std::sqrt(cable.GJ / (length * disc.inertia));
  return std::clamp(10.0 * 2.0 * kPi / omega, 1.0, 3.0);
}

}  // namespace

MeasurementSet randomSet(std::uint64_t seed, double snr) {
  Random random(seed);
  MeasurementSet set = begin("random", seed, snr);
  CableData cable = randomCable(&random);
  const int lengths = random.chance(0.5) ? 3 : 4;
  const double shortest = random.uniform(0.1, 0.15), longest = random.uniform(0.35, 0.5);
  const Disc disc = randomDisc(&cable, 0.5 * (shortest + longest), &random);
  set.D_E = disc.dashpot;
  set.truth = cable;
  std::vector<Experiment> experiments;
  // Up to horizontal; beyond, a soft cable hangs in other shapes than it was pulled from.
  experiments.push_back(ringdown("ringdown_small", cable, random.uniform(0.0, 0.5 * kPi),
                                 random.uniform(0.02, 0.08), ringdownTime(cable), &random));
  experiments.push_back(ringdown("ringdown_large", cable, random.uniform(0.0, 0.5 * kPi),
                                 random.uniform(0.1, 0.3), ringdownTime(cable), &random));
  if (random.chance(0.3)) addVelocity(&experiments.back());
  const bool guided = random.chance(0.5);
  for (int i = 0; i < lengths; ++i) {
    const double length = shortest + (longest - shortest) * i / (lengths - 1);
    experiments.push_back(torsion("torsion_" + std::to_string(i + 1), cable, length, disc, guided,
                                  torsionTime(cable, length, disc), &random));
  }
  set.uncertain = {"EI", "eta_EI", "GJ", "eta_GJ"};
  guess(&set, &random);
  set.experiments = measure(experiments, snr, &random);
  return set;
}

MeasurementSet wireSet(std::uint64_t seed, double snr) {
  Random random(seed);
  MeasurementSet set = begin("wire", seed, snr);
  CableData c;
  c.length = 0.2;
  c.diameter = 3e-3;
  c.rhoA = 0.027;
  c.EI = 1.2e-3;
  c.GJ = 1.2e-3;
  c.eta_EI = 2.0 * 0.02 * c.EI / bendingFrequency(c);
  c.eta_GJ = c.eta_EI;
  set.truth = c;
  std::vector<Experiment> experiments;
  for (int i = 0; i < 2; ++i) {
    experiments.push_back(
        ringdown("ringdown_" + std::to_string(i + 1), c, 0.0, 0.03, 3.0, &random));
  }
  set.uncertain = {"EI", "eta_EI"};
  guess(&set, &random);
  set.experiments = measure(experiments, snr, &random);
  return set;
}

MeasurementSet ringdownSet(std::uint64_t seed, double snr, const RingdownPlan& plan) {
  constexpr double kPeriods = 8.0, kSamplesPerPeriod = 30.0;
  Random random(seed);
  MeasurementSet set = begin("ringdowns", seed, snr);
  const CableData cable = randomCable(&random);
  set.truth = cable;
  const double period = 2.0 * kPi / bendingFrequency(cable);
  const double duration = std::clamp(kPeriods * period, 1.0, 2.0);
  std::vector<Experiment> experiments;
  const int records = random.chance(0.5) ? 1 : 2;
  for (int i = 0; i < records; ++i) {
    experiments.push_back(ringdown("ringdown_" + std::to_string(i + 1), cable,
                                   random.uniform(0.0, 0.5 * kPi), random.uniform(0.02, 0.15),
                                   duration, &random));
    experiments.back().times =
        jitteredTimes(duration, kSamplesPerPeriod / period, kJitter, &random);
  }
  set.uncertain = {"EI", "eta_EI"};
  guess(&set, &random);
  set.experiments = measure(experiments, snr, &random);
  if (plan.unknown_start) {
    for (MeasuredExperiment& one : set.experiments) {
      forgetStart(random.uniform(0.2, 1.0) * period, &one);
    }
  }
  return set;
}

MeasurementSet torsionSeries(std::uint64_t seed, double snr, const TorsionPlan& plan) {
  const int lengths = plan.lengths;
  constexpr double kRatio = 0.25;  // damping ratio at the shortest length
  constexpr double kPeriods = 5.0, kSamplesPerPeriod = 40.0;
  Random random(seed);
  MeasurementSet set = begin(lengths > 1 ? "torsion-series" : "torsion-single", seed, snr);
  CableData c;
  c.length = 0.25;
  c.diameter = 8e-3;
  c.rhoA = 0.09;
  c.GJ = random.logUniform(1e-3, 1e-2);
  c.EI = c.GJ / random.uniform(0.6, 1.6);
  c.eta_EI = 2e-4;
  c.eta_GJ = 2e-4 * random.uniform(0.8, 1.25);
  const double shortest = lengths > 1 ? 0.1 : c.length, longest = plan.longest;
  Disc disc;
  disc.dashpot = random.uniform(1.0, 3.0) * c.eta_GJ / (lengths > 1 ? 0.25 : c.length);
  const double delta = (c.eta_GJ / shortest + disc.dashpot) / 2.0;  // times the inertia
  disc.inertia = std::pow(delta / kRatio, 2) * shortest / c.GJ;
  disc.mass = discMass(disc.inertia, c, &random);
  set.truth = c;
  set.D_E = disc.dashpot;
  std::vector<Experiment> experiments;
  for (int i = 0; i < lengths; ++i) {
    const double length =
        lengths > 1 ? shortest + (longest - shortest) * i / (lengths - 1) : shortest;
    for (int repeat = 0; repeat < plan.repeats; ++repeat) {
      const std::string name =
          "torsion_" + std::to_string(i + 1) + "_" + std::to_string(repeat + 1);
      // As slow as the discs of a pendulum whose fixation damps so much: a camera is enough.
      const double period = 2.0 * kPi * std::sqrt(disc.inertia * length / c.GJ);
      Disc fastened = disc;
      fastened.dashpot *= std::max(0.0, 1.0 + plan.scatter * random.normal());
      experiments.push_back(torsion(name, c, length, fastened, true, kPeriods * period, &random));
      experiments.back().times =
          jitteredTimes(kPeriods * period, kSamplesPerPeriod / period, kJitter, &random);
    }
  }
  set.uncertain = {"GJ", "eta_GJ"};
  guess(&set, &random);
  set.experiments = measure(experiments, snr, &random);
  return set;
}

MeasurementSet sixRecords(std::uint64_t seed, double snr) {
  constexpr double kDuration = 3.0;
  Random random(seed);
  MeasurementSet set = begin("six", seed, snr);
  CableData cable = randomCable(&random);
  const Disc disc = randomDisc(&cable, 0.25, &random);
  set.truth = cable;
  set.D_E = disc.dashpot;
  std::vector<Experiment> experiments;
  for (int i = 0; i < 3; ++i) {
    experiments.push_back(ringdown("ringdown_" + std::to_string(i + 1), cable,
                                   random.uniform(0.0, 0.5 * kPi), 0.05 + 0.1 * i, kDuration,
                                   &random));
  }
  for (int i = 0; i < 3; ++i) {
    experiments.push_back(torsion("torsion_" + std::to_string(i + 1), cable, 0.1 + 0.15 * i, disc,
                                  true, kDuration, &random));
  }
  set.uncertain = {"EI", "eta_EI", "GJ", "eta_GJ"};
  guess(&set, &random);
  set.experiments = measure(experiments, snr, &random);
  return set;
}

}  // namespace cosserat_cable::generator
