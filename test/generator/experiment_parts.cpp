#include "experiment_parts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace cosserat_cable::generator {
namespace {

using Eigen::Vector3d;
using Quantity = Channel::Quantity;

constexpr double kGravity = 9.81;
constexpr double kMu1 = 1.8751040687119611;  // clamped-free beam
constexpr double kWrongBy = 1.25;            // at most, the guess of a stiffness
const double kPi = std::acos(-1.0);

}  // namespace

double bendingFrequency(const CableData& c) {  // [rad/s], straight, without gravity
  return kMu1 * kMu1 * std::sqrt(c.EI / c.rhoA) / (c.length * c.length);
}

Eigen::Matrix3d frameAlong(const Vector3d& axis, Random* random) {
  const Eigen::Quaterniond q = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), axis);
  return (q * Eigen::AngleAxisd(random->uniform(-kPi, kPi), Vector3d::UnitZ())).toRotationMatrix();
}

Vector3d anyPlace(Random* random) {
  return {random->uniform(-0.5, 0.5), random->uniform(-0.5, 0.5), random->uniform(0.0, 1.0)};
}

void addPositions(double inner, Experiment* e) {
  for (const auto& [point, station] :
       {std::pair{"tip_", e->cable.length}, std::pair{"inner_", inner}}) {
    for (int i = 0; i < 3; ++i) {
      e->channels.push_back({point + std::string(1, "xyz"[i]), station, Quantity::kPosition, i});
    }
  }
}

Experiment ringdown(const std::string& name, const CableData& cable, double tilt, double amplitude,
                    double duration, Random* random, double roll) {
  Experiment e;
  e.name = name;
  e.kind = "ringdown";
  e.cable = cable;
  e.a.p = anyPlace(random);
  const double heading = random->uniform(-kPi, kPi);
  const Vector3d axis(std::sin(tilt) * std::cos(heading), std::sin(tilt) * std::sin(heading),
                      -std::cos(tilt));
  e.a.R = frameAlong(axis, random);
  if (std::isnan(roll)) roll = random->uniform(-kPi, kPi);
  const Vector3d pull = e.a.R * Vector3d(std::cos(roll), std::sin(roll), 0.0);
  e.pull = amplitude * cable.length * pull;
  e.held = pulledEnd(e, pull, amplitude * cable.length);
  addPositions(cable.length * random->uniform(0.4, 0.8), &e);
  const double rate = random->logUniform(200.0, 1000.0);
  e.times = jitteredTimes(duration, rate, kJitter, random);
  return e;
}

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

Experiment driven(const std::string& name, const CableData& cable, double tilt, double roll,
                  const std::vector<ExcitationLine>& lines, double duration, Random* random) {
  Experiment e;
  e.name = name;
  e.kind = "drive";
  e.cable = cable;
  e.a.p = anyPlace(random);
  const double heading = random->uniform(-kPi, kPi);
  const Vector3d axis(std::sin(tilt) * std::cos(heading), std::sin(tilt) * std::sin(heading),
                      -std::cos(tilt));
  e.a.R = frameAlong(axis, random);
  Excitation drive;
  drive.start = e.a;
  drive.direction = e.a.R * Vector3d(std::cos(roll), std::sin(roll), 0.0);
  drive.axis = e.a.R * Vector3d(std::sin(roll), -std::cos(roll), 0.0);
  drive.turn = random->uniform(0.5, 1.5) / cable.length * 0.3;
  drive.lines = lines;
  drive.duration = duration;
  e.drive = drive;
  addPositions(cable.length * random->uniform(0.4, 0.8), &e);
  e.times = jitteredTimes(duration, random->logUniform(200.0, 500.0), kJitter, random);
  return e;
}

Experiment arch(const std::string& name, const CableData& cable, bool across, double duration,
                Random* random) {
  constexpr double kApart = 0.5;       // of the length
  constexpr double kArchMode = 36.47;  // w L^2 sqrt(rhoA/EI) of its first mode in plane
  const double L = cable.length;
  const double f = kArchMode * std::sqrt(cable.EI / cable.rhoA) / (L * L) / (2.0 * kPi);
  Experiment e;
  e.name = name;
  e.kind = "drive";
  e.cable = cable;
  e.a.p = anyPlace(random);
  e.a.R = frameAlong(-Vector3d::UnitZ(), random);  // a heavy one that stands topples
  const double heading = random->uniform(-kPi, kPi);
  const Vector3d side = e.a.R * Vector3d(std::cos(heading), std::sin(heading), 0.0);
  const Vector3d axis = -Vector3d::UnitZ().cross(side);
  FrameMotion b;
  b.p = e.a.p + kApart * L * side;
  b.R = Eigen::AngleAxisd(kPi, axis).toRotationMatrix() * e.a.R;
  e.b = b;
  Excitation drive;
  drive.start = e.a;
  drive.direction = across ? axis : side;
  drive.axis = axis;
  const double low = across ? 0.2 : 0.5, high = across ? 0.8 : 1.4;
  drive.lines = {{0.012 * L, low * f, high * f, 0.0}};
  drive.duration = duration;
  e.drive = drive;
  addPositions(0.5 * L, &e);
  e.channels.erase(e.channels.begin(), e.channels.begin() + 3);  // the end is held
  return e;
}

Experiment slowBend(const std::string& name, const CableData& cable, int plane, double largest,
                    Random* random) {
  constexpr int kQuarter = 12;  // steps
  const double L = cable.length;
  Experiment e;
  e.name = name;
  e.kind = "bend";
  e.cable = cable;
  e.a.p = anyPlace(random);
  e.a.R = frameAlong(-Vector3d::UnitZ(), random);
  const double force = largest * cable.EI / (L * L);
  const int steps = 8 * kQuarter + 1;
  e.times = Eigen::VectorXd::LinSpaced(steps, 0.0, steps - 1.0);
  for (int i = 0; i < steps; ++i) {
    const int phase = i % (4 * kQuarter);
    const int up = phase <= kQuarter       ? phase
                   : phase <= 3 * kQuarter ? 2 * kQuarter - phase
                                           : phase - 4 * kQuarter;
    e.tip_forces.push_back(force * up / kQuarter * e.a.R.col(plane));
  }
  addPositions(0.6 * L, &e);
  return e;
}

double discMass(double inertia, const CableData& cable, Random* random) {
  const double radius = random->uniform(0.02, 0.05);
  const double EA = 16.0 * cable.EI / (cable.diameter * cable.diameter);
  return std::min({2.0 * inertia / (radius * radius), 0.3, 0.01 * EA / kGravity});
}

void guess(MeasurementSet* set, Random* random) {
  set->EI_guess = set->truth.EI * random->logUniform(1.0 / kWrongBy, kWrongBy);
  set->GJ_guess = set->truth.GJ * random->logUniform(1.0 / kWrongBy, kWrongBy);
}

MeasurementSet newSet(const std::string& rig, std::uint64_t seed, double snr) {
  MeasurementSet set;
  set.rig = rig;
  set.seed = seed;
  set.snr = snr;
  return set;
}

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

}  // namespace cosserat_cable::generator
