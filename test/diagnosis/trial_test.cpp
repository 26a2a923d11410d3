// Hypotheses on a set: what they free, and which channels they concern.
#include "../../src/diagnosis/trial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "../measurement/rigs.h"

namespace cosserat_cable {
namespace {

/// Positions of the middle and of the end, and the force at the clamp.
MeasurementSet ThreeSensors() {
  MeasurementSet set;
  Experiment experiment = testing::RingDown(0.02, 1.0, 101);
  experiment.channels.clear();
  const auto add = [&](const std::string& column, double s, Quantity quantity) {
    Channel channel = testing::ChannelAt(s, quantity);
    channel.column = column;
    experiment.channels.push_back(channel);
  };
  add("middle_x", 0.125, Quantity::kPosition);
  add("end_x", 0.25, Quantity::kPosition);
  add("force_x", 0.0, Quantity::kForce);
  set.experiments = {experiment};
  return set;
}

MotionScales Scales() {
  MotionScales scales;
  scales.EI = scales.GJ = scales.length = scales.shortest = scales.period = scales.clamp_moment = 1;
  return scales;
}

TEST(TrialTest, ASensorMayBeWrongForAllItsKindOrOnePlace) {
  std::set<std::vector<std::string>> groups;
  for (const Trial& trial : AllTrials(ThreeSensors(), Scales()))
    if (trial.cause == "sensor") groups.insert(trial.channels);
  const std::set<std::vector<std::string>> expected = {
      {}, {"end_x", "middle_x"}, {"end_x"}, {"force_x"}, {"middle_x"}};
  EXPECT_EQ(groups, expected);
}

TEST(TrialTest, TheExtendedSetSaysWhichChannels) {
  const MeasurementSet set = ThreeSensors();
  const std::vector<Trial> all = AllTrials(set, Scales());
  const auto trial = std::find_if(all.begin(), all.end(), [](const Trial& one) {
    return one.channels == std::vector<std::string>{"force_x"};
  });
  ASSERT_NE(trial, all.end());
  const MeasurementSet extended = WithTrials(set, {*trial});
  ASSERT_TRUE(extended.cable.faults.value);
  ASSERT_EQ(extended.cable.faults.value->sensor.size(), 1u);
  EXPECT_EQ(extended.cable.faults.value->sensor[0].channels, trial->channels);
}

TEST(TrialTest, OnlySizesBelowTheLeastAreFaint) {
  for (const Trial& trial : AllTrials(ThreeSensors(), Scales())) {
    const auto at = [&](double size) {
      return trial.IsFaint([&](const std::string& path) {
        const bool factor =
            path.find("scale") != std::string::npos || path.find("amplitude") != std::string::npos;
        return (factor ? 1 : 0) + size;
      });
    };
    const std::vector<std::string> paths = trial.FreePaths();
    const bool low_pass_or_bracket =
        std::any_of(paths.begin(), paths.end(), [](const std::string& path) {
          return path.find("low_pass") != std::string::npos ||
                 path.find("bracket") != std::string::npos;
        });
    const bool can_be =
        (trial.cause == "sensor" || trial.cause == "base_motion") && !low_pass_or_bracket;
    EXPECT_EQ(at(1e-6), can_be) << trial.cause;
    EXPECT_FALSE(at(1e-2)) << trial.cause;
  }
}

TEST(TrialTest, OnlySensorsAreOfChannels) {
  for (const Trial& trial : AllTrials(ThreeSensors(), Scales()))
    EXPECT_TRUE(trial.channels.empty() || trial.cause == "sensor") << trial.cause;
}

}  // namespace
}  // namespace cosserat_cable
