// What the parts of a work take.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "cosserat_cable/identification/estimation.h"

namespace cosserat_cable {

/// Runs from its making on. Every moment belongs to one stage, so that they add up to the whole.
class StageClock {
 public:
  /// What has passed, and what has been simulated in this process, since the last charge belongs to
  /// this stage.
  void Charge(const std::string& stage);
  /// The same, where a clock of its own has told these parts.
  void Charge(const std::vector<StageCost>& stages);
  /// [s] since it was made.
  double seconds() const;
  /// In the order in which they were first charged.
  const std::vector<StageCost>& stages() const { return stages_; }

 private:
  using Clock = std::chrono::steady_clock;
  StageCost& Of(const std::string& stage);

  Clock::time_point begin_ = Clock::now(), charged_at_ = begin_;
  SimulationCount charged_ = RecordModel::CountOfAll();
  std::vector<StageCost> stages_;
};

}  // namespace cosserat_cable
