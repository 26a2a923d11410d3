#include "stage_clock.h"

#include <algorithm>

namespace cosserat_cable {

StageCost& StageClock::Of(const std::string& stage) {
  const auto place = std::find_if(stages_.begin(), stages_.end(),
                                  [&](const StageCost& one) { return one.name == stage; });
  return place == stages_.end() ? *stages_.insert(place, {stage, 0, {}}) : *place;
}

void StageClock::Charge(const std::string& stage) {
  const Clock::time_point now = Clock::now();
  const SimulationCount count = RecordModel::CountOfAll();
  StageCost& cost = Of(stage);
  cost.seconds += std::chrono::duration<double>(now - charged_at_).count();
  cost.count += count - charged_;
  charged_ = count;
  charged_at_ = now;
}

void StageClock::Charge(const std::vector<StageCost>& stages) {
  for (const StageCost& stage : stages) {
    StageCost& cost = Of(stage.name);
    cost.seconds += stage.seconds;
    cost.count += stage.count;
  }
  charged_ = RecordModel::CountOfAll();
  charged_at_ = Clock::now();
}

double StageClock::seconds() const {
  return std::chrono::duration<double>(Clock::now() - begin_).count();
}

}  // namespace cosserat_cable
