#include "cosserat_cable/vehicle/joint_positions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tools/temporary_file.h"

namespace cosserat_cable {
namespace {

constexpr double kRounding = 1e-12;  // a few operations on numbers near one

JointModel Joint(const char* name, const char* child, JointModel::Type type, double lower,
                 double upper) {
  JointModel joint;
  joint.name = name;
  joint.parent = "base";
  joint.child = child;
  joint.type = type;
  joint.lower = lower;
  joint.upper = upper;
  return joint;
}

// An arm, a boom whose limits exclude zero, a slide, a follower of the boom, and a fixed mast.
VehicleModel MakeVehicle() {
  VehicleModel vehicle;
  vehicle.root = "base";
  vehicle.links = {"base", "arm", "boom", "slide", "follower", "mast"};
  vehicle.joints = {Joint("arm_joint", "arm", JointModel::Type::kRevolute, -1, 1),
                    Joint("boom_joint", "boom", JointModel::Type::kRevolute, 0.3, 1.2),
                    Joint("slide_joint", "slide", JointModel::Type::kPrismatic, -0.5, -0.1),
                    Joint("follower_joint", "follower", JointModel::Type::kRevolute, -2, 2),
                    Joint("mast_joint", "mast", JointModel::Type::kFixed, 0, 0)};
  vehicle.joints[3].mimic = "boom_joint";
  vehicle.joints[3].mimic_multiplier = -2;
  vehicle.joints[3].mimic_offset = 0.25;
  return vehicle;
}

JointPositions Read(const std::vector<std::string>& texts, std::string* said) {
  Problems problems;
  JointPositions positions = ReadJointPositions(texts, MakeVehicle(), &problems);
  *said = problems.ToString();
  return positions;
}

TEST(JointPositions, RestLiesInsideTheLimits) {
  const JointPositions rest = RestPositions(MakeVehicle());
  EXPECT_EQ(rest.at("arm_joint"), 0);
  EXPECT_EQ(rest.at("boom_joint"), 0.3);
  EXPECT_EQ(rest.at("slide_joint"), -0.1);
  EXPECT_NEAR(rest.at("follower_joint"), 0.25 - 2 * 0.3, kRounding);
  EXPECT_EQ(rest.count("mast_joint"), 0u);
}

TEST(JointPositions, RestOffZeroIsSaid) {
  const std::vector<std::string> notes = RestNotes(MakeVehicle(), {{"slide_joint", -0.2}});
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("'boom_joint' stands at 0.3 rad"), std::string::npos) << notes[0];
  EXPECT_NE(notes[0].find("0.3 to 1.2 rad"), std::string::npos) << notes[0];
}

TEST(JointPositions, FollowersAreLed) {
  std::string said;
  const JointPositions given = Read({"arm_joint=-0.5, boom_joint=1", "slide_joint=-0.2"}, &said);
  EXPECT_EQ(said, "");
  const JointPositions all = CompletePositions(MakeVehicle(), given);
  EXPECT_EQ(all.at("arm_joint"), -0.5);
  EXPECT_EQ(all.at("slide_joint"), -0.2);
  EXPECT_NEAR(all.at("follower_joint"), 0.25 - 2, kRounding);
}

TEST(JointPositions, AllThatIsWrongIsSaidAtOnce) {
  const struct {
    const char *text, *said;
  } kCases[] = {
      {"arm_jont=0.1", "did you mean 'arm_joint'?"},
      {"xyzzy=0.1", "expected a joint of the vehicle: arm_joint, boom_joint, slide_joint"},
      {"follower_joint=0.1", "follows joint 'boom_joint'"},
      {"mast_joint=0.1", "is fixed"},
      {"arm_joint=fast", "got 'fast' for joint 'arm_joint'"},
      {"arm_joint=nan", "got 'nan' for joint 'arm_joint'"},
      {"arm_joint", "expected NAME=VALUE"},
      {"=3", "expected NAME=VALUE"},
      {"arm_joint=1.5", "expected its limits, -1 to 1 rad"},
      {"arm_joint=30", "30 degrees are 0.5236"},
      {"slide_joint=-200", "-200 mm are -0.2"},
      {"boom_joint=0", "expected its limits, 0.3 to 1.2 rad"},
      {"boom_joint=1.15", "brings joint 'follower_joint' to -2.05 rad"},
      {"arm_joint=0.1,arm_joint=0.2", "got both 0.1 and 0.2"},
  };
  for (const auto& each : kCases) {
    std::string said;
    Read({each.text}, &said);
    EXPECT_NE(said.find(each.said), std::string::npos) << each.text << ": " << said;
    EXPECT_NE(said.find("joints: "), std::string::npos) << said;
  }
  std::string said;
  Read({"xyzzy=1,mast_joint=1", "arm_joint=2"}, &said);
  EXPECT_NE(said.find("xyzzy"), std::string::npos);
  EXPECT_NE(said.find("mast_joint"), std::string::npos);
  EXPECT_NE(said.find("-1 to 1 rad"), std::string::npos);
}

TEST(JointPositions, PlaceLinksInTheRoot) {
  const VehicleModel vehicle = MakeVehicle();
  const JointPositions at = CompletePositions(vehicle, {{"slide_joint", -0.2}});
  EXPECT_NEAR((PoseInRoot(vehicle, "slide", at).p - Eigen::Vector3d(-0.2, 0, 0)).norm(), 0,
              kRounding);
  EXPECT_NEAR(PoseInRoot(vehicle, "base", at).p.norm(), 0, kRounding);
}

TEST(JointPositions, LimitsAreReadFromTheUrdf) {
  Problems problems;
  const TemporaryFile file(
      "<robot name='r'><link name='base'/><link name='a'/><link name='b'/><link name='c'/>"
      "<joint name='ja' type='revolute'><parent link='base'/><child link='a'/><axis xyz='0 1 0'/>"
      "<limit lower='0.2' upper='0.9' effort='1' velocity='2'/></joint>"
      "<joint name='jb' type='continuous'><parent link='base'/><child link='b'/></joint>"
      "<joint name='jc' type='prismatic'><parent link='base'/><child link='c'/>"
      "<limit lower='0' upper='0' effort='1' velocity='0'/></joint></robot>");
  const VehicleModel vehicle = LoadVehicle(
      file.path(), {}, [](const std::string&) { return ""; }, &problems);
  ASSERT_TRUE(problems.empty()) << problems.ToString();
  EXPECT_EQ(vehicle.FindJoint("ja")->lower, 0.2);
  EXPECT_EQ(vehicle.FindJoint("ja")->upper, 0.9);
  EXPECT_TRUE(std::isinf(vehicle.FindJoint("jb")->upper));
  // A range of nothing is none.
  EXPECT_TRUE(std::isinf(vehicle.FindJoint("jc")->lower));
}

}  // namespace
}  // namespace cosserat_cable
