#include "measurement_set.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "effects/kinds.h"

namespace cosserat_cable::generator {

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.17g", value);
  std::string result = text;
  // YAML readers take a number without point or exponent for an integer, which is harmless; "1e-05"
  // without a point is a string to some.
  const size_t exponent = result.find('e');
  if (exponent != std::string::npos && result.find('.') == std::string::npos) {
    result.insert(exponent, ".0");
  }
  return result;
}

namespace {

using Quantity = Channel::Quantity;

// A camera shows a coordinate that moves by less than this part of the others as noise only.
constexpr double kLeastMotion = 0.1;

std::string list(const Eigen::Ref<const Eigen::VectorXd>& values) {
  std::string text = "[";
  for (int i = 0; i < values.size(); ++i) text += (i > 0 ? ", " : "") + number(values[i]);
  return text + "]";
}

std::string pose(const FrameMotion& frame) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(frame.R).normalized();
  Eigen::Matrix<double, 7, 1> values;
  values << frame.p, q.coeffs();
  return list(values);
}

const char* name(Quantity quantity) {
  switch (quantity) {
    case Quantity::kPosition:
      return "position";
    case Quantity::kVelocity:
      return "velocity";
    case Quantity::kAcceleration:
      return "acceleration";
    case Quantity::kAngle:
      return "angle";
    case Quantity::kRate:
      return "rate";
  }
  throw std::logic_error("unknown quantity");
}

std::string experimentYaml(const MeasuredExperiment& measured, double set_length) {
  const Experiment& e = measured.experiment;
  std::ostringstream out;
  out << "  - name: " << e.name << "\n    kind: " << e.kind << "\n";
  if (e.cable.length != set_length) {
    out << "    specimen: {length: " << number(e.cable.length) << "}\n";
  }
  out << "    gravity: " << list(e.gravity) << "\n    a: ";
  if (e.drive) {
    out << "{motion: clamp_a_" << e.name << ".csv}\n";
  } else {
    out << "{pose: " << pose(e.a) << "}\n";
  }
  if (e.b) {
    out << "    b: {pose: " << pose(*e.b) << "}\n";
  } else if (e.disc) {
    out << "    b: {disc: {inertia: " << number(e.disc->inertia)
        << ", mass: " << number(e.disc->mass) << (e.guided ? ", guided: true" : "") << "}}\n";
  } else {
    out << "    b: free\n";
  }
  if (measured.unknown_start) {
    out << "    start: {unknown: true}\n";
  } else if (e.held) {
    out << "    start: {held: {s: " << number(e.cable.length) << ", position: " << list(*e.held)
        << "}}\n";
  } else if (e.disc) {
    out << "    start: {twisted: " << number(e.twisted) << "}\n";
  } else {
    out << "    start: {rest: true}\n";
  }
  if (!e.tip_forces.empty()) out << "    load: load_" << e.name << ".csv\n";
  out << "    record: " << e.name << ".csv\n    channels:\n";
  for (size_t c = 0; c < e.channels.size(); ++c) {
    const Channel& channel = e.channels[c];
    out << "      - {column: " << channel.column << ", s: " << number(channel.s)
        << ", quantity: " << name(channel.quantity);
    if (channel.quantity < Quantity::kAngle)
      out << ", axis: "
          << "xyz"[channel.axis];
    if (measured.told[c]) out << ", sigma: " << number(measured.sigma[c]);
    out << "}\n";
  }
  return out.str();
}

std::string setYaml(const MeasurementSet& set) {
  const CableData& cable = set.truth;
  std::ostringstream out;
  out << "format: 1\ncable:\n  length: " << number(cable.length)
      << "\n  diameter: " << number(cable.diameter) << "\n  mass_per_length: " << number(cable.rhoA)
      << "\n  EI: " << number(set.EI_guess) << "\n  GJ: " << number(set.GJ_guess)
      << "\n  eta_EI: null\n  eta_GJ: null\n";
  if (!cable.masses.empty()) {
    out << "  masses: [";
    for (size_t i = 0; i < cable.masses.size(); ++i) {
      out << (i > 0 ? ", " : "") << "{s: " << number(cable.masses[i].s)
          << ", mass: " << number(cable.masses[i].mass) << "}";
    }
    out << "]\n";
  }
  out << "  uncertain: [";
  for (size_t i = 0; i < set.uncertain.size(); ++i) out << (i > 0 ? ", " : "") << set.uncertain[i];
  out << "]\nexperiments:\n";
  for (const MeasuredExperiment& e : set.experiments) out << experimentYaml(e, cable.length);
  return out.str();
}

std::string truthJson(const MeasurementSet& set) {
  std::ostringstream out;
  out << "{\n  \"format\": 1,\n  \"rig\": \"" << set.rig << "\",\n  \"seed\": " << set.seed
      << ",\n  \"snr_db\": " << number(set.snr)
      << ",\n  \"parameters\": {\"EI\": " << number(set.truth.EI)
      << ", \"eta_EI\": " << number(set.truth.eta_EI) << ", \"GJ\": " << number(set.truth.GJ)
      << ", \"eta_GJ\": " << number(set.truth.eta_GJ) << ", \"D_E\": " << number(set.D_E) << "},\n"
      << effectsJson(set.effects) << "  \"sigma\": {";
  for (size_t i = 0; i < set.experiments.size(); ++i) {
    const MeasuredExperiment& e = set.experiments[i];
    out << (i > 0 ? "," : "") << "\n    \"" << e.experiment.name << "\": {";
    for (size_t c = 0; c < e.experiment.channels.size(); ++c) {
      out << (c > 0 ? ", " : "") << "\"" << e.experiment.channels[c].column
          << "\": " << number(e.sigma[c]);
    }
    out << "}";
  }
  out << "\n  }\n}\n";
  return out.str();
}

/// The motion of clamp a that the set states, and a little longer than the record.
std::string motionCsv(const Experiment& e) {
  constexpr double kRate = 1000.0, kLonger = 0.05;  // [Hz], [s]
  const FrameCurve curve = excite(*e.drive);
  const int last = static_cast<int>(kRate * (e.times[e.times.size() - 1] + kLonger)) + 1;
  std::string text = "t,x,y,z,qx,qy,qz,qw\n";
  for (int i = 0; i <= last; ++i) {
    const FrameMotion m = curve(i / kRate);
    Eigen::Quaterniond q(m.R);
    if (q.w() < 0.0) q.coeffs() *= -1.0;
    text += number(i / kRate);
    for (double x : {m.p.x(), m.p.y(), m.p.z(), q.x(), q.y(), q.z(), q.w()})
      text += "," + number(x);
    text += "\n";
  }
  return text;
}

std::string loadCsv(const Experiment& e) {
  std::string text = "step,s,fx,fy,fz\n";
  for (size_t i = 0; i < e.tip_forces.size(); ++i) {
    text += std::to_string(i) + "," + number(e.cable.length);
    for (int d = 0; d < 3; ++d) text += "," + number(e.tip_forces[i][d]);
    text += "\n";
  }
  return text;
}

std::string recordCsv(const MeasuredExperiment& measured) {
  std::string text = measured.experiment.tip_forces.empty() ? "t" : "step";
  for (const Channel& channel : measured.experiment.channels) text += "," + channel.column;
  text += "\n";
  for (int i = 0; i < measured.values.rows(); ++i) {
    text += number(measured.experiment.times[i]);
    for (int c = 0; c < measured.values.cols(); ++c) text += "," + number(measured.values(i, c));
    text += "\n";
  }
  return text;
}

}  // namespace

std::string effectsJson(const std::vector<EffectChoice>& effects) {
  std::string names, paths;
  for (const EffectChoice& choice : effects) {
    names += std::string(names.empty() ? "" : ", ") + "\"" + choice.kind->name + "\"";
    for (const auto& [path, value] : choice.values) {
      paths += std::string(paths.empty() ? "" : ",") + "\n    \"" + effectPath(*choice.kind, path) +
               "\": " + number(value);
    }
  }
  return "  \"effects\": [" + names + "],\n  \"effect_parameters\": {" + paths +
         (paths.empty() ? "" : "\n  ") + "},\n";
}

void writeFile(const std::string& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::runtime_error("could not write " + path);
}

std::vector<MeasuredExperiment> measure(const std::vector<Experiment>& experiments, double snr,
                                        Random* random, const Accuracy& accuracy) {
  std::vector<MeasuredExperiment> result;
  bool tell = random->chance(0.5);
  for (const Experiment& experiment : experiments) {
    const Record record = simulate(experiment, accuracy);
    const int count = static_cast<int>(experiment.channels.size());
    Eigen::VectorXd sigma(count);
    double largest = 0.0;
    for (int c = 0; c < count; ++c) {
      sigma[c] = noiseSigma(record.values.col(c), record.rest[c], snr);
      if (experiment.channels[c].quantity == Quantity::kPosition) {
        largest = std::max(largest, sigma[c]);
      }
    }
    MeasuredExperiment measured;
    measured.experiment = experiment;
    measured.experiment.channels.clear();
    std::vector<int> kept;
    for (int c = 0; c < count; ++c) {
      const bool still = experiment.channels[c].quantity == Quantity::kPosition &&
                         sigma[c] < kLeastMotion * largest;
      if (!still) kept.push_back(c);
    }
    measured.values.resize(experiment.times.size(), kept.size());
    measured.sigma.resize(kept.size());
    for (size_t k = 0; k < kept.size(); ++k) {
      measured.experiment.channels.push_back(experiment.channels[kept[k]]);
      measured.values.col(k) = record.values.col(kept[k]);
      measured.sigma[k] = sigma[kept[k]];
      measured.told.push_back(tell);
      tell = !tell;
      addNoise(measured.sigma[k], random, measured.values.col(k));
    }
    result.push_back(measured);
  }
  return result;
}

void forgetStart(double time, MeasuredExperiment* measured) {
  Eigen::VectorXd& times = measured->experiment.times;
  const auto first = std::lower_bound(times.begin(), times.end(), time) - times.begin();
  const Eigen::Index left = times.size() - first;
  if (left < 2) throw std::logic_error("no record is left");
  times = times.tail(left).eval();
  measured->values = measured->values.bottomRows(left).eval();
  measured->unknown_start = true;
}

void writeMeasurement(const MeasurementSet& set, const std::string& folder) {
  const std::filesystem::path path(folder);
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw std::runtime_error("could not make " + folder + ": " + error.message());
  writeFile((path / "measurement.yaml").string(), setYaml(set));
  for (const MeasuredExperiment& e : set.experiments) {
    const Experiment& experiment = e.experiment;
    writeFile((path / (experiment.name + ".csv")).string(), recordCsv(e));
    if (experiment.drive) {
      writeFile((path / ("clamp_a_" + experiment.name + ".csv")).string(), motionCsv(experiment));
    }
    if (!experiment.tip_forces.empty()) {
      writeFile((path / ("load_" + experiment.name + ".csv")).string(), loadCsv(experiment));
    }
  }
}

void writeSet(const MeasurementSet& set, const std::string& folder) {
  writeMeasurement(set, folder);
  writeFile((std::filesystem::path(folder) / "truth.json").string(), truthJson(set));
}

}  // namespace cosserat_cable::generator
