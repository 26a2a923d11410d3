// What good sets say.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "measurement/set_folder.h"

namespace cosserat_cable {
namespace {

using EndKind = EndCondition::Kind;
using StartKind = StartCondition::Kind;
using Steps = std::vector<double>;

MeasurementSet GoodSet() {
  SetFolder folder;
  WriteAll(&folder, AllSets());
  return folder.LoadGood();
}

TEST(MeasurementSets, KnowTheCable) {
  const MeasurementSet set = GoodSet();
  EXPECT_EQ(set.cable.length.value, 0.2);
  EXPECT_EQ((*set.cable.EI.value)[1], 0.012);
  EXPECT_EQ((*set.cable.eta_EI.value)[0].value, 2e-4);
  EXPECT_EQ(set.cable.eta_GJ.value->kind, DampingKey::Kind::kUnknown);
  EXPECT_EQ(set.cable_mark.line, 2);
  ASSERT_EQ(set.experiments.size(), 5u);
}

TEST(MeasurementSets, RingDownOfATipLetGo) {
  const Experiment experiment = GoodSet().experiments.at(0);
  EXPECT_EQ(experiment.name, "ringdown_small");
  EXPECT_EQ(experiment.kind, "ringdown");
  EXPECT_EQ(experiment.mark.line, 11);
  EXPECT_EQ(experiment.specimen.length.value, 0.25);
  EXPECT_EQ(experiment.gravity_W, Eigen::Vector3d(0, 0, -9.81));
  EXPECT_EQ(experiment.a.kind, EndKind::kClamp);
  EXPECT_FALSE(experiment.a.motion);
  EXPECT_EQ(experiment.b.kind, EndKind::kFree);
  EXPECT_EQ(experiment.start.kind, StartKind::kHeld);
  EXPECT_EQ(experiment.start.held.s, 0.25);
  EXPECT_EQ(experiment.start.held.position_W, Eigen::Vector3d(0.01, 0, 0.249));
  ASSERT_EQ(experiment.channels.size(), 2u);
  EXPECT_EQ(experiment.channels[0].column, "tip_x");
  EXPECT_EQ(experiment.channels[0].quantity, Quantity::kPosition);
  EXPECT_EQ(experiment.channels[0].sigma, 5e-5);
  EXPECT_FALSE(experiment.channels[0].unknown_offset);
  EXPECT_EQ(experiment.channels[1].axis, 2);
  EXPECT_FALSE(experiment.channels[1].sigma);
  EXPECT_TRUE(experiment.channels[1].unknown_offset);
  EXPECT_FALSE(experiment.quasi_static());
  EXPECT_EQ(experiment.record.t, (Steps{0, 0.01, 0.02, 0.035}));
  EXPECT_EQ(experiment.record.values(3, 0), -0.0052);
  EXPECT_EQ(experiment.record.values(1, 1), 0.2495);
  EXPECT_EQ(experiment.start_time(), 0);
}

TEST(MeasurementSets, TorsionalPendulum) {
  const Experiment experiment = GoodSet().experiments.at(1);
  EXPECT_EQ(experiment.b.kind, EndKind::kDisc);
  EXPECT_EQ(experiment.b.disc.inertia, 1.2e-4);
  EXPECT_EQ(experiment.b.disc.mass, 0.15);
  EXPECT_TRUE(experiment.b.disc.guided);
  EXPECT_EQ(experiment.start.kind, StartKind::kTwisted);
  EXPECT_EQ(experiment.start.twisted, 1.2);
  EXPECT_EQ(experiment.channels.at(1).quantity, Quantity::kRate);
  // Columns go by their names, not by their places.
  EXPECT_EQ(experiment.record.values(0, 0), 1.2);
  EXPECT_EQ(experiment.record.values(1, 1), -3);
  EXPECT_EQ(experiment.start_time(), 5);

  SetFolder folder;  // the format can be read so, too
  WriteAll(&folder, Replaced(AllSets(), ", guided: true}}", "}, guided: true}"));
  EXPECT_TRUE(folder.LoadGood().experiments.at(1).b.disc.guided);
}

TEST(MeasurementSets, ArchOnAShaker) {
  const Experiment experiment = GoodSet().experiments.at(2);
  EXPECT_EQ(experiment.gravity_W, Eigen::Vector3d(0, -9.81, 0));
  ASSERT_TRUE(experiment.a.motion && experiment.b.motion);
  EXPECT_EQ(experiment.a.motion->t, (Steps{0, 0.5, 1}));
  EXPECT_EQ(experiment.a.motion->poses.at(1).p, Eigen::Vector3d(0.001, 0, 0));
  EXPECT_EQ(experiment.a.motion->poses.at(2).q.z(), 0.6);
  EXPECT_FALSE(experiment.a.roll_unknown);
  EXPECT_TRUE(experiment.b.roll_unknown);
  ASSERT_TRUE(experiment.start.near);
  EXPECT_EQ(experiment.start.near->position_W, Eigen::Vector3d(0, 0.05, 0.05));
  EXPECT_EQ(experiment.load.file, "pull.csv");
  ASSERT_EQ(experiment.load.samples.size(), 3u);
  EXPECT_EQ(experiment.load.samples[1].s, 0.15);
  EXPECT_EQ(experiment.load.samples[2].t, 1);
  EXPECT_EQ(experiment.load.samples[1].force_W, Eigen::Vector3d(0, 0, 2));
  EXPECT_TRUE(experiment.channels.at(0).in_frame_a);
  EXPECT_EQ(experiment.channels.at(1).quantity, Quantity::kMoment);
  EXPECT_EQ(experiment.channels.at(1).clamp, ClampSide::kA);
  EXPECT_EQ(experiment.start_time(), 0) << "that of the motion files";
}

TEST(MeasurementSets, QuasiStaticSteps) {
  const Experiment experiment = GoodSet().experiments.at(3);
  EXPECT_TRUE(experiment.quasi_static());
  EXPECT_TRUE(experiment.b.motion->quasi_static);
  EXPECT_EQ(experiment.record.t, (Steps{0, 1, 2}));
  EXPECT_EQ(experiment.b.translation_free, (std::array<bool, 3>{false, false, true}));
  EXPECT_EQ(experiment.b.rotation_free, (std::array<bool, 3>{true, true, true}));
  EXPECT_EQ(experiment.load.file, "");
  EXPECT_EQ(experiment.load.samples.at(0).force_W.z(), -0.5);
  EXPECT_EQ(experiment.channels.at(0).clamp, ClampSide::kB);
}

TEST(MeasurementSets, SwingingAlready) {
  EXPECT_EQ(GoodSet().experiments.at(4).start.kind, StartKind::kUnknown);
}

TEST(MeasurementSets, AreFoundByTheFileToo) {
  SetFolder folder;
  WriteAll(&folder, AllSets());
  Problems problems;
  const MeasurementSet set = LoadMeasurementSet(folder.path() + "/measurement.yaml", &problems);
  EXPECT_EQ(problems.ToString(), "");
  EXPECT_EQ(set.folder, folder.path());
  EXPECT_EQ(set.experiments.size(), 5u);
}

TEST(MeasurementSets, TakeOtherStyles) {
  SetFolder folder;
  // JSON is YAML; files with a byte order mark, CRLF, blanks, quotes and empty lines at the end.
  WriteAll(&folder,
           "{\"format\": 1, \"cable\": {\"length\": 1, \"diameter\": 0.01, \"mass_per_length\": 1,"
           " \"EI1\": 1, \"EI2\": 2, \"GJ\": 1, \"eta_EI\": 0, \"eta_GJ\": \"critical\","
           " \"uncertain\": [\"EI\", \"disc.inertia\", \"extensions.clamp_damping.b.torsion\"]},\n"
           "\"experiments\": [{\"name\": \"1 a\", \"a\": {\"pose\": [0,0,0,0,0,0,1]},"
           " \"b\": \"free\", \"start\": {\"rest\": true}, \"record\": \"./r.csv\","
           " \"channels\": [{\"column\": \"tip x\", \"s\": 1.0000000000000002,"
           " \"quantity\": \"position\", \"axis\": \"y\"}]}]}\n");
  folder.Write("r.csv", "\xEF\xBB\xBFt , \"tip x\"\r\n0, 1e-3\r\n 1 ,+.5\r\n\r\n  \r\n");
  const MeasurementSet set = folder.LoadGood();
  ASSERT_EQ(set.experiments.size(), 1u);
  EXPECT_EQ(set.experiments[0].name, "1 a");
  EXPECT_EQ(set.experiments[0].channels[0].axis, 1);
  EXPECT_EQ(set.experiments[0].channels[0].s, 1) << "rounding is no mistake";
  EXPECT_EQ(set.experiments[0].record.values.col(0), Eigen::Vector2d(1e-3, 0.5));
  EXPECT_EQ(set.cable.uncertain.value->at(2).name, "extensions.clamp_damping.b.torsion");
}

TEST(MeasurementSets, LongRecordsAreReadQuickly) {
  constexpr int kRows = 100000;
  // Of processor time: a hundred times what it takes. A quadratic reader would take minutes.
  constexpr double kMostSeconds = 5;
  SetFolder folder;
  WriteAll(&folder, std::string(kHead) + kRingdown);
  std::string text = "t,tip_x,tip_z\n";
  for (int i = 0; i < kRows; ++i) {
    text += std::to_string(i * 0.001) + ",0.0" + std::to_string(i % 977) + ",0.24" +
            std::to_string(i % 991) + "\n";
  }
  folder.Write("ringdown_small.csv", text);
  const auto start = std::clock();
  const MeasurementSet set = folder.LoadGood();
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  EXPECT_EQ(set.experiments[0].record.values.rows(), kRows);
  EXPECT_LT(seconds, kMostSeconds);
  std::printf("%d rows in %.3f s of processor time\n", kRows, seconds);
}

TEST(MeasurementSets, ThreePointBendingOfARealCable) {
  const char* const from_environment = std::getenv("COSSERAT_CABLE_THREE_POINT_BENDING");
  const std::string folder = from_environment ? from_environment
                                              : COSSERAT_CABLE_SOURCE_DIR
                                 "/../shared/data/three_point_bending";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no recording in " << folder;
  Problems problems, warnings;
  const MeasurementSet set = LoadMeasurementSet(folder, &problems);
  ASSERT_EQ(problems.ToString(), "");
  CheckPlausibility(set, &problems, &warnings);
  EXPECT_EQ(problems.ToString(), "");
  EXPECT_EQ(warnings.ToString(), "");
  ASSERT_EQ(set.experiments.size(), 2u);
  EXPECT_TRUE(set.experiments[1].quasi_static());
  EXPECT_EQ(set.experiments[1].record.t.size(), 80u);
  EXPECT_EQ(set.experiments[1].b.motion->poses.size(), 80u);
}

}  // namespace
}  // namespace cosserat_cable
