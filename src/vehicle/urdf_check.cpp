#include "urdf_check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <unordered_map>
#include <vector>

#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {
namespace {

using tinyxml2::XMLElement;

enum class Range { kFinite, kNotNegative };

const std::vector<std::string> kJointTypes = {"fixed",     "revolute", "continuous",
                                              "prismatic", "floating", "planar"};
const std::vector<std::string> kGeometries = {"mesh", "box", "cylinder", "sphere"};

// A file of another vehicle has as many unknown names as names: more are not compared with all.
constexpr int kMostSuggestions = 50;

std::string Nearest(const std::string& word, const std::vector<std::string>& candidates) {
  const std::string nearest = NearestWord(word, candidates);
  return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
}

class UrdfCheck {
 public:
  UrdfCheck(const XMLElement& robot, std::string path, const UrdfUse& use, Problems* problems,
            Problems* warnings, Problems* notes)
      : robot_(robot),
        path_(std::move(path)),
        use_(use),
        problems_(*problems),
        warnings_(*warnings),
        notes_(*notes) {}

  void Run() {
    Collect("link", &links_);
    Collect("joint", &joints_);
    link_of_.insert(links_.begin(), links_.end());
    joint_of_.insert(joints_.begin(), joints_.end());
    FindUsedJoints();
    if (links_.empty()) Add(robot_, "robot", "has no link");
    for (const auto& [name, link] : links_) CheckLink(name, *link);
    for (const auto& [name, joint] : joints_) CheckJoint(name, *joint);
    CheckTree();
  }

 private:
  using Named = std::vector<std::pair<std::string, const XMLElement*>>;

  void Add(const XMLElement& where, const std::string& key, const std::string& message) {
    problems_.Add(path_, where.GetLineNum(), key, message);
  }

  void Warn(const XMLElement& where, const std::string& key, const std::string& message) {
    warnings_.Add(path_, where.GetLineNum(), key, message);
  }

  void Note(const XMLElement& where, const std::string& key, const std::string& message) {
    notes_.Add(path_, where.GetLineNum(), key, message);
  }

  /// Joints on the way from the root to a link whose motion is asked for.
  void FindUsedJoints() {
    std::map<std::string, std::pair<std::string, std::string>> above;  // joint and parent by child
    for (const auto& [name, joint] : joints_) {
      const XMLElement* parent = joint->FirstChildElement("parent");
      const XMLElement* child = joint->FirstChildElement("child");
      const char* from = parent ? parent->Attribute("link") : nullptr;
      const char* to = child ? child->Attribute("link") : nullptr;
      if (from && to) above.emplace(to, std::make_pair(name, from));
    }
    if (!use_.moving_links) return;
    for (std::string link : *use_.moving_links) {
      for (auto at = above.find(link); at != above.end(); at = above.find(link)) {
        if (!used_joints_.insert(at->second.first).second) break;
        link = at->second.second;
      }
    }
  }

  bool IsUsed(const std::string& joint) const {
    return !use_.moving_links || used_joints_.count(joint) > 0;
  }

  void Collect(const char* kind, Named* elements) {
    std::map<std::string, int> lines;
    for (const XMLElement* e = robot_.FirstChildElement(kind); e; e = e->NextSiblingElement(kind)) {
      const std::string name = NameOf(*e);
      if (name.empty()) {
        Add(*e, kind, "has no name");
        continue;
      }
      const auto [first, added] = lines.emplace(name, e->GetLineNum());
      if (!added) {
        Add(*e, Key(kind, name), "is there already in line " + std::to_string(first->second));
        continue;
      }
      elements->emplace_back(name, e);
    }
  }

  static std::string Key(const std::string& kind, const std::string& name) {
    return kind + "[" + name + "]";
  }

  /// For a name that is not among these elements'.
  std::string Suggestion(const std::string& name, const Named& elements) {
    return ++suggestions_ > kMostSuggestions ? "" : Nearest(name, Names(elements));
  }

  static std::vector<std::string> Names(const Named& elements) {
    std::vector<std::string> names;
    for (const auto& element : elements) names.push_back(element.first);
    return names;
  }

  using ByName = std::unordered_map<std::string, const XMLElement*>;
  static const XMLElement* Find(const ByName& elements, const std::string& name) {
    const auto found = elements.find(name);
    return found == elements.end() ? nullptr : found->second;
  }

  /// Checks an attribute of `count` numbers, and returns them; empty where it is missing or wrong.
  std::vector<double> CheckNumbers(const XMLElement& element, const std::string& key,
                                   const char* attribute, std::size_t count, Range range,
                                   bool required) {
    const char* text = element.Attribute(attribute);
    const std::string full_key = key + "." + attribute;
    const std::string expected = count == 1 ? "a number" : std::to_string(count) + " numbers";
    if (!text) {
      if (required) Add(element, full_key, "is missing, expected " + expected);
      return {};
    }
    std::vector<double> numbers;
    std::istringstream stream(text);
    for (std::string word; stream >> word;) {
      const NumberText number = ParseNumber(word);
      if (number.kind != NumberText::Kind::kFinite) {
        Add(element, full_key, "got '" + word + "', expected " + expected + ", finite");
        return {};
      }
      numbers.push_back(number.value);
    }
    if (numbers.size() != count) {
      Add(element, full_key, "got '" + std::string(text) + "', expected " + expected);
      return {};
    }
    for (const double number : numbers) {
      if (range == Range::kFinite || number >= 0) continue;
      Add(element, full_key,
          "got '" + std::string(text) + "', expected " + expected + ", none negative");
      return {};
    }
    return numbers;
  }

  void CheckOrigin(const XMLElement& element, const std::string& key) {
    const XMLElement* origin = element.FirstChildElement("origin");
    if (!origin) return;
    CheckNumbers(*origin, key + ".origin", "xyz", 3, Range::kFinite, false);
    CheckNumbers(*origin, key + ".origin", "rpy", 3, Range::kFinite, false);
  }

  /// Sizes of a geometry: urdfdom takes any. Where a cable is to touch it, negative ones are
  /// mistakes, and one of zero makes nothing of it.
  void CheckSizes(const XMLElement& shape, const std::string& key, const char* attribute,
                  std::size_t count, Range range, bool required, bool used) {
    const std::vector<double> sizes =
        CheckNumbers(shape, key, attribute, count, used ? range : Range::kFinite, required);
    if (!used || std::count(sizes.begin(), sizes.end(), 0.0) == 0) return;
    Note(shape, key + "." + attribute,
         "got '" + std::string(shape.Attribute(attribute)) +
             "': a geometry with a size of zero touches nothing");
  }

  /// `used`: a cable is to touch it.
  void CheckGeometry(const XMLElement& element, const std::string& key, bool used) {
    const XMLElement* geometry = element.FirstChildElement("geometry");
    const XMLElement* shape = geometry ? geometry->FirstChildElement() : nullptr;
    if (!shape) {
      Add(element, key + ".geometry", "is missing or empty");
      return;
    }
    const std::string kind = shape->Name();
    const std::string shape_key = key + "." + kind;
    if (kind == "mesh") {
      if (!shape->Attribute("filename")) Add(*shape, shape_key + ".filename", "is missing");
      CheckSizes(*shape, shape_key, "scale", 3, Range::kFinite, false, used);
    } else if (kind == "box") {
      CheckSizes(*shape, shape_key, "size", 3, Range::kNotNegative, true, used);
    } else if (kind == "cylinder") {
      CheckSizes(*shape, shape_key, "radius", 1, Range::kNotNegative, true, used);
      CheckSizes(*shape, shape_key, "length", 1, Range::kNotNegative, true, used);
    } else if (kind == "sphere") {
      CheckSizes(*shape, shape_key, "radius", 1, Range::kNotNegative, true, used);
    } else {
      Add(*shape, shape_key,
          "unknown geometry, expected mesh, box, cylinder or sphere" + Nearest(kind, kGeometries));
    }
  }

  void CheckLink(const std::string& name, const XMLElement& link) {
    const auto is_in = [&name = name](const std::vector<std::string>& links) {
      return std::find(links.begin(), links.end(), name) != links.end();
    };
    for (const std::string kind : {"visual", "collision"}) {
      const bool used = is_in(kind == "visual" ? use_.visual_links : use_.collision_links);
      const std::string key = Key("link", name) + "." + kind;
      for (const XMLElement* e = link.FirstChildElement(kind.c_str()); e;
           e = e->NextSiblingElement(kind.c_str())) {
        CheckOrigin(*e, key);
        CheckGeometry(*e, key, used);
      }
    }
    if (const XMLElement* inertial = link.FirstChildElement("inertial")) {
      CheckOrigin(*inertial, Key("link", name) + ".inertial");
    }
  }

  void CheckJoint(const std::string& name, const XMLElement& joint) {
    const std::string key = Key("joint", name);
    CheckOrigin(joint, key);
    const std::string type = joint.Attribute("type") ? joint.Attribute("type") : "";
    if (std::count(kJointTypes.begin(), kJointTypes.end(), type) == 0) {
      Add(joint, key + ".type",
          "got '" + type +
              "', expected fixed, revolute, continuous, prismatic, planar or floating" +
              Nearest(type, kJointTypes));
    }
    // urdfdom does not look at the axis of a joint that has none.
    const XMLElement* axis = joint.FirstChildElement("axis");
    if (axis && type != "fixed" && type != "floating") {
      const bool turns = type == "revolute" || type == "continuous" || type == "prismatic";
      const bool used = turns && IsUsed(name);
      const std::vector<double> xyz =
          CheckNumbers(*axis, key + ".axis", "xyz", 3, Range::kFinite, used);
      if (used && xyz.size() == 3 && std::hypot(xyz[0], xyz[1], xyz[2]) == 0) {
        Add(*axis, key + ".axis.xyz", "got '0 0 0', expected a direction");
      }
    }
    if (IsUsed(name) && (type == "revolute" || type == "prismatic"))
      CheckLimit(key + ".limit", type, joint);
    CheckMimic(name, joint);
  }

  /// urdfdom asks for a limit and takes any; without a range nothing is judged by it.
  void CheckLimit(const std::string& key, const std::string& type, const XMLElement& joint) {
    const XMLElement* limit = joint.FirstChildElement("limit");
    if (!limit) {
      Warn(joint, key,
           "is missing: the URDF's specification asks for one of a " + type +
               " joint, and its positions are not judged: add <limit lower=... upper=... "
               "effort=... velocity=.../>" +
               (type == "revolute" ? ", or make it continuous" : ""));
      return;
    }
    const std::vector<double> lower = CheckNumbers(*limit, key, "lower", 1, Range::kFinite, false);
    const std::vector<double> upper = CheckNumbers(*limit, key, "upper", 1, Range::kFinite, false);
    const double from = lower.empty() ? 0 : lower[0], to = upper.empty() ? 0 : upper[0];
    if (from < to) return;
    if (from == to) {
      Warn(*limit, key,
           "got " + FormatRounded(from, 6) +
               " for lower and upper, which leaves no way to move: its positions are not judged; "
               "say how far it goes");
      return;
    }
    Warn(*limit, key,
         "got lower " + FormatRounded(from, 6) + " and upper " + FormatRounded(to, 6) +
             ", expected lower to be no more than upper: its positions are not judged; are they "
             "interchanged?");
  }

  void CheckMimic(const std::string& name, const XMLElement& joint) {
    const XMLElement* mimic = joint.FirstChildElement("mimic");
    if (!mimic) return;
    const std::string key = Key("joint", name) + ".mimic";
    CheckNumbers(*mimic, key, "multiplier", 1, Range::kFinite, false);
    CheckNumbers(*mimic, key, "offset", 1, Range::kFinite, false);
    if (!IsUsed(name)) return;
    const std::string leader = mimic->Attribute("joint") ? mimic->Attribute("joint") : "";
    if (!Find(joint_of_, leader)) {
      Add(*mimic, key + ".joint",
          "there is no joint '" + leader + "'" + Suggestion(leader, joints_));
      return;
    }
    std::set<std::string> seen = {name};
    std::string next = leader;
    while (!next.empty() && leading_.count(next) == 0) {
      if (!seen.insert(next).second) {
        Add(*mimic, key, "joints follow each other in a circle");
        return;
      }
      const XMLElement* followed = Find(joint_of_, next);
      const XMLElement* follows = followed ? followed->FirstChildElement("mimic") : nullptr;
      next = follows && follows->Attribute("joint") ? follows->Attribute("joint") : "";
    }
    leading_.merge(seen);
  }

  /// The link that a joint's <parent> or <child> names; "" where it is missing or unknown.
  std::string CheckEnd(const std::string& joint_name, const XMLElement& joint, const char* end) {
    const XMLElement* element = joint.FirstChildElement(end);
    const std::string key = Key("joint", joint_name) + "." + end;
    if (!element || !element->Attribute("link")) {
      Add(joint, key, "is missing");
      return "";
    }
    const std::string link = element->Attribute("link");
    if (Find(link_of_, link)) return link;
    Add(*element, key, "there is no link '" + link + "'" + Suggestion(link, links_));
    return "";
  }

  void CheckTree() {
    std::map<std::string, std::pair<std::string, const XMLElement*>> above;  // by child
    bool complete = true;
    for (const auto& [name, joint] : joints_) {
      const std::string parent = CheckEnd(name, *joint, "parent");
      const std::string child = CheckEnd(name, *joint, "child");
      if (parent.empty() || child.empty()) {
        complete = false;
        continue;
      }
      const auto [first, added] = above.emplace(child, std::make_pair(parent, joint));
      if (!added) {
        Add(*joint, Key("joint", name) + ".child",
            "link '" + child + "' has a parent already: joint '" + NameOf(*first->second.second) +
                "' in line " + std::to_string(first->second.second->GetLineNum()));
      }
    }
    // A joint whose ends are unknown would make its child look like a root.
    if (!complete) return;
    std::vector<std::string> roots;
    for (const auto& [name, link] : links_) {
      std::set<std::string> seen;
      std::string top = name;
      while (above.count(top) > 0 && rooted_.count(top) == 0 && seen.insert(top).second)
        top = above[top].first;
      if (above.count(top) > 0 && rooted_.count(top) == 0) {
        Add(*above[name].second, Key("link", name), "joints close a loop above this link");
        return;
      }
      if (above.count(name) == 0) roots.push_back(name);
      rooted_.merge(seen);
    }
    for (std::size_t i = 1; i < roots.size(); ++i) {
      Add(*Find(link_of_, roots[i]), Key("link", roots[i]),
          "has no parent, but the root is '" + roots[0] + "' already: a vehicle is one tree");
    }
  }

  const XMLElement& robot_;
  std::string path_;
  const UrdfUse& use_;
  Problems& problems_;
  Problems& warnings_;
  Problems& notes_;
  Named links_, joints_;
  ByName link_of_, joint_of_;
  std::set<std::string> rooted_;   // links above which no loop is
  std::set<std::string> leading_;  // joints that follow no circle
  int suggestions_ = 0;
  std::set<std::string> used_joints_;
};

}  // namespace

void CheckUrdf(const XMLElement& robot, const std::string& path, const UrdfUse& use,
               Problems* problems, Problems* warnings, Problems* notes) {
  Problems found;
  UrdfCheck(robot, path, use, &found, warnings, notes).Run();
  // What only xacro understands is nothing to urdfdom: it does not matter where all else is there.
  for (const XMLElement* e = robot.FirstChildElement(); e; e = e->NextSiblingElement()) {
    if (std::string(e->Name()).rfind("xacro:", 0) != 0) continue;
    if (found.empty()) {
      notes->Add(path, e->GetLineNum(), e->Name(),
                 "this is xacro, not URDF, and counts for nothing");
      continue;
    }
    found = Problems();
    found.Add(path, e->GetLineNum(), e->Name(), "this is xacro, not URDF: run xacro on it first");
    break;
  }
  problems->Append(found);
}

std::string NameOf(const XMLElement& element) {
  const char* name = element.Attribute("name");
  return name ? name : "";
}

}  // namespace cosserat_cable
