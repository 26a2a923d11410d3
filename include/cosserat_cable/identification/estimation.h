// The parameters of a cable from all records of a measurement set at once, through the simulation,
// with what the data say about their uncertainty.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "cosserat_cable/fit/information.h"
#include "cosserat_cable/fit/noise_level.h"
#include "cosserat_cable/fit/record_model.h"
#include "cosserat_cable/fit/unknowns.h"
#include "cosserat_cable/identification/reference_models.h"
#include "cosserat_cable/input/problems.h"

namespace cosserat_cable {

/// Called during the work with what is done and how much of it is (0..1); false stops it.
using EstimationProgress = std::function<bool(const std::string& what, double part)>;

struct EstimationOptions {
  UnknownOptions unknowns;
  bool profiles = true;
  /// Use what is left of records that are clipped, frozen or have gaps, and records shorter than a
  /// period; otherwise they count for nothing.
  bool use_damaged = false;
  /// Whether parameters may differ from record to record where the records say so.
  bool scatter = true;
  /// Whether records that do not fit are searched for slips.
  bool slips = true;
  /// Values to begin from besides the set's own, by name (the direct evaluation's).
  std::vector<std::pair<std::string, double>> guesses;
  EstimationProgress progress;
  /// Asked in any thread; true ends the work at once, with what was found until then.
  std::function<bool()> stop;
  /// The work ends with what was found when it has taken this long [s]; 0: when it is done.
  double time_budget = 0;
};

/// The likelihood along one parameter, all others at their best.
struct Profile {
  std::vector<double> value;
  std::vector<double> deviance;  ///< twice the loss of log-likelihood, the noise's colour counted
};

struct ParameterEstimate {
  Unknown unknown;
  bool determined = false;
  double value = 0;  ///< where it is not determined: what the simulation was left with
  double sd = 0;
  double low = 0, high = 0;  ///< 95 %, from the profile where there is one
  double quantile = 0;       ///< standard deviations to the ends of the curvature's interval
  std::string reason;        ///< why it is not determined
  /// Why value and interval are not to be trusted: a slip that is suspected, or no minimum.
  std::string doubt;
  Profile profile;
};

struct ChannelFit {
  std::string column;
  double sigma = 0;  ///< what weighted the samples [the channel's unit]
  bool sigma_given = false;
  NoiseLevel noise;
  double rms = 0;                  ///< of the residual
  double times_noise = 0;          ///< how many times the noise that is; 0: unknown
  bool misfit = false;             ///< clearly more than noise
  ReferenceResiduals reference;    ///< what models without mechanics leave
  double correlation_samples = 1;  ///< how many residuals in a row are worth one
};

/// A channel, or a whole record, that would fit if it had been recorded, or the cable loaded,
/// otherwise than the set says. A suggestion: nothing is changed by it.
struct ChannelSlip {
  std::string experiment;
  std::string column;  ///< empty: the whole record
  /// offset, sign, unit, gain, axis, swapped, delay; of the whole record start, delay, clock, load,
  /// mass, motion, gravity or parameter
  std::string kind;
  /// record = factor * truth + constant; of a clock, the record's times over the truth; of load,
  /// mass, motion and parameter, the truth over what the set gives
  double factor = 1;
  double constant = 0;  ///< [the channel's unit]
  double delay = 0;     ///< [s] by which the record's times are late
  std::string shows;    ///< the axis or column that it shows instead
  double before = 0;    ///< what is left, in times the noise
  double after = 0;     ///< with the slip mended
  std::string text;     ///< in words
  /// Of what was recorded: only without the record is it out of the way. Else of what acts on the
  /// cable.
  bool of_record = true;
  bool of_set = false;  ///< it holds for all records of the set
  /// The cable's parameters with the slip mended, from this record alone.
  std::vector<std::pair<std::string, double>> values;
};

struct ExperimentFit {
  Eigen::MatrixXd simulated;  ///< with offsets; a row per sample, a column per channel
  std::vector<ChannelFit> channels;
  bool left_out = false;  ///< the record counted for nothing
};

/// What a part of the work took.
struct StageCost {
  std::string name;
  double seconds = 0;
  SimulationCount count;
};

struct Estimation {
  bool ok = false;
  bool interrupted = false;  ///< by `stop` or `progress`; what there is was found until then
  bool converged = false;    ///< false: no minimum was reached, for a reason that a warning tells
  std::string message;       ///< why there is none
  std::vector<ParameterEstimate> parameters;
  std::vector<Combination> combinations;
  Eigen::MatrixXd correlation;  ///< of all unknowns; zero rows where not determined
  std::vector<ExperimentFit> experiments;
  std::vector<ParameterScatter> scatter;  ///< between records; it is in the intervals
  CableKeys cable;                        ///< the set's, with the determined parameters filled in
  std::vector<std::string> warnings;
  std::vector<ChannelSlip> slips;  ///< what would explain records that do not fit
  double discretisation = 0;       ///< what the steps did to the records, corrected; parts of range
  double seconds = 0;
  std::vector<StageCost> stages;  ///< of all of that, in the order in which they were first entered
};

/// Mistakes of the set go to `problems`.
Estimation Estimate(const MeasurementSet& set, const EstimationOptions& options,
                    Problems* problems);

}  // namespace cosserat_cable
