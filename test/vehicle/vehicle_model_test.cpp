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
                       const PackageFinder& find_package = NoPackages, const VehicleUse& use = {},
                       std::string* notes = nullptr, std::string* warnings = nullptr) {
  const TemporaryFile file("<robot name=\"r\">\n" + content + "</robot>\n");
  Problems problems;
  testing::internal::CaptureStderr();
  const VehicleModel vehicle =
      LoadVehicle(file.path(), collision_links, find_package, &problems, use);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  const auto anonymous = [&file](std::string text) {
    for (std::size_t at; (at = text.find(file.path())) != std::string::npos;) {
      text.replace(at, file.path().size(), "FILE");
    }
    return text;
  };
  if (notes) *notes = anonymous(vehicle.notes.ToString());
  if (warnings) *warnings = anonymous(vehicle.warnings.ToString());
  return anonymous(problems.ToString());
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
<joint name="steer" type="fixed"><parent link="body"/></joint>
)");
  EXPECT_CONTAINS(text, "FILE:2: link[wheel]: is there already in line 2");
  EXPECT_CONTAINS(text, "FILE:3: joint[spin].type: got 'continous'");
  EXPECT_CONTAINS(text, "did you mean 'continuous'?");
  EXPECT_CONTAINS(text,
                  "FILE:3: joint[spin].parent: there is no link 'boddy'; did you mean 'body'?");
  EXPECT_CONTAINS(text, "FILE:5: joint[spin].mimic.joint: there is no joint 'spinn'; did you mean");
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
)",
                                      {"a"});
  EXPECT_CONTAINS(
      text, "FILE:3: link[a].collision.box.size: got '1 -2 3', expected 3 numbers, none negative");
  EXPECT_CONTAINS(text,
                  "FILE:4: link[a].collision.origin.xyz: got 'nan', expected 3 numbers, finite");
  EXPECT_CONTAINS(text, "FILE:5: link[a].collision.cylinder.length: is missing");
  EXPECT_CONTAINS(text, "FILE:7: link[a].collision.capsule: unknown geometry");
  EXPECT_CONTAINS(text, "FILE:8: link[a].visual.origin.rpy: got '0 0', expected 3 numbers");
  EXPECT_CONTAINS(text, "FILE:8: link[a].visual.geometry: is missing");
  EXPECT_CONTAINS(text, "FILE:11: joint[j].axis.xyz: got '0 0 0', expected a direction");
  EXPECT_CONTAINS(text, "FILE:11: joint[j].origin.xyz: got 'x'");
}

// What urdfdom reads, and no cable uses.
TEST(VehicleProblems, TheUnusedIsNotJudged) {
  const std::string links = "<link name=\"a\"/><link name=\"b\"/>";
  const auto joint = [](const std::string& type, const std::string& more) {
    return "<joint name=\"j\" type=\"" + type + "\"><parent link=\"a\"/><child link=\"b\"/>" +
           more + "</joint>\n";
  };
  VehicleUse only_a;
  only_a.moving_links = {"a"};
  const std::vector<std::string> descriptions = {
      "<link name=\"a\"><visual><geometry><box size=\"0 0 0\"/></geometry></visual></link>\n",
      "<link name=\"a\"><collision><geometry><box size=\"-1 1 "
      "1\"/></geometry></collision></link>\n",
      "<link name=\"a\"><collision><geometry><cylinder radius=\"0\" length=\"1\"/></geometry>"
      "</collision></link>\n",
      "<link name=\"a\"><visual><geometry><mesh filename=\"no.stl\" scale=\"0 0 0\"/></geometry>"
      "<material name=\"\"/></visual></link>\n",
      "<link name=\"a\"><visual><geometry><sphere radius=\"-1\"/></geometry>"
      "<material name=\"m\"><color rgba=\"red\"/></material></visual></link>\n",
      "<link name=\"a\"/><transmission name=\"t\"/><gazebo reference=\"nothing\"><x/></gazebo>\n",
      "<link name=\"a\"/><xacro:property name=\"left\" value=\"over\"/>\n",
      links + joint("fixed", "<axis xzy=\"0 0 1\"/>"),
      links + joint("fixed", "<axis xyz=\"a b c\"/>"),
      links + joint("floating", "<axis xyz=\"0 0 0\"/>"),
      links + joint("planar", ""),
      links + joint("revolute", "<axis xyz=\"0 0 0\"/>"),
      links + joint("prismatic", "<axis/>"),
      links + joint("revolute", ""),
      links + joint("continuous", "<mimic joint=\"gone\"/>"),
      links + joint("continuous", "<mimic joint=\"j\"/>"),
  };
  for (const std::string& description : descriptions)
    EXPECT_EQ(ProblemsOf(description, {}, NoPackages, only_a), "") << description;
}

TEST(VehicleProblems, TheUsedIsJudged) {
  const std::string joint =
      "<link name=\"a\"/><link name=\"b\"/>\n"
      "<joint name=\"j\" type=\"continuous\"><parent link=\"a\"/><child link=\"b\"/>\n"
      "<axis xyz=\"0 0 0\"/><mimic joint=\"gone\"/></joint>\n";
  VehicleUse b;
  b.moving_links = {"b"};
  const std::string text = ProblemsOf(joint, {}, NoPackages, b);
  EXPECT_CONTAINS(text, "FILE:4: joint[j].axis.xyz: got '0 0 0', expected a direction");
  EXPECT_CONTAINS(text, "FILE:4: joint[j].mimic.joint: there is no joint 'gone'");
  EXPECT_CONTAINS(
      ProblemsOf("<link name=\"a\"><visual><geometry><sphere radius=\"-1\"/></geometry></visual>"
                 "</link>\n",
                 {}, NoPackages, {{"a"}, {}}),
      "FILE:2: link[a].visual.sphere.radius: got '-1', expected a number, none negative");
}

// urdfdom takes all of these.
TEST(VehicleProblems, LimitsThatSayNothingAreWarnedOfWhereTheyAreUsed) {
  const auto warnings = [](const std::string& type, const std::string& limit) {
    VehicleUse b;
    b.moving_links = {"b"};
    std::string found;
    EXPECT_EQ(ProblemsOf("<link name=\"a\"/><link name=\"b\"/><link name=\"c\"/>\n"
                         "<joint name=\"j\" type=\"" +
                             type + "\"><parent link=\"a\"/><child link=\"b\"/>\n" + limit +
                             "</joint>\n<joint name=\"unused\" type=\"revolute\">"
                             "<parent link=\"a\"/><child link=\"c\"/></joint>\n",
                         {}, NoPackages, b, nullptr, &found),
              "");
    return found;
  };
  EXPECT_CONTAINS(
      warnings("prismatic", "<limit lower=\"0.1\" upper=\"-0.2\" effort=\"1\" velocity=\"1\"/>"),
      "FILE:4: joint[j].limit: got lower 0.1 and upper -0.2, expected lower to be no more than "
      "upper");
  EXPECT_CONTAINS(warnings("revolute", "<limit lower=\"1\" effort=\"1\" velocity=\"1\"/>"),
                  "got lower 1 and upper 0");
  EXPECT_CONTAINS(warnings("revolute", ""), "FILE:3: joint[j].limit: is missing");
  EXPECT_CONTAINS(warnings("prismatic", ""), "FILE:3: joint[j].limit: is missing");
  EXPECT_EQ(warnings("continuous", ""), "");
  EXPECT_CONTAINS(warnings("revolute", "<limit effort=\"1\" velocity=\"1\"/>"),
                  "FILE:4: joint[j].limit: got 0 for lower and upper");
  EXPECT_EQ(warnings("revolute", "<limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/>"),
            "");
}

constexpr const char* kPlaceholders =
    "<link name=\"a\">\n"
    "<collision><geometry><sphere radius=\"0.0\"/></geometry></collision>\n"
    "<collision><geometry><mesh filename=\"no.stl\" scale=\"1 0 1\"/></geometry></collision>\n"
    "<collision><geometry><box size=\"1 0 1\"/></geometry></collision>\n"
    "<collision><origin xyz=\"0 0 0.5\"/><geometry><sphere "
    "radius=\"0.03\"/></geometry></collision>\n"
    "<visual><geometry><cylinder radius=\"0.1\" length=\"0.2\"/></geometry></visual></link>\n";

TEST(VehicleProblems, SizesOfZeroAreNotedWhereTheyAreUsed) {
  std::string notes;
  EXPECT_EQ(ProblemsOf(kPlaceholders, {"a"}, NoPackages, {}, &notes), "");
  EXPECT_CONTAINS(notes,
                  "FILE:3: link[a].collision.sphere.radius: got '0.0': a geometry with a "
                  "size of zero touches nothing");
  EXPECT_CONTAINS(notes, "FILE:4: link[a].collision.mesh.scale: got '1 0 1'");
  EXPECT_CONTAINS(notes, "FILE:5: link[a].collision.box.size: got '1 0 1'");
  EXPECT_EQ(ProblemsOf(kPlaceholders, {}, NoPackages, {}, &notes), "");
  EXPECT_EQ(notes, "");
}

TEST(VehicleModel, SizesOfZeroTouchNothingAndVisualsAreReadWhereAskedFor) {
  const TemporaryFile file("<robot name=\"r\">\n" + std::string(kPlaceholders) + "</robot>\n");
  Problems problems;
  const VehicleModel vehicle = LoadVehicle(file.path(), {"a"}, NoPackages, &problems, {{"a"}, {}});
  EXPECT_EQ(problems.ToString(), "");
  ASSERT_EQ(vehicle.collision.at("a").size(), 1u);
  EXPECT_EQ(std::get<Sphere>(vehicle.collision.at("a")[0].geometry).radius, 0.03);
  EXPECT_EQ(vehicle.collision.at("a")[0].X_LS.p, Vector3d(0, 0, 0.5));
  ASSERT_EQ(vehicle.visual.at("a").size(), 1u);
  EXPECT_EQ(std::get<Cylinder>(vehicle.visual.at("a")[0].geometry).length, 0.2);
  EXPECT_EQ(vehicle.entries.at("a").line, 2);
  EXPECT_EQ(vehicle.entries.at("a").collisions, 4);
  EXPECT_EQ(vehicle.entries.at("a").visuals, 1);
}

TEST(VehicleModel, PlanarJointsAreDrivenByTransforms) {
  const TemporaryFile file(
      "<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/>"
      "<joint name=\"j\" type=\"planar\"><parent link=\"a\"/><child "
      "link=\"b\"/></joint></robot>\n");
  Problems problems;
  const VehicleModel vehicle = LoadVehicle(file.path(), {}, NoPackages, &problems);
  EXPECT_EQ(problems.ToString(), "");
  EXPECT_EQ(vehicle.joints.at(0).type, JointModel::Type::kFloating);
}

TEST(VehicleProblems, MimicCircle) {
  EXPECT_CONTAINS(ProblemsOf(R"(<link name="a"/><link name="b"/><link name="c"/>
<joint name="j" type="continuous"><parent link="a"/><child link="b"/><mimic joint="k"/></joint>
<joint name="k" type="continuous"><parent link="a"/><child link="c"/><mimic joint="j"/></joint>
)"),
                  "FILE:3: joint[j].mimic: joints follow each other in a circle");
}

TEST(VehicleProblems, WhatOnlyUrdfdomKnows) {
  // A mass that is no number: urdfdom says so, and leaves out what follows in the link. Said once,
  // not printed to the terminal; a mistake where a cable is to touch what is left out.
  const std::string link =
      "<link name=\"a\"><inertial><mass value=\"heavy\"/>"
      "<inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial>"
      "<collision><geometry><sphere radius=\"1\"/></geometry></collision></link>\n";
  std::string notes;
  EXPECT_EQ(ProblemsOf(link, {}, NoPackages, {}, &notes), "");
  EXPECT_CONTAINS(notes, "FILE: ");
  EXPECT_CONTAINS(ProblemsOf(link, {"a"}), "FILE: ");
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
