#include "cosserat_cable/vehicle/vehicle_model.h"

#include <tinyxml2.h>
#include <urdf_model/model.h>
#include <urdf_world/types.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <set>
#include <unordered_map>

#include "collision.h"
#include "cosserat_cable/math/rotation.h"
#include "urdf_check.h"
#include "urdf_parse.h"

namespace cosserat_cable {
namespace {

using tinyxml2::XMLElement;

// Far more than any vehicle has; it is read whole [bytes].
constexpr std::uintmax_t kMostOfUrdf = 64 * 1024 * 1024;

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
    case urdf::Joint::PLANAR:
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

/// Makes every joint follow the head of its chain. One that follows nobody, or itself, is on its
/// own: no cable uses it.
void ResolveMimicChains(VehicleModel* vehicle) {
  std::unordered_map<std::string, JointModel*> joints;
  for (JointModel& joint : vehicle->joints) joints.emplace(joint.name, &joint);
  std::set<const JointModel*> resolved;
  for (JointModel& joint : vehicle->joints) {
    // Up to a head, or to one whose head is known; each is walked over once.
    std::vector<JointModel*> chain;
    for (JointModel* at = &joint; resolved.insert(at).second && !at->mimic.empty();) {
      const auto leader = joints.find(at->mimic);
      const bool circle = leader != joints.end() &&
                          std::find(chain.begin(), chain.end(), leader->second) != chain.end();
      if (leader == joints.end() || leader->second == at || circle) {
        at->mimic.clear();
        break;
      }
      chain.push_back(at);
      at = leader->second;
    }
    for (auto follower = chain.rbegin(); follower != chain.rend(); ++follower) {
      JointModel& follows = **follower;
      const JointModel& leader = *joints.at(follows.mimic);
      if (leader.mimic.empty()) continue;
      follows.mimic = leader.mimic;
      follows.mimic_offset += follows.mimic_multiplier * leader.mimic_offset;
      follows.mimic_multiplier *= leader.mimic_multiplier;
    }
  }
}

int CountElements(const XMLElement& link, GeometryKind kind) {
  int count = 0;
  for (const XMLElement* e = link.FirstChildElement(ElementName(kind)); e;
       e = e->NextSiblingElement(ElementName(kind)))
    ++count;
  return count;
}

/// The root element; null, with a problem, where the file is no URDF.
XMLElement* OpenUrdf(const std::string& path, tinyxml2::XMLDocument* document, Problems* problems) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    problems->Add(path, std::filesystem::exists(path, error)
                            ? "got a directory, a device or a pipe, expected a URDF file"
                            : "no such file");
    return nullptr;
  }
  if (std::filesystem::file_size(path, error) > kMostOfUrdf) {
    problems->Add(path, "got a file of more than " + std::to_string(kMostOfUrdf) +
                            " bytes, expected a URDF file");
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
                         const PackageFinder& find_package, Problems* problems,
                         const VehicleUse& use) {
  VehicleModel vehicle;
  tinyxml2::XMLDocument document;
  XMLElement* robot = OpenUrdf(path, &document, problems);
  if (!robot) return vehicle;

  for (const XMLElement* e = robot->FirstChildElement("link"); e;
       e = e->NextSiblingElement("link")) {
    if (NameOf(*e).empty()) continue;
    vehicle.links.push_back(NameOf(*e));
    vehicle.entries[NameOf(*e)] = {e->GetLineNum(), CountElements(*e, GeometryKind::kCollision),
                                   CountElements(*e, GeometryKind::kVisual)};
  }
  vehicle.mesh_files = MeshFiles(*robot, path, find_package);
  Problems found, complaints;
  CheckUrdf(*robot, path, {collision_links, use.visual_links, use.moving_links}, &found,
            &vehicle.warnings, &vehicle.notes);
  // urdfdom stops at its first error, and would repeat these without a line.
  const urdf::ModelInterfaceSharedPtr model =
      found.empty() ? ParseUrdf(&document, path, &found, &complaints) : nullptr;
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
  bool whole = true;
  MeshCache meshes;
  for (const XMLElement* e = robot->FirstChildElement("link"); e;
       e = e->NextSiblingElement("link")) {
    const std::string link = NameOf(*e);
    const auto load = [&](const std::vector<std::string>& links, GeometryKind kind,
                          std::map<std::string, std::vector<Shape>>* loaded) {
      if (std::find(links.begin(), links.end(), link) == links.end()) return;
      const urdf::Link& parsed = *model->getLink(link);
      // urdfdom keeps what it had read of a link when it came to a mistake.
      const std::size_t read = kind == GeometryKind::kCollision ? parsed.collision_array.size()
                                                                : parsed.visual_array.size();
      if (static_cast<int>(read) != CountElements(*e, kind)) whole = false;
      std::vector<Shape> shapes =
          LoadGeometry(parsed, kind, *e, path, find_package, &meshes, problems);
      if (!shapes.empty()) (*loaded)[link] = std::move(shapes);
    };
    load(collision_links, GeometryKind::kCollision, &vehicle.collision);
    load(use.visual_links, GeometryKind::kVisual, &vehicle.visual);
  }
  (whole ? &vehicle.notes : problems)->Append(complaints);
  return vehicle;
}

}  // namespace cosserat_cable
