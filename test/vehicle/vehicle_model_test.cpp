#include "cosserat_cable/vehicle/vehicle_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "math/motion_reference.h"
#include "tools/temporary_file.h"

namespace cosserat_cable {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kRounding = 1e-12;     // numbers written with 17 digits, a few operations
constexpr double kMeshRounding = 1e-7;  // assimp keeps vertices as floats
const std::string kData = std::string(COSSERAT_CABLE_SOURCE_DIR) + "/test/data/vehicle";

std::string NoPackages(const std::string&) { return ""; }

VehicleModel LoadCorner() {
  Problems problems;
  VehicleModel vehicle =
      LoadVehicle(kData + "/corner.urdf", {"body", "arm", "carrier", "wheel", "nowhere"},
                  NoPackages, &problems);
  EXPECT_TRUE(problems.empty()) << problems.ToString();
  return vehicle;
}

TEST(VehicleModel, ReadsTheTree) {
  const VehicleModel vehicle = LoadCorner();
  EXPECT_EQ(vehicle.name, "corner");
  EXPECT_EQ(vehicle.root, "world");
  const std::vector<std::string> links = {"body", "world", "arm", "strut", "carrier", "wheel"};
  EXPECT_EQ(vehicle.links, links);
  EXPECT_TRUE(vehicle.HasLink("arm"));
  EXPECT_FALSE(vehicle.HasLink("Arm"));
  ASSERT_EQ(vehicle.joints.size(), 5u);
  EXPECT_EQ(vehicle.joints[0].name, "pose");
  EXPECT_EQ(vehicle.joints[0].type, JointModel::Type::kFloating);
  EXPECT_EQ(vehicle.joints[1].type, JointModel::Type::kRevolute);
  EXPECT_EQ(vehicle.joints[2].type, JointModel::Type::kPrismatic);
  EXPECT_EQ(vehicle.joints[3].type, JointModel::Type::kFixed);
  EXPECT_EQ(vehicle.joints[4].type, JointModel::Type::kRevolute);
  EXPECT_EQ(vehicle.FindJoint("mount")->parent, "strut");
  EXPECT_EQ(vehicle.FindJoint("mount")->child, "carrier");
  EXPECT_EQ(vehicle.FindJoint("carrier"), nullptr);
}

TEST(VehicleModel, JointsMove) {
  const VehicleModel vehicle = LoadCorner();
  const Pose arm = vehicle.FindJoint("arm_joint")->Evaluate(0.3);
  EXPECT_LT((arm.p - Vector3d(0, 0.4, 0)).norm(), kRounding);
  EXPECT_LT(arm.q.angularDistance(AxisTurn({1, 0, 0}, 0.3)), kRounding);
  // The axis is x of the joint's frame, which is turned by 90 degrees about z: y of the parent.
  const Pose travel = vehicle.FindJoint("travel")->Evaluate(0.05);
  EXPECT_LT((travel.p - Vector3d(0, 0.75, 0.1)).norm(), kRounding);
  EXPECT_LT(travel.q.angularDistance(AxisTurn({0, 0, 1}, M_PI / 2)), kRounding);
  EXPECT_LT((vehicle.FindJoint("mount")->Evaluate(7).p - Vector3d(0, 0, -0.3)).norm(), kRounding);
}

TEST(VehicleModel, ResolvesMimicChains) {
  const VehicleModel vehicle = LoadCorner();
  EXPECT_EQ(vehicle.FindJoint("travel")->mimic, "");
  const JointModel& arm = *vehicle.FindJoint("arm_joint");
  EXPECT_EQ(arm.mimic, "travel");
  EXPECT_DOUBLE_EQ(arm.mimic_multiplier, 2.5);
  EXPECT_DOUBLE_EQ(arm.mimic_offset, 0.1);
  // spin = -2 arm + 1 = -2 (2.5 travel + 0.1) + 1
  const JointModel& spin = *vehicle.FindJoint("spin");
  EXPECT_EQ(spin.mimic, "travel");
  EXPECT_DOUBLE_EQ(spin.mimic_multiplier, -5);
  EXPECT_DOUBLE_EQ(spin.mimic_offset, 0.8);
}

TEST(VehicleModel, ReadsCollisionGeometryOfTheLinksAskedFor) {
  const VehicleModel vehicle = LoadCorner();
  ASSERT_EQ(vehicle.collision.size(), 3u);  // the wheel has none
  const std::vector<Shape>& body = vehicle.collision.at("body");
  ASSERT_EQ(body.size(), 2u);
  EXPECT_EQ(std::get<Box>(body[0].geometry).size, Vector3d(1, 2, 0.5));
  EXPECT_EQ(body[0].X_LS.p, Vector3d(0.1, 0, 0.2));
  EXPECT_LT(body[0].X_LS.q.angularDistance(AxisTurn({0, 0, 1}, M_PI / 2)), kRounding);
  const TriangleMesh& mesh = std::get<TriangleMesh>(body[1].geometry);
  EXPECT_EQ(mesh.triangles.size(), 4u);
  Vector3d top = Vector3d::Zero();
  for (const Vector3d& vertex : mesh.vertices) top = top.cwiseMax(vertex);
  EXPECT_LT((top - Vector3d(0.1, 0.2, 0.3)).norm(), kMeshRounding);
  EXPECT_EQ(std::get<Cylinder>(vehicle.collision.at("arm")[0].geometry).radius, 0.02);
  EXPECT_EQ(std::get<Cylinder>(vehicle.collision.at("arm")[0].geometry).length, 0.4);
  EXPECT_EQ(std::get<Sphere>(vehicle.collision.at("carrier")[0].geometry).radius, 0.05);

  Problems problems;
  EXPECT_TRUE(LoadVehicle(kData + "/corner.urdf", {}, NoPackages, &problems).collision.empty());
}

// ---- Mistakes ---------------------------------------------------------------------------------

/// What is found in a robot of this content; "FILE" stands for the file's name. Line 1 is <robot>.
std::string ProblemsOf(const std::string& content,
                       const std::vector<std::string>& collision_links = {},
                       const PackageFinder& find_package = NoPackages) {
  const TemporaryFile file("<robot name=\"r\">\n" + content + "</robot>\n");
  Problems problems;
  testing::internal::CaptureStderr();
  LoadVehicle(file.path(), collision_links, find_package, &problems);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  std::string text = problems.ToString();
  for (std::size_t at; (at = text.find(file.path())) != std::string::npos;) {
    text.replace(at, file.path().size(), "FILE");
  }
  return text;
}

#define EXPECT_CONTAINS(text, part) \
  EXPECT_NE((text).find(part), std::string::npos) << "in: " << (text)

TEST(VehicleProblems, NoFileAndNoXml) {
  Problems problems;
  LoadVehicle("/nowhere/car.urdf", {}, NoPackages, &problems);
  EXPECT_EQ(problems.ToString().find("/nowhere/car.urdf: no such file"), 0u) << problems.ToString();
  EXPECT_CONTAINS(ProblemsOf("<link name=\"a\">\n<visual>\n</link>\n"), "FILE:");
  EXPECT_CONTAINS(ProblemsOf("<link name=\"a\">\n<visual>\n</link>\n"), "malformed XML");
  EXPECT_CONTAINS(ProblemsOf("<xacro:include filename=\"x\"/>\n"), "FILE:2: xacro:include: ");
}

TEST(VehicleProblems, NotARobot) {
  const TemporaryFile file("<!-- a comment -->\n<launch/>\n");
  Problems problems;
  LoadVehicle(file.path(), {}, NoPackages, &problems);
  EXPECT_CONTAINS(problems.ToString(), ":2: got <launch>, expected <robot>");
  EXPECT_CONTAINS(ProblemsOf(""), "FILE:1: robot: has no link");
}

TEST(VehicleProblems, TwoRoots) {
  EXPECT_CONTAINS(ProblemsOf("<link name=\"a\"/>\n<link name=\"b\"/>\n"),
                  "FILE:3: link[b]: has no parent");
}

TEST(VehicleProblems, LoopsAndTwoParents) {
  EXPECT_CONTAINS(ProblemsOf(R"(<link name="a"/><link name="b"/>
<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>
<joint name="k" type="fixed"><parent link="b"/><child link="a"/></joint>
)"),
                  "joints close a loop");
  EXPECT_CONTAINS(ProblemsOf(R"(<link name="a"/><link name="b"/>
<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>
<joint name="k" type="fixed"><parent link="a"/><child link="b"/></joint>
)"),
                  "FILE:4: joint[k].child: link 'b' has a parent already: joint 'j' in line 3");
}

TEST(VehicleProblems, UnknownNames) {
  const std::string text = ProblemsOf(R"(<link name="body"/><link name="wheel"/><link name="wheel"/>
<joint name="spin" type="continous"><parent link="boddy"/>
<child link="wheel"/>
<mimic joint="spinn"/></joint>
<joint name="steer" type="planar"><parent link="body"/></joint>
)");
  EXPECT_CONTAINS(text, "FILE:2: link[wheel]: is there already in line 2");
  EXPECT_CONTAINS(text, "FILE:3: joint[spin].type: got 'continous'");
  EXPECT_CONTAINS(text, "did you mean 'continuous'?");
  EXPECT_CONTAINS(text,
                  "FILE:3: joint[spin].parent: there is no link 'boddy'; did you mean 'body'?");
  EXPECT_CONTAINS(text, "FILE:5: joint[spin].mimic.joint: there is no joint 'spinn'; did you mean");
  EXPECT_CONTAINS(text, "FILE:6: joint[steer].type: planar joints are not supported");
  EXPECT_CONTAINS(text, "FILE:6: joint[steer].child: is missing");
}

TEST(VehicleProblems, Numbers) {
  const std::string text = ProblemsOf(R"(<link name="a">
<collision><geometry><box size="1 -2 3"/></geometry></collision>
<collision><origin xyz="0 nan 0"/><geometry><sphere radius="0"/></geometry></collision>
<collision><geometry><cylinder radius="1"/></geometry></collision>
<collision><geometry><mesh filename="x.stl" scale="1 0 1"/></geometry></collision>
<collision><geometry><capsule/></geometry></collision>
<visual><origin rpy="0 0"/></visual>
</link><link name="b"/>
<joint name="j" type="revolute"><parent link="a"/><child link="b"/>
<axis xyz="0 0 0"/><origin xyz="1 2 x"/></joint>
)");
  EXPECT_CONTAINS(text,
                  "FILE:3: link[a].collision.box.size: got '1 -2 3', expected 3 numbers, positive");
  EXPECT_CONTAINS(text,
                  "FILE:4: link[a].collision.origin.xyz: got 'nan', expected 3 numbers, finite");
  EXPECT_CONTAINS(text, "FILE:4: link[a].collision.sphere.radius: got '0'");
  EXPECT_CONTAINS(text, "FILE:5: link[a].collision.cylinder.length: is missing");
  EXPECT_CONTAINS(text, "FILE:6: link[a].collision.mesh.scale: got '1 0 1'");
  EXPECT_CONTAINS(text, "FILE:7: link[a].collision.capsule: unknown geometry");
  EXPECT_CONTAINS(text, "FILE:8: link[a].visual.origin.rpy: got '0 0', expected 3 numbers");
  EXPECT_CONTAINS(text, "FILE:8: link[a].visual.geometry: is missing");
  EXPECT_CONTAINS(text, "FILE:11: joint[j].axis.xyz: got '0 0 0', expected a direction");
  EXPECT_CONTAINS(text, "FILE:11: joint[j].origin.xyz: got 'x'");
}

TEST(VehicleProblems, MimicCircle) {
  EXPECT_CONTAINS(ProblemsOf(R"(<link name="a"/><link name="b"/><link name="c"/>
<joint name="j" type="continuous"><parent link="a"/><child link="b"/><mimic joint="k"/></joint>
<joint name="k" type="continuous"><parent link="a"/><child link="c"/><mimic joint="j"/></joint>
)"),
                  "FILE:3: joint[j].mimic: joints follow each other in a circle");
}

TEST(VehicleProblems, WhatOnlyUrdfdomKnows) {
  // A mass that is no number: said once, not printed to the terminal.
  EXPECT_CONTAINS(
      ProblemsOf("<link name=\"a\"><inertial><mass value=\"heavy\"/>"
                 "<inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/>"
                 "</inertial></link>\n"),
      "FILE: ");
}

std::string MeshLink(const std::string& filename) {
  return "<link name=\"a\">\n<collision><geometry>\n<mesh filename=\"" + filename +
         "\"/></geometry></collision></link>\n";
}

TEST(VehicleProblems, Meshes) {
  EXPECT_EQ(ProblemsOf(MeshLink("missing.stl")), "") << "not asked for, so not loaded";
  EXPECT_CONTAINS(ProblemsOf(MeshLink("missing.stl"), {"a"}),
                  "FILE:4: mesh.filename: /tmp/missing.stl");
  EXPECT_CONTAINS(ProblemsOf(MeshLink("package://parts/a.stl"), {"a"}),
                  "FILE:4: mesh.filename: package 'parts' was not found");
  EXPECT_CONTAINS(ProblemsOf(MeshLink("http://parts/a.stl"), {"a"}),
                  "FILE:4: mesh.filename: got 'http://parts/a.stl', expected package://");
}

TEST(VehicleModel, FindsMeshesByEveryKindOfName) {
  const auto find_package = [](const std::string& package) {
    return package == "parts" ? kData : "";
  };
  const std::vector<std::string> names = {"package://parts/tetrahedron.stl",
                                          "file://" + kData + "/tetrahedron.stl",
                                          kData + "/tetrahedron.stl"};
  for (const std::string& name : names) {
    EXPECT_EQ(ProblemsOf(MeshLink(name), {"a"}, find_package), "") << name;
  }
}

}  // namespace
}  // namespace cosserat_cable
