// mujoco_rig: a measurement set whose records are MuJoCo's, which has the cable as rigid pieces in
// ball joints: three ring-downs of a cantilever, pulled aside by a force at its tip and let go.
//   mujoco_rig --output DIR [--drag CD] [--play RAD] ... [--cut S] [--snr DB] [--seed N]
// With --cut the first seconds are missing, and starts are unknown. It takes a minute or two.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "mujoco_chain.h"

namespace cosserat_cable {
namespace {

struct Options {
  std::string output;
  ChainCable cable;
  ChainEffects effects;
  double clock = 1, late = 0;  // of the record's clock: rate; s
  double scale = 1;            // of the middle's sensor
  double cut = 0;              // s
  double snr = 40;             // dB
  unsigned seed = 1;
};
struct Pull {
  const char* name;
  Point force;  // N
};

constexpr Pull kPulls[] = {
    {"small", {0, 0.01, 0.05}}, {"middle", {0, 0.03, 0.1}}, {"large", {0, 0.05, 0.22}}};
// Between samples, and how long the cable swings [s].
constexpr double kSample = 0.002, kSwings = 1.5;

struct Row {
  double t;
  std::array<double, 6> values;  // of the tip, then of the middle
};

std::vector<Row> Swing(const ChainCable& cable, MujocoChain* chain) {
  constexpr double kStep = MujocoChain::kStep;
  std::vector<Row> rows;
  const int between = static_cast<int>(std::lround(kSample / kStep));
  const int steps = static_cast<int>(std::lround(kSwings / kStep));
  for (int i = 0; i <= steps; ++i, chain->Step()) {
    if (i % between != 0) continue;
    const Point tip = chain->At(cable.length), middle = chain->At(cable.length / 2);
    rows.push_back({i * kStep, {tip[0], tip[1], tip[2], middle[0], middle[1], middle[2]}});
  }
  return rows;
}

/// Of a set: the widest channel's standard deviation, less the decibels.
double NoiseOf(const std::vector<Row>& rows, double snr) {
  double widest = 0;
  for (std::size_t c = 0; c < 6; ++c) {
    double sum = 0, squares = 0;
    for (const Row& row : rows) sum += row.values[c], squares += row.values[c] * row.values[c];
    const double mean = sum / static_cast<double>(rows.size());
    widest = std::max(widest, squares / static_cast<double>(rows.size()) - mean * mean);
  }
  return std::sqrt(widest) * std::pow(10, -snr / 20);
}

constexpr const char* kColumns[] = {"tip_x", "tip_y", "tip_z", "middle_x", "middle_y", "middle_z"};

void WriteRecord(const std::string& path, const std::vector<Row>& rows, const Options& options,
                 double noise, std::mt19937* random) {
  std::normal_distribution<double> normal(0, noise);
  std::ofstream file(path);
  file.precision(9);
  file << 't';
  for (const char* column : kColumns) file << ',' << column;
  file << '\n';
  for (const Row& row : rows) {
    if (row.t < options.cut - MujocoChain::kStep) continue;
    file << (row.t - options.cut) * options.clock + options.late;
    for (std::size_t c = 0; c < row.values.size(); ++c)
      file << ',' << (c < 3 ? 1 : options.scale) * row.values[c] + normal(*random);
    file << '\n';
  }
}

/// What the set says of an experiment: the cable along x at rest, without gravity.
std::string Experiment(const ChainCable& cable, const Pull& pull, const Point& held, double cut,
                       double noise) {
  std::ostringstream text;
  text.precision(9);
  text << "  - name: " << pull.name << "\n    gravity: [0, 0, -9.81]\n"
       << "    a: {pose: [0, 0, 0, 0, 0.7071067811865475, 0, 0.7071067811865475]}\n    b: free\n"
       << "    start: {";
  if (cut > 0)
    text << "unknown: true}\n";
  else
    text << "held: {s: " << cable.length << ", position: [" << held[0] << ", " << held[1] << ", "
         << held[2] << "]}}\n";
  text << "    record: " << pull.name << ".csv\n    channels:\n";
  for (int c = 0; c < 6; ++c)
    text << "      - {column: " << kColumns[c]
         << ", s: " << (c < 3 ? cable.length : cable.length / 2) << ", quantity: position, axis: "
         << "xyz"[c % 3] << ", sigma: " << noise << "}\n";
  return text.str();
}

void Write(const Options& options) {
  namespace fs = std::filesystem;
  const ChainCable& cable = options.cable;
  fs::create_directories(options.output);
  MujocoChain chain(cable, options.effects, fs::path(options.output) / "mujoco.xml");
  std::mt19937 random(options.seed);
  std::ostringstream set;
  // A tenth off, as a data sheet would be.
  set << "format: 1\ncable: {length: " << cable.length << ", diameter: " << cable.diameter
      << ", mass_per_length: " << cable.rhoA << ", EI: " << 1.1 * cable.EI << ", GJ: " << cable.EI
      << ", eta_EI: null, eta_GJ: null, uncertain: [EI, GJ, eta_EI, eta_GJ]}\nexperiments:\n";
  for (const Pull& pull : kPulls) {
    chain.HoldBy(pull.force);
    const Point held = chain.At(cable.length);
    const std::vector<Row> rows = Swing(cable, &chain);
    const double noise = NoiseOf(rows, options.snr);
    WriteRecord(fs::path(options.output) / (std::string(pull.name) + ".csv"), rows, options, noise,
                &random);
    set << Experiment(cable, pull, held, options.cut, noise);
    std::printf("%s: let go at %.4f %.4f %.4f m, noise %.2g m\n", pull.name, held[0], held[1],
                held[2], noise);
    std::fflush(stdout);
  }
  std::ofstream file(fs::path(options.output) / "measurement.yaml");
  if (!(file << set.str() << std::flush)) throw std::runtime_error("cannot write the set");
}

}  // namespace
}  // namespace cosserat_cable

int main(int argc, char** argv) {
  using namespace cosserat_cable;
  Options options;
  CLI::App app("A measurement set of MuJoCo's: three ring-downs of a cantilever");
  app.add_option("--output", options.output, "folder of the set")->required();
  ChainCable& cable = options.cable;
  ChainEffects& hidden = options.effects;
  app.add_option("--length", cable.length, "m")->capture_default_str();
  app.add_option("--EI", cable.EI, "N m^2")->capture_default_str();
  app.add_option("--eta_EI", cable.eta_EI, "N m^2 s")->capture_default_str();
  app.add_option("--drag", hidden.drag, "drag coefficient of the air");
  app.add_option("--external", hidden.external, "rate of a loss to the surroundings [1/s]");
  app.add_option("--eddy", hidden.eddy, "the same, of the outer half only [1/s]");
  app.add_option("--tip-mass", hidden.tip_mass, "kg");
  app.add_option("--clamp-spring", hidden.clamp_spring, "of a clamp that gives way [N m/rad]");
  app.add_option("--play", hidden.play, "half of the clamp's backlash [rad]");
  CLI::Option* stuck =
      app.add_option("--friction-EI", hidden.friction_EI, "what stuck strands add to EI [N m^2]");
  app.add_option("--friction", hidden.friction, "moment at which strands slip [N m]")->needs(stuck);
  app.add_option("--change", hidden.change, "of EI at large curvature, in parts of it");
  app.add_option("--change-curvature", hidden.change_curvature, "at half of that [1/m]")
      ->capture_default_str();
  app.add_option("--anisotropy", hidden.anisotropy, "EI (1 + this) about y, EI (1 - this) about z");
  app.add_option("--rest-curvature", hidden.rest_curvature, "about y [1/m]");
  app.add_option("--wall", hidden.wall, "how far behind the cable a wall stands [m]");
  app.add_option("--clock", options.clock, "rate of the record's clock")->capture_default_str();
  app.add_option("--late", options.late, "by which the record's times are too large [s]");
  app.add_option("--scale", options.scale, "of the middle's sensor")->capture_default_str();
  app.add_option("--cut", options.cut, "what is missing at the beginning [s]");
  app.add_option("--snr", options.snr, "signal to noise [dB]")->capture_default_str();
  app.add_option("--seed", options.seed, "of the noise")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    Write(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "mujoco_rig: %s\n", error.what());
    return 1;
  }
  return 0;
}
