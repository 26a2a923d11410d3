#include "cosserat_cable/vehicle/vehicle_model.h"

#include <tinyxml2.h>
#include <urdf_model/model.h>
#include <urdf_world/types.h>

#include <algorithm>
#include <filesystem>

#include "collision.h"
#include "cosserat_cable/math/rotation.h"
#include "urdf_check.h"
#include "urdf_parse.h"

namespace cosserat_cable {
namespace {

using tinyxml2::XMLElement;

/// A range of nothing and a velocity of zero stand where somebody had to write something.
void ReadLimits(const urdf::Joint& joint, JointModel* model) {
  if (!joint.limits) return;
  const bool bounded = joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::PRISMATIC;
  if (bounded && joint.limits->upper > joint.limits->lower) {
    model->lower = joint.limits->lower;
    model->upper = joint.limits->upper;
  }
  if (joint.limits->velocity > 0) model->velocity = joint.limits->velocity;
}

JointModel ToJoint(const urdf::Joint& joint) {
  JointModel model;
  model.name = joint.name;
  model.parent = joint.parent_link_name;
  model.child = joint.child_link_name;
  model.X_PJ = ToPose(joint.parent_to_joint_origin_transform);
  switch (joint.type) {
    case urdf::Joint::REVOLUTE:
    case urdf::Joint::CONTINUOUS:
      model.type = JointModel::Type::kRevolute;
      break;
    case urdf::Joint::PRISMATIC:
      model.type = JointModel::Type::kPrismatic;
      break;
    case urdf::Joint::FLOATING:
      model.type = JointModel::Type::kFloating;
      break;
    default:
      model.type = JointModel::Type::kFixed;
      break;
  }
  const Eigen::Vector3d axis(joint.axis.x, joint.axis.y, joint.axis.z);
  if (axis.norm() > 0) model.axis = axis.normalized();
  ReadLimits(joint, &model);
  if (joint.mimic) {
    model.mimic = joint.mimic->joint_name;
    model.mimic_multiplier = joint.mimic->multiplier;
    model.mimic_offset = joint.mimic->offset;
  }
  return model;
}

/// Makes every joint follow the head of its chain. @pre no circles
void ResolveMimicChains(VehicleModel* vehicle) {
  for (JointModel& joint : vehicle->joints) {
    while (!joint.mimic.empty()) {
      const JointModel& leader = *vehicle->FindJoint(joint.mimic);
      if (leader.mimic.empty()) break;
      joint.mimic = leader.mimic;
      joint.mimic_offset += joint.mimic_multiplier * leader.mimic_offset;
      joint.mimic_multiplier *= leader.mimic_multiplier;
    }
  }
}

/// The root element; null, with a problem, where the file is no URDF.
XMLElement* OpenUrdf(const std::string& path, tinyxml2::XMLDocument* document, Problems* problems) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    problems->Add(path, "no such file");
    return nullptr;
  }
  if (document->LoadFile(path.c_str()) != tinyxml2::XML_SUCCESS) {
    problems->Add(path, document->ErrorLineNum(), "",
                  std::string("malformed XML: ") + document->ErrorStr());
    return nullptr;
  }
  XMLElement* root = document->RootElement();
  if (!root || std::string(root->Name()) != "robot") {
    problems->Add(path, root ? root->GetLineNum() : 0, "",
                  std::string("got <") + (root ? root->Name() : "") + ">, expected <robot>");
    return nullptr;
  }
  return root;
}

}  // namespace

Pose JointModel::Evaluate(double position) const {
  switch (type) {
    case Type::kRevolute:
      return X_PJ * Pose{Eigen::Vector3d::Zero(), RotationExp(position * axis)};
    case Type::kPrismatic:
      return X_PJ * Pose{position * axis, Eigen::Quaterniond::Identity()};
    case Type::kFixed:
    case Type::kFloating:
      break;
  }
  return X_PJ;
}

const JointModel* VehicleModel::FindJoint(const std::string& joint_name) const {
  const auto found = std::find_if(joints.begin(), joints.end(), [&](const JointModel& joint) {
    return joint.name == joint_name;
  });
  return found == joints.end() ? nullptr : &*found;
}

bool VehicleModel::HasLink(const std::string& link_name) const {
  return std::find(links.begin(), links.end(), link_name) != links.end();
}

VehicleModel LoadVehicle(const std::string& path, const std::vector<std::string>& collision_links,
                         const PackageFinder& find_package, Problems* problems) {
  VehicleModel vehicle;
  tinyxml2::XMLDocument document;
  XMLElement* robot = OpenUrdf(path, &document, problems);
  if (!robot) return vehicle;

  for (const XMLElement* e = robot->FirstChildElement("link"); e;
       e = e->NextSiblingElement("link")) {
    if (!NameOf(*e).empty()) vehicle.links.push_back(NameOf(*e));
  }
  Problems found;
  CheckUrdf(*robot, path, &found);
  // urdfdom stops at its first error, and would repeat these without a line.
  const urdf::ModelInterfaceSharedPtr model =
      found.empty() ? ParseUrdf(&document, path, &found) : nullptr;
  found.SortByLine();
  problems->Append(found);
  if (!model) return vehicle;

  vehicle.name = model->getName();
  vehicle.root = model->getRoot()->name;
  for (const XMLElement* e = robot->FirstChildElement("joint"); e;
       e = e->NextSiblingElement("joint")) {
    vehicle.joints.push_back(ToJoint(*model->getJoint(NameOf(*e))));
  }
  ResolveMimicChains(&vehicle);
  MeshCache meshes;
  for (const XMLElement* e = robot->FirstChildElement("link"); e;
       e = e->NextSiblingElement("link")) {
    const std::string link = NameOf(*e);
    if (std::find(collision_links.begin(), collision_links.end(), link) == collision_links.end()) {
      continue;
    }
    std::vector<Shape> shapes =
        LoadCollision(*model->getLink(link), *e, path, find_package, &meshes, problems);
    if (!shapes.empty()) vehicle.collision[link] = std::move(shapes);
  }
  return vehicle;
}

}  // namespace cosserat_cable
