// mujoco_rig: a measurement set whose records are MuJoCo's, which has the cable as rigid pieces in
// ball joints: three ring-downs of a cantilever, pulled aside by a force at its tip and let go.
//   mujoco_rig --output DIR [--drag CD] [--external RATE] [--cut S] [--snr DB] [--seed N]
// With --cut the first seconds are missing, and starts are unknown. It takes a minute or two.
#include <mujoco/mujoco.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using Point = std::array<double, 3>;

struct Cable {
  double length = 0.3, diameter = 0.006, rhoA = 0.06;  // m, m, kg/m
  double EI = 0.004, eta_EI = 8e-6;                    // N m^2, N m^2 s; a ball joint twists alike
};
struct Loss {
  double drag = 0, external = 0;  // drag coefficient, rate [1/s]
};
struct Options {
  std::string output;
  Loss loss;
  double cut = 0;   // s
  double snr = 40;  // dB
  unsigned seed = 1;
};
struct Pull {
  const char* name;
  Point force;  // N
};

constexpr Pull kPulls[] = {
    {"small", {0, 0.01, 0.05}}, {"middle", {0, 0.03, 0.1}}, {"large", {0, 0.05, 0.22}}};
constexpr int kPieces = 30;
// Of MuJoCo's steps of first order [s]; while the cable is pulled aside; between samples.
constexpr double kStep = 1e-5, kPullStep = 5e-5, kSample = 0.002;
// How long it is pulled, the force growing over a quarter of it, by joints that are damped like
// this [N m s] then; how long it swings [s].
constexpr double kPulled = 1.5, kPullDamping = 0.1, kSwings = 1.5;
constexpr double kAirDensity = 1.2;  // kg/m^3

std::string Xml(const Cable& cable) {
  const double h = cable.length / kPieces, r = cable.diameter / 2, mass = cable.rhoA * h;
  std::ostringstream xml;
  xml.precision(17);
  xml << "<mujoco><option timestep='" << kStep << "' integrator='Euler' gravity='0 0 -9.81'>"
      << "<flag contact='disable'/></option><worldbody>";
  for (int i = 0; i < kPieces; ++i) {
    // The joint at the clamp has half a piece to bend.
    const double shorter = i == 0 ? 2 : 1;
    xml << "<body pos='" << (i == 0 ? 0 : h) << " 0 0'><inertial pos='" << h / 2 << " 0 0' mass='"
        << mass << "' diaginertia='" << mass * r * r / 2;
    for (int k = 0; k < 2; ++k) xml << ' ' << mass * (3 * r * r + h * h) / 12;
    xml << "'/><joint type='ball' stiffness='" << shorter * cable.EI / h << "' damping='"
        << shorter * cable.eta_EI / h << "'/>";
  }
  for (int i = 0; i < kPieces; ++i) xml << "</body>";
  xml << "</worldbody></mujoco>";
  return xml.str();
}

class Chain {
 public:
  /// Its model is written to `path`.
  Chain(const Cable& cable, const Loss& loss, const std::string& path)
      : cable_(cable), loss_(loss) {
    std::ofstream(path) << Xml(cable);
    char error[1000] = "";
    model_.reset(mj_loadXML(path.c_str(), nullptr, error, sizeof error));
    if (!model_) throw std::runtime_error(error);
    data_.reset(mj_makeData(model_.get()));
  }

  /// At rest, its tip pulled by a force; the force is gone then.
  void HoldBy(const Point& force) {
    mj_resetData(model_.get(), data_.get());
    const std::vector<double> own(model_->dof_damping, model_->dof_damping + model_->nv);
    std::fill_n(model_->dof_damping, model_->nv, kPullDamping);
    model_->opt.timestep = kPullStep;
    const int steps = static_cast<int>(std::lround(kPulled / kPullStep));
    for (int i = 0; i < steps; ++i) {
      mj_forward(model_.get(), data_.get());
      const double part = std::min(1.0, 4.0 * i / steps);
      Clear();
      Push({part * force[0], part * force[1], part * force[2]}, At(cable_.length), kPieces);
      mj_step(model_.get(), data_.get());
    }
    std::copy(own.begin(), own.end(), model_->dof_damping);
    model_->opt.timestep = kStep;
    mju_zero(data_->qvel, model_->nv);
    Clear();
    mj_forward(model_.get(), data_.get());
  }

  void Step() {
    if (loss_.drag > 0 || loss_.external > 0) {
      mj_forward(model_.get(), data_.get());
      Clear();
      for (int body = 1; body <= kPieces; ++body) AddLosses(body);
    }
    mj_step(model_.get(), data_.get());
  }

  /// Where the axis is at an arc length.
  Point At(double s) {
    const double h = cable_.length / kPieces;
    const int piece = std::min(kPieces - 1, static_cast<int>(std::floor(s / h - 1e-9)));
    const mjtNum* R = data_->xmat + 9 * (piece + 1);
    const mjtNum* p = data_->xpos + 3 * (piece + 1);
    const double along = s - piece * h;
    return {p[0] + R[0] * along, p[1] + R[3] * along, p[2] + R[6] * along};
  }

 private:
  struct Delete {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* data) const { mj_deleteData(data); }
  };

  void Clear() { mju_zero(data_->qfrc_applied, model_->nv); }
  void Push(const Point& force, const Point& at, int body) {
    const mjtNum none[3] = {0, 0, 0};
    mj_applyFT(model_.get(), data_.get(), force.data(), none, at.data(), body, data_->qfrc_applied);
  }
  void AddLosses(int body) {
    mjtNum velocity[6];
    mj_objectVelocity(model_.get(), data_.get(), mjOBJ_BODY, body, velocity, 0);
    const mjtNum* R = data_->xmat + 9 * body;
    const Point v = {velocity[3], velocity[4], velocity[5]};
    const double along = v[0] * R[0] + v[1] * R[3] + v[2] * R[6];
    const Point across = {v[0] - along * R[0], v[1] - along * R[3], v[2] - along * R[6]};
    const double h = cable_.length / kPieces;
    const double by_drag = 0.5 * kAirDensity * loss_.drag * cable_.diameter * h *
                           std::hypot(across[0], across[1], across[2]);
    const double by_rate = loss_.external * cable_.rhoA * h;
    const mjtNum* centre = data_->xipos + 3 * body;
    Point force;
    for (std::size_t k = 0; k < 3; ++k) force[k] = -by_drag * across[k] - by_rate * v[k];
    Push(force, {centre[0], centre[1], centre[2]}, body);
  }

  Cable cable_;
  Loss loss_;
  std::unique_ptr<mjModel, Delete> model_;
  std::unique_ptr<mjData, Delete> data_;
};

struct Row {
  double t;
  std::array<double, 6> values;  // of the tip, then of the middle
};

std::vector<Row> Swing(const Cable& cable, Chain* chain) {
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

void WriteRecord(const std::string& path, std::vector<Row> rows, double cut, double noise,
                 std::mt19937* random) {
  std::normal_distribution<double> normal(0, noise);
  std::ofstream file(path);
  file.precision(9);
  file << 't';
  for (const char* column : kColumns) file << ',' << column;
  file << '\n';
  for (Row& row : rows) {
    if (row.t < cut - kStep) continue;
    file << row.t - cut;
    for (const double y : row.values) file << ',' << y + normal(*random);
    file << '\n';
  }
}

/// What the set says of an experiment: the cable along x at rest, without gravity.
std::string Experiment(const Cable& cable, const Pull& pull, const Point& held, double cut,
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
  const Cable cable;
  fs::create_directories(options.output);
  Chain chain(cable, options.loss, fs::path(options.output) / "mujoco.xml");
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
    WriteRecord(fs::path(options.output) / (std::string(pull.name) + ".csv"), rows, options.cut,
                noise, &random);
    set << Experiment(cable, pull, held, options.cut, noise);
    std::printf("%s: let go at %.4f %.4f %.4f m, noise %.2g m\n", pull.name, held[0], held[1],
                held[2], noise);
    std::fflush(stdout);
  }
  std::ofstream file(fs::path(options.output) / "measurement.yaml");
  if (!(file << set.str() << std::flush)) throw std::runtime_error("cannot write the set");
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("A measurement set of MuJoCo's: three ring-downs of a cantilever");
  app.add_option("--output", options.output, "folder of the set")->required();
  app.add_option("--drag", options.loss.drag, "drag coefficient of the air");
  app.add_option("--external", options.loss.external, "rate of a loss to the surroundings [1/s]");
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
