// Which records of a set are fitted.
#include "../../src/diagnosis/chosen_records.h"

#include <gtest/gtest.h>

#include "../measurement/rigs.h"

namespace cosserat_cable {
namespace {

MeasurementSet SetOf(int count, int samples) {
  MeasurementSet set;
  for (int e = 0; e < count; ++e) {
    Experiment experiment = testing::RingDown(0.02, 1.0, samples);
    experiment.name = "record_" + std::to_string(e);
    experiment.start.kind = StartCondition::Kind::kUnknown;
    set.experiments.push_back(experiment);
  }
  return set;
}

TEST(ChosenRecordsTest, AreAllOfAnOrdinarySet) {
  EXPECT_EQ(ChosenRecords(SetOf(1, 20000)), std::vector<int>{0});
  EXPECT_EQ(ChosenRecords(SetOf(4, 600)), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(ChosenRecords(SetOf(3, 20000)), (std::vector<int>{0, 1, 2}));
  // Known starts cost little.
  MeasurementSet known = SetOf(6, 5000);
  for (Experiment& experiment : known.experiments)
    experiment.start.kind = StartCondition::Kind::kHeld;
  EXPECT_EQ(ChosenRecords(known).size(), 6u);
}

TEST(ChosenRecordsTest, AreSpreadOverALargeSetWithItsQuasiStaticOnes) {
  MeasurementSet set = SetOf(10, 500);
  EXPECT_EQ(ChosenRecords(set), (std::vector<int>{0, 5, 9}));
  set.experiments[1].record.quasi_static = true;
  ASSERT_TRUE(set.experiments[1].quasi_static());
  const std::vector<int> chosen = ChosenRecords(set);
  EXPECT_EQ(chosen.size(), 4u);
  EXPECT_EQ(chosen[1], 1);
  const MeasurementSet some = OfRecords(set, chosen);
  ASSERT_EQ(some.experiments.size(), 4u);
  EXPECT_EQ(some.experiments[1].name, "record_1");
}

}  // namespace
}  // namespace cosserat_cable
