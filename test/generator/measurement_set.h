#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "noise.h"
#include "rigs.h"

namespace cosserat_cable::generator {

/// An experiment with what its sensors showed.
struct MeasuredExperiment {
  Experiment experiment;
  Eigen::MatrixXd values;  ///< noisy, times x channels
  Eigen::VectorXd sigma;   ///< of each channel's noise
  std::vector<bool> told;  ///< whether the set says so
  bool unknown_start = false;
};

/// Experiments, what is said to be known of the cable, and the truth.
struct MeasurementSet {
  std::string rig;
  std::uint64_t seed = 0;
  double snr = 0.0;  ///< [dB]
  CableData truth;   ///< length as in the set's `cable`
  double D_E = 0.0;  ///< [N m s]
  double EI_guess = 0.0, GJ_guess = 0.0;
  std::vector<std::string> uncertain;
  std::vector<EffectChoice> effects;  ///< as simulated; nothing but truth.json tells of them
  std::vector<MeasuredExperiment> experiments;
};

/// Simulates the experiments, leaves out position channels that barely move, and adds noise; says
/// of every second channel how large it is.
std::vector<MeasuredExperiment> measure(const std::vector<Experiment>& experiments, double snr,
                                        Random* random, const Accuracy& accuracy = {});

/// Takes the first samples away, up to `time` [s] after the release, and with them what the set
/// knows of the start.
void forgetStart(double time, MeasuredExperiment* measured);

/// JSON of the effects that are simulated: the members `effects` and `effect_parameters`, each
/// line with a comma at its end.
std::string effectsJson(const std::vector<EffectChoice>& effects);

/// Writes what a user of the rig would have, without the truth.
void writeMeasurement(const MeasurementSet& set, const std::string& folder);

/// Writes text, which a decimal number with all its digits is in JSON and YAML; throws
/// std::runtime_error naming the file.
std::string number(double value);
void writeFile(const std::string& path, const std::string& text);

/// Writes measurement.yaml, a CSV file per experiment (and per motion of a clamp, clamp_a_NAME.csv,
/// and per slow load, load_NAME.csv) and truth.json into a folder, which is made.
/// Throws std::runtime_error naming the file that could not be written.
void writeSet(const MeasurementSet& set, const std::string& folder);

}  // namespace cosserat_cable::generator
