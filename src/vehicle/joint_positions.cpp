#include "cosserat_cable/vehicle/joint_positions.h"

#include <algorithm>
#include <cmath>

#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {
namespace {

// Limits are written with few digits.
constexpr double kRounding = 1e-6;

bool HasPosition(const JointModel& joint) {
  return joint.type == JointModel::Type::kRevolute || joint.type == JointModel::Type::kPrismatic;
}

bool Contains(const JointModel& joint, double position) {
  return position >= joint.lower - kRounding && position <= joint.upper + kRounding;
}

double Led(const JointModel& follower, double leader) {
  return follower.mimic_multiplier * leader + follower.mimic_offset;
}

std::string Unit(const JointModel& joint) {
  return joint.type == JointModel::Type::kPrismatic ? " m" : " rad";
}

std::string RangeText(const JointModel& joint) {
  return FormatRounded(joint.lower, 4) + " to " + FormatRounded(joint.upper, 4) + Unit(joint);
}

std::string Trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == text.npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

class PositionReader {
 public:
  PositionReader(const VehicleModel& vehicle, Problems* problems)
      : vehicle_(vehicle), problems_(*problems) {}

  void Read(const std::string& text) {
    std::size_t begin = 0;
    while (begin <= text.size()) {
      const std::size_t end = std::min(text.find(',', begin), text.size());
      ReadOne(text.substr(begin, end - begin));
      begin = end + 1;
    }
  }

  JointPositions Take() { return std::move(positions_); }

 private:
  void Add(const std::string& message) { problems_.Add("", 0, "joints", message); }

  void ReadOne(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
      Add("got '" + text + "', expected NAME=VALUE [rad] or [m]");
      return;
    }
    const std::string name = Trimmed(text.substr(0, equals));
    const std::string value = Trimmed(text.substr(equals + 1));
    const JointModel* joint = vehicle_.FindJoint(name);
    const bool settable = joint != nullptr && CheckJoint(*joint);
    if (joint == nullptr) AddUnknown(name);
    const NumberText number = ParseNumber(value);
    if (number.kind != NumberText::Kind::kFinite) {
      Add("got '" + value + "' for joint '" + name + "', expected a number [rad] or [m]");
      return;
    }
    if (!settable) return;
    const auto [entry, is_new] = positions_.emplace(name, number.value);
    if (!is_new && entry->second != number.value) {
      Add("got both " + FormatNumber(entry->second) + " and " + value + " for joint '" + name +
          "', expected one value");
      return;
    }
    if (is_new) CheckLimits(*joint, number.value);
  }

  void AddUnknown(const std::string& name) {
    std::vector<std::string> known;
    for (const JointModel& joint : vehicle_.joints)
      if (IsDriven(joint)) known.push_back(joint.name);
    const std::string nearest = NearestWord(name, known);
    std::string message = "got '" + name + "', expected a joint of the vehicle";
    if (!nearest.empty()) {
      message += ": did you mean '" + nearest + "'?";
    } else if (known.empty()) {
      message += ", none of which has a position";
    } else {
      constexpr std::size_t kMostNames = 8;
      message += ": ";
      for (std::size_t i = 0; i < std::min(known.size(), kMostNames); ++i)
        message += (i > 0 ? ", " : "") + known[i];
      if (known.size() > kMostNames) message += ", ...";
    }
    Add(message);
  }

  bool CheckJoint(const JointModel& joint) {
    if (IsDriven(joint)) return true;
    if (HasPosition(joint)) {
      Add("joint '" + joint.name + "' follows joint '" + joint.mimic +
          "': give that one's position");
    } else {
      Add(std::string("joint '") + joint.name + "' is " +
          (joint.type == JointModel::Type::kFixed ? "fixed" : "floating") + ", it has no position");
    }
    return false;
  }

  void CheckLimits(const JointModel& joint, double position) {
    if (!Contains(joint, position)) {
      std::string message = "got " + FormatNumber(position) + Unit(joint) + " for joint '" +
                            joint.name + "', expected its limits, " + RangeText(joint);
      const double radians = position * M_PI / 180;
      if (joint.type == JointModel::Type::kRevolute && std::abs(position) > 1 &&
          Contains(joint, radians)) {
        message += "; " + FormatNumber(position) + " degrees are " + FormatRounded(radians, 5);
      } else if (joint.type == JointModel::Type::kPrismatic && Contains(joint, 1e-3 * position)) {
        message += "; " + FormatNumber(position) + " mm are " + FormatRounded(1e-3 * position, 5);
      }
      Add(message);
    }
    for (const JointModel& follower : vehicle_.joints) {
      if (follower.mimic != joint.name || Contains(follower, Led(follower, position))) continue;
      Add("got " + FormatNumber(position) + Unit(joint) + " for joint '" + joint.name +
          "', which brings joint '" + follower.name + "' to " +
          FormatRounded(Led(follower, position), 4) + Unit(follower) + ", expected its limits, " +
          RangeText(follower));
    }
  }

  const VehicleModel& vehicle_;
  Problems& problems_;
  JointPositions positions_;
};

}  // namespace

bool IsDriven(const JointModel& joint) { return HasPosition(joint) && joint.mimic.empty(); }

double RestPosition(const VehicleModel& vehicle, const JointModel& joint) {
  if (!joint.mimic.empty()) {
    const JointModel* leader = vehicle.FindJoint(joint.mimic);
    return Led(joint, leader != nullptr ? RestPosition(vehicle, *leader) : 0.0);
  }
  return std::clamp(0.0, joint.lower, joint.upper);
}

JointPositions RestPositions(const VehicleModel& vehicle) { return CompletePositions(vehicle, {}); }

std::vector<std::string> RestNotes(const VehicleModel& vehicle, const JointPositions& given) {
  std::vector<std::string> notes;
  for (const JointModel& joint : vehicle.joints) {
    const double rest = RestPosition(vehicle, joint);
    if (!IsDriven(joint) || given.count(joint.name) > 0 || rest == 0) continue;
    notes.push_back("joint '" + joint.name + "' stands at " + FormatRounded(rest, 4) + Unit(joint) +
                    ": its limits, " + RangeText(joint) + ", exclude zero");
  }
  return notes;
}

JointPositions ReadJointPositions(const std::vector<std::string>& texts,
                                  const VehicleModel& vehicle, Problems* problems) {
  PositionReader reader(vehicle, problems);
  for (const std::string& text : texts) reader.Read(text);
  return reader.Take();
}

JointPositions CompletePositions(const VehicleModel& vehicle, const JointPositions& given) {
  JointPositions all = given;
  for (const JointModel& joint : vehicle.joints) {
    if (!HasPosition(joint)) continue;
    const auto leader = given.find(joint.mimic);
    all.emplace(joint.name,
                leader != given.end() ? Led(joint, leader->second) : RestPosition(vehicle, joint));
  }
  return all;
}

Pose PoseInRoot(const VehicleModel& vehicle, const std::string& link,
                const JointPositions& positions) {
  Pose X_RL;
  std::string at = link;
  while (at != vehicle.root) {
    const auto joint = std::find_if(vehicle.joints.begin(), vehicle.joints.end(),
                                    [&at](const JointModel& j) { return j.child == at; });
    const auto position = positions.find(joint->name);
    X_RL = joint->Evaluate(position == positions.end() ? 0.0 : position->second) * X_RL;
    at = joint->parent;
  }
  return X_RL;
}

}  // namespace cosserat_cable
