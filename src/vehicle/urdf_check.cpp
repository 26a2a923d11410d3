#include "urdf_check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <vector>

#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {
namespace {

using tinyxml2::XMLElement;

enum class Range { kFinite, kPositive, kNonZero };

const std::vector<std::string> kJointTypes = {"fixed",     "revolute", "continuous",
                                              "prismatic", "floating", "planar"};
const std::vector<std::string> kGeometries = {"mesh", "box", "cylinder", "sphere"};

std::string Nearest(const std::string& word, const std::vector<std::string>& candidates) {
  const std::string nearest = NearestWord(word, candidates);
  return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
}

class UrdfCheck {
 public:
  UrdfCheck(const XMLElement& robot, std::string path, Problems* problems)
      : robot_(robot), path_(std::move(path)), problems_(*problems) {}

  void Run() {
    for (const XMLElement* e = robot_.FirstChildElement(); e; e = e->NextSiblingElement()) {
      if (std::string(e->Name()).rfind("xacro:", 0) == 0) {
        Add(*e, e->Name(), "this is xacro, not URDF: run xacro on it first");
        return;
      }
    }
    Collect("link", &links_);
    Collect("joint", &joints_);
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

  static std::vector<std::string> Names(const Named& elements) {
    std::vector<std::string> names;
    for (const auto& element : elements) names.push_back(element.first);
    return names;
  }

  static const XMLElement* Find(const Named& elements, const std::string& name) {
    for (const auto& [known, element] : elements) {
      if (known == name) return element;
    }
    return nullptr;
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
      const bool in_range =
          range == Range::kFinite || number > 0 || (range == Range::kNonZero && number < 0);
      if (in_range) continue;
      Add(element, full_key,
          "got '" + std::string(text) + "', expected " + expected +
              (range == Range::kPositive ? ", positive" : ", not zero"));
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

  void CheckGeometry(const XMLElement& element, const std::string& key) {
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
      CheckNumbers(*shape, shape_key, "scale", 3, Range::kNonZero, false);
    } else if (kind == "box") {
      CheckNumbers(*shape, shape_key, "size", 3, Range::kPositive, true);
    } else if (kind == "cylinder") {
      CheckNumbers(*shape, shape_key, "radius", 1, Range::kPositive, true);
      CheckNumbers(*shape, shape_key, "length", 1, Range::kPositive, true);
    } else if (kind == "sphere") {
      CheckNumbers(*shape, shape_key, "radius", 1, Range::kPositive, true);
    } else {
      Add(*shape, shape_key,
          "unknown geometry, expected mesh, box, cylinder or sphere" + Nearest(kind, kGeometries));
    }
  }

  void CheckLink(const std::string& name, const XMLElement& link) {
    for (const char* kind : {"visual", "collision"}) {
      const std::string key = Key("link", name) + "." + kind;
      for (const XMLElement* e = link.FirstChildElement(kind); e; e = e->NextSiblingElement(kind)) {
        CheckOrigin(*e, key);
        CheckGeometry(*e, key);
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
    if (type == "planar") {
      Add(joint, key + ".type", "planar joints are not supported: two positions, one message");
    } else if (std::count(kJointTypes.begin(), kJointTypes.end(), type) == 0) {
      Add(joint, key + ".type",
          "got '" + type + "', expected fixed, revolute, continuous, prismatic or floating" +
              Nearest(type, kJointTypes));
    }
    if (const XMLElement* axis = joint.FirstChildElement("axis")) {
      const std::vector<double> xyz =
          CheckNumbers(*axis, key + ".axis", "xyz", 3, Range::kFinite, true);
      const bool turns = type == "revolute" || type == "continuous" || type == "prismatic";
      if (turns && xyz.size() == 3 && std::hypot(xyz[0], xyz[1], xyz[2]) == 0) {
        Add(*axis, key + ".axis.xyz", "got '0 0 0', expected a direction");
      }
    }
    CheckMimic(name, joint);
  }

  void CheckMimic(const std::string& name, const XMLElement& joint) {
    const XMLElement* mimic = joint.FirstChildElement("mimic");
    if (!mimic) return;
    const std::string key = Key("joint", name) + ".mimic";
    CheckNumbers(*mimic, key, "multiplier", 1, Range::kFinite, false);
    CheckNumbers(*mimic, key, "offset", 1, Range::kFinite, false);
    const std::string leader = mimic->Attribute("joint") ? mimic->Attribute("joint") : "";
    if (!Find(joints_, leader)) {
      Add(*mimic, key + ".joint",
          "there is no joint '" + leader + "'" + Nearest(leader, Names(joints_)));
      return;
    }
    std::set<std::string> seen = {name};
    std::string next = leader;
    while (!next.empty()) {
      if (!seen.insert(next).second) {
        Add(*mimic, key, "joints follow each other in a circle");
        return;
      }
      const XMLElement* followed = Find(joints_, next);
      const XMLElement* follows = followed ? followed->FirstChildElement("mimic") : nullptr;
      next = follows && follows->Attribute("joint") ? follows->Attribute("joint") : "";
    }
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
    if (Find(links_, link)) return link;
    Add(*element, key, "there is no link '" + link + "'" + Nearest(link, Names(links_)));
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
      while (above.count(top) > 0 && seen.insert(top).second) top = above[top].first;
      if (above.count(top) > 0) {
        Add(*above[name].second, Key("link", name), "joints close a loop above this link");
        return;
      }
      if (top == name) roots.push_back(name);
    }
    for (std::size_t i = 1; i < roots.size(); ++i) {
      Add(*Find(links_, roots[i]), Key("link", roots[i]),
          "has no parent, but the root is '" + roots[0] + "' already: a vehicle is one tree");
    }
  }

  const XMLElement& robot_;
  std::string path_;
  Problems& problems_;
  Named links_, joints_;
};

}  // namespace

void CheckUrdf(const XMLElement& robot, const std::string& path, Problems* problems) {
  UrdfCheck(robot, path, problems).Run();
}

std::string NameOf(const XMLElement& element) {
  const char* name = element.Attribute("name");
  return name ? name : "";
}

}  // namespace cosserat_cable
