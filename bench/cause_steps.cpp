// What each cause adds to the time step: the same record of the same cable, simulated with one
// cause after the other and without any, in turn.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "cable/cable_cases.h"
#include "cosserat_cable/causes/cause.h"
#include "cosserat_cable/measurement/experiment_simulation.h"
#include "rod/rod_cases.h"

namespace cosserat_cable::bench {
namespace {

using Eigen::Vector3d;

constexpr const char* kUsage =
    "usage: cause_steps [ROUNDS [SECONDS]]   us per step of 40 elements, and with each cause times "
    "that\n";
constexpr int kElements = 40;
constexpr double kDt = 1e-3, kLength = 0.2, kApart = 0.1;  // [s], [m]

/// A cable that hangs in a U between two clamps, which are shaken together in its plane.
Experiment ShakenU(double seconds) {
  constexpr double kShift = 2e-3, kW = 2 * M_PI * 10;  // [m], [rad/s]
  Experiment experiment;
  experiment.name = "shaken";
  const Pose rest[] = {rod::Facing({0, 0, 0}, -Vector3d::UnitZ()),
                       rod::Facing({0, kApart, 0}, Vector3d::UnitZ())};
  EndCondition* const ends[] = {&experiment.a, &experiment.b};
  const int samples = static_cast<int>(seconds / kDt);
  for (int end = 0; end < 2; ++end) {
    ClampMotion& motion = ends[end]->motion.emplace();
    for (int k = 0; k <= samples; ++k) {
      Pose pose = rest[end];
      pose.p += kShift * (1 - std::cos(kW * k * kDt)) * Vector3d(0, 1, 1);
      motion.t.push_back(k * kDt);
      motion.poses.push_back(pose);
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    Channel channel;
    channel.column = std::string("middle_") + "xyz"[axis];
    channel.s = 0.5 * kLength;
    channel.axis = axis;
    experiment.channels.push_back(channel);
  }
  // A clock that runs fast asks for less than all of the motion, one that is late too.
  for (int k = 0; k + 50 < samples; k += 2) experiment.record.t.push_back(k * kDt);
  return experiment;
}

Specimen Plain() {
  Specimen specimen;
  specimen.cable = RoundCableModel(kLength, 0.008, 0.15, 0.008, 0.006, 1e-4);
  specimen.cable.elements = kElements;
  return specimen;
}

Specimen With(std::vector<CableExtension> extensions) {
  Specimen specimen = Plain();
  specimen.cable.extensions = std::move(extensions);
  return specimen;
}

/// The cable with each cause at work. `floor`: the height of a plane that it touches in every
/// swing [m].
std::map<std::string, Specimen> WithCauses(double floor) {
  const CableExtension gives = {"clamp_compliance",
                                {{{"a.bending", 0.5}, {"a.torsion", 0.5}, {"b.bending", 0.5}}}};
  std::map<std::string, Specimen> with = {
      {"added_mass", With({{"added_mass", {{{"s", 0.1}, {"mass", 0.002}}}}})},
      {"air_drag", With({{"air_drag", {{{"Cd", 10}}}}})},
      {"anisotropy", With({{"anisotropy", {{{"difference", 0.2}, {"roll", 0.4}}}}})},
      {"bend_twist_coupling", With({{"bend_twist_coupling", {{{"c1", 0.2}, {"c2", 0.1}}}}})},
      {"clamp_compliance", With({gives})},
      {"clamp_damping",
       With({gives, {"clamp_damping", {{{"a.bending", 1e-3}, {"b.bending", 1e-3}}}}})},
      {"clamp_friction",
       With({{"clamp_friction", {{{"a.stuck", 1}, {"a.slip_moment", 1e-3}, {"a.spring", 0.5}}}}})},
      {"clamp_play", With({{"clamp_play", {{{"a.gap", 0.01}, {"a.stiffness", 1}}}}})},
      {"contact", With({{"contact",
                         {{{"plane.azimuth", 0},
                           {"plane.elevation", -M_PI / 2},  // clamp a's z axis points down
                           {"plane.offset", floor}}}}})},
      {"drift", With({{"drift", {{{"EI", 0.1}, {"eta_EI", 0.1}, {"GJ", 0.1}, {"eta_GJ", 0.1}}}}})},
      {"external_damping", With({{"external_damping", {{{"rate", 2}}}}})},
      {"maxwell",
       With({{"maxwell",
              {{{"tau", 0.02}, {"EI1", 1e-3}, {"EI2", 1e-3}, {"GJ", 1e-3}, {"EA", 0}}}}})},
      {"nonlinear_stiffness",
       With({{"nonlinear_stiffness", {{{"change", -0.3}, {"curvature", 10}}}}})},
      {"rest_curvature", With({{"rest_curvature", {{{"k1", 1}, {"k2", 1}, {"twist", 0}}}}})},
      {"section_friction",
       With({{"section_friction", {{{"EI", 1e-3}, {"slip_curvature", 0.5}, {"spread", 0.5}}}}})},
      {"structural_damping", With({{"structural_damping", {{{"loss_factor", 0.05}}}}})}};
  for (const char* fault : {"clock", "sensor", "base_motion"}) with[fault] = Plain();
  with["clock"].faults.clock = ClockFault{0.005, 0.002, {}};
  SensorFault sensor;
  sensor.scale = 1.01;
  sensor.tilt = {0.01, 0, 0};
  sensor.low_pass = 0.005;
  with["sensor"].faults.sensor = {sensor};
  ClampMotionFault base;
  base.amplitude = 1.05;
  base.phase = 0.05;
  base.bracket_frequency = 60;
  base.tilt = {0.01, 0, 0};
  with["base_motion"].faults.a = base;
  for (const Cause& cause : Causes())
    if (with.count(cause.name) == 0) throw std::logic_error("no numbers for " + cause.name);
  return with;
}

/// Of this thread on its core [s]: others that use the machine count less than on a clock.
double TimeSpent() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// [s]
double TimeOf(const Experiment& experiment, const Specimen& specimen,
              Eigen::MatrixXd* values = nullptr) {
  SimulationOptions options;
  options.dt = kDt;
  options.elements = kElements;
  const double begin = TimeSpent();
  const SimulatedRecord record = SimulateExperiment(experiment, {specimen}, options).front();
  const double taken = TimeSpent() - begin;
  if (!record.ok) throw std::runtime_error(record.message);
  if (values) *values = record.values;
  return taken;
}

double Median(std::vector<double> x) {
  std::sort(x.begin(), x.end());
  return 0.5 * (x[(x.size() - 1) / 2] + x[x.size() / 2]);
}

void Run(int rounds, double seconds) {
  const Experiment experiment = ShakenU(seconds);
  Eigen::MatrixXd plain_values;
  TimeOf(experiment, Plain(), &plain_values);
  // Of the plane over clamp a: its surface where the cable's own lies at rest.
  const CableModel cable = Plain().cable;
  const double floor = plain_values(0, 2) - 0.5 * cable.diameter;
  const std::map<std::string, Specimen> with = WithCauses(floor);
  std::vector<double> plain;
  std::map<std::string, std::vector<double>> ratios;
  for (int round = 0; round < rounds; ++round)
    for (const auto& [name, specimen] : with) {
      plain.push_back(TimeOf(experiment, Plain()));
      try {
        ratios[name].push_back(TimeOf(experiment, specimen) / plain.back());
      } catch (const std::runtime_error& error) {
        throw std::runtime_error(name + ": " + error.what());
      }
    }
  const double steps = experiment.record.t.back() / kDt;
  std::printf("{\"us_per_step\": %.3f, \"elements\": %d, \"steps\": %.0f, \"rounds\": %d, ",
              1e6 * Median(plain) / steps, kElements, steps, rounds);
  std::printf("\"ratios\": {");
  const char* separator = "";
  for (const auto& [name, of] : ratios) {
    std::printf("%s\"%s\": %.3f", separator, name.c_str(), Median(of));
    separator = ", ";
  }
  std::printf("}}\n");
}

}  // namespace
}  // namespace cosserat_cable::bench

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 15;
  const double seconds = argc > 2 ? std::atof(argv[2]) : 2;
  if (argc > 3 || rounds < 1 || !(seconds >= 0.2)) {
    std::fputs(cosserat_cable::bench::kUsage, stderr);
    return 2;
  }
  try {
    cosserat_cable::bench::Run(rounds, seconds);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "cause_steps: %s\n", error.what());
    return 3;
  }
}
