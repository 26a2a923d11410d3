// What a simulation gets wrong in a measurement set, and why: a plain Kelvin-Voigt fit, what it
// leaves beside the noise, every cause that could explain it fitted through the simulation, and a
// verdict that may be "unexplained" or "the data cannot tell".
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cosserat_cable/fit/fit_problem.h"

namespace cosserat_cable {

/// Called during the work with what is done and how much of it is (0..1); false stops it.
using DiagnosisProgress = std::function<bool(const std::string& what, double part)>;

struct DiagnosisOptions {
  double time_budget = 300;  ///< [s]: candidates that are not fitted by then stay unfitted
  bool advise = true;        ///< look for the experiment that would tell rivals apart
  std::string memory;        ///< file of the fits made so far, to go on with; may be empty
  DiagnosisProgress progress;
  std::function<bool()> stop;
};

enum class Verdict {
  kNone,        ///< the recalibrated plain model leaves nothing but noise
  kNamed,       ///< every one of the causes is at work
  kAmbiguous,   ///< one of the causes, and the data cannot say which
  kUnexplained  ///< something is missing, and nothing in the library accounts for it
};
const char* ToString(Verdict verdict);

/// A number with its standard deviation; or why there is none.
struct FoundParameter {
  double value = 0, sd = 0;
  std::string unit;
  std::string reason;  ///< empty: it is determined
};

/// A cause, or several together, held against the set.
struct Candidate {
  std::vector<std::string> causes;
  bool fitted = false;  ///< false: the screening promised too little
  double promise = 0;   ///< part of the misfit that it explains to first order
  double share = 0;     ///< part of the misfit that it explains, fitted
  double chi2 = 0, samples = 0;
  double log_likelihood = 0;           ///< the noise's colour counted
  int parameters = 0;                  ///< that it adds
  bool adequate = false;               ///< it leaves nothing but noise
  double worse = 0, worse_se = 0;      ///< than the best, in noise variances; by paired blocks
  double heldout = 0, heldout_se = 0;  ///< likewise of what it predicts of records left out
  double gain = 0;       ///< of the predictions of records left out, over the plain model's
  std::string rejected;  ///< why it is not the answer; empty: it is, or may be
  std::map<std::string, FoundParameter> found;
};

/// A record beside what the models make of it; a row per sample, a column per channel.
struct RecordView {
  std::string experiment;
  std::vector<double> t;
  std::vector<std::string> columns;
  Eigen::MatrixXd measured, baseline, extended;  ///< the last empty where nothing was extended
  Eigen::VectorXd noise;                         ///< standard deviation by channel
};

struct GainEstimate {
  double value = 0, low = 0, high = 0;  ///< 95 %
  double rms_baseline = 0, rms_extended = 0;
};

struct DiagnosisStage {
  std::string name;
  double seconds = 0;
  SimulationCount count;
};

struct Diagnosis {
  bool ok = false;
  bool interrupted = false;
  std::string message;  ///< why there is no diagnosis
  Verdict verdict = Verdict::kUnexplained;
  std::vector<std::string> causes;
  std::string sentence;  ///< the verdict in words
  std::map<std::string, FoundParameter> baseline, extended;
  double baseline_log_likelihood = 0, baseline_freedom = 0;  ///< the noise's colour counted
  double baseline_times_noise = 0;  ///< rms of what the plain fit leaves, by the noise
  double extended_times_noise = 0;
  bool noise_known = true;
  double noise_floor = 0;   ///< [unit of the positions, or of all channels where they share one]
  double rms_baseline = 0;  ///< on records that no fit saw, likewise
  std::optional<GainEstimate> gain;
  std::vector<Candidate> candidates;  ///< the best first
  std::string next_experiment;
  CableKeys baseline_cable;   ///< the recalibrated plain one
  bool has_extended = false;  ///< where named, and for the likeliest of what is ambiguous
  std::vector<std::string> extended_causes;
  MeasurementSet extended_set;  ///< with their numbers
  std::vector<RecordView> records;
  std::vector<std::string> warnings;
  std::vector<DiagnosisStage> stages;
  double seconds = 0;
};

/// Mistakes of the set go to `problems`.
Diagnosis Diagnose(const MeasurementSet& set, const DiagnosisOptions& options, Problems* problems);

}  // namespace cosserat_cable
