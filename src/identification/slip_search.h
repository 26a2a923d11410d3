// The slips of one record.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cosserat_cable/fit/damage.h"
#include "cosserat_cable/identification/estimation.h"
#include "input_slips.h"
#include "slip_model.h"

namespace cosserat_cable {

/// A channel is looked at where its residual is so many times the noise, squared.
inline constexpr double kFarAbove = 4.0;
/// Of what is left above the noise, a slip must explain this share, and leave little beside the
/// rest.
inline constexpr double kExplains = 0.9;
/// What a slip leaves, in the noise's variance: with more, it stands for what the model lacks.
inline constexpr double kFaithful = 25;
/// No noise is taken to be less than this part of a channel's range where its level is unknown; and
/// a residual beyond this part is looked at then.
inline constexpr double kUnknownLevel = 0.005, kUnknownMisfit = 0.05;

/// Of the cable's parameters, by name.
using Values = std::vector<std::pair<std::string, double>>;
using Points = std::vector<Values>;

bool IsStiffness(const std::string& parameter);

/// What was found for a record.
struct Found {
  FormFit fit;
  double complexity = 0;
  const InputSlip* input = nullptr;
  double factor = 1;  ///< of the input
  Values values;
};

/// What was found beside the channels in another record, and the parameters with it mended.
struct KnownSlip {
  InputSlip input;
  double factor = 1;
  Values values;

  void Mend(MeasurementSet* set) const { input.change(factor, set); }
};

class SlipSearch {
 public:
  /// `also_parameters`: also stiffnesses that the set says to be known.
  SlipSearch(const MeasurementSet& set, int experiment, const ExperimentFit& fit,
             const Points& points, const std::optional<KnownSlip>& known,
             const std::function<bool()>& stop, bool also_parameters = true)
      : set_(set),
        known_(known),
        index_(experiment),
        experiment_(set.experiments[static_cast<std::size_t>(experiment)]),
        usable_(UsableSamples(experiment_.record)),
        level_(Levels(fit)),
        points_(points),
        stop_(stop),
        model_(set, experiment, level_, usable_, points, stop),
        inputs_(InputSlips(set, static_cast<std::size_t>(experiment))) {
    before_ = Left(fit);
    if (also_parameters) return;
    const auto is_parameter = [](const InputSlip& input) { return !input.named.empty(); };
    inputs_.erase(std::remove_if(inputs_.begin(), inputs_.end(), is_parameter), inputs_.end());
  }

  std::vector<ChannelSlip> Find();
  /// The parameters with which the record fits as it is, alone; none where it does not.
  const std::optional<Values>& alone() const { return alone_; }
  /// What was found, where it is beside the channels.
  const std::optional<KnownSlip>& input() const { return input_; }

 private:
  Eigen::VectorXd Levels(const ExperimentFit& fit) const;
  Eigen::VectorXd Left(const ExperimentFit& fit) const;
  std::vector<RecordForm> Forms(const std::vector<bool>& suspects) const;
  FormFit Simplest(const FormFit& fit) const;
  bool IsAsGood(const FormFit& simple, const FormFit& rich, Eigen::Index identity) const;
  bool OfUnit(std::size_t channel, double factor) const;
  double ComplexityOf(const RecordForm& form) const;
  bool Explains(const FormFit& fit, double least, bool simplest = true) const;
  void SnapToUnits(RecordForm* form) const;
  std::vector<Found> OfChannels(const FormFit& looked, const FormFit& plain, double least) const;
  std::vector<Found> OfInputs(const FormFit& looked, const FormFit& plain, double least,
                              const std::vector<Found>& beside) const;
  std::optional<Found> OfInput(const InputSlip& input, double factor, const FormFit& looked,
                               double least) const;
  double BestFactor(const InputSlip& input, const FormFit& plain) const;
  bool IsHealthy(const FormFit& plain, const std::optional<Found>& same) const;
  FormFit WholeOf(const SlipModel& model, const FormFit& part, double least) const;
  double FarFromSet(const SlipModel& model, const FormFit& fit) const;
  std::vector<ChannelSlip> Words(const Found& found, const std::vector<const Found*>& others) const;
  ChannelSlip OfChannel(std::size_t channel, const FormFit& fit) const;
  ChannelSlip OfClock(const FormFit& fit) const;
  ChannelSlip OfInput(const Found& found) const;

  const MeasurementSet& set_;
  std::optional<KnownSlip> known_;
  int index_;
  const Experiment& experiment_;
  Eigen::MatrixXd usable_;
  Eigen::VectorXd level_;
  const Points& points_;
  std::function<bool()> stop_;
  SlipModel model_;
  std::vector<InputSlip> inputs_;
  Eigen::VectorXd before_;  // by channel, mean square left over the level's
  std::optional<KnownSlip> input_;
  std::optional<Values> alone_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace cosserat_cable
