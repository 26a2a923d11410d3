#include "state_dump.h"

#include <yaml-cpp/yaml.h>

#include <cstring>
#include <sstream>
#include <stdexcept>

#include "cosserat_cable/cable/cable_fleet.h"
#include "cosserat_cable/input/gravity.h"
#include "cosserat_cable/input/map_reader.h"
#include "cosserat_cable/math/state_archive.h"
#include "cosserat_cable/ros/summary.h"

namespace cosserat_cable {
namespace {

constexpr int kFormat = 2;
constexpr int kDigitsForTheEye = 9;
constexpr int kNumbersInALine = 6;
constexpr int kHexDigits = 16;
const std::vector<std::string> kFailed = {"settling", "step", "state"};

std::string InHexadecimal(const std::vector<double>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::uint64_t bits;
    std::memcpy(&bits, &numbers[i], sizeof bits);
    char word[kHexDigits + 2];
    const char* end =
        i + 1 == numbers.size() || i % kNumbersInALine == kNumbersInALine - 1 ? "\n" : " ";
    std::snprintf(word, sizeof word, "%016llx%s", static_cast<unsigned long long>(bits), end);
    text += word;
  }
  return text;
}

/// False where the text is no such list.
bool FromHexadecimal(const std::string& text, std::vector<double>* numbers) {
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (word.size() != kHexDigits ||
        word.find_first_not_of("0123456789abcdef") != std::string::npos)
      return false;
    const std::uint64_t bits = std::stoull(word, nullptr, 16);
    double number;
    std::memcpy(&number, &bits, sizeof number);
    numbers->push_back(number);
  }
  return true;
}

void Exchange(Surroundings* surroundings, StateArchive* archive) {
  archive->Exchange(&surroundings->a, &surroundings->b, &surroundings->obstacles);
}

void Emit(const Pose& pose, YAML::Emitter* out) {
  *out << YAML::Flow << YAML::BeginSeq << pose.p.x() << pose.p.y() << pose.p.z() << pose.q.x()
       << pose.q.y() << pose.q.z() << pose.q.w() << YAML::EndSeq;
}

std::string Indented(const std::string& text) {
  std::istringstream lines(text);
  std::string indented;
  for (std::string line; std::getline(lines, line);)
    indented += (line.empty() ? "" : "  ") + line + "\n";
  return indented;
}

std::vector<double> NumbersOf(const YamlValue& value) {
  std::vector<double> numbers;
  const std::string expected = "numbers in hexadecimal, 16 digits each";
  const std::optional<std::string> text = value.Text(expected);
  if (text && !FromHexadecimal(*text, &numbers)) value.ReportUnexpected(expected);
  return numbers;
}

}  // namespace

bool WriteStateDump(const std::string& path, const StateDump& dump) {
  YAML::Emitter out;
  out.SetDoublePrecision(kDigitsForTheEye);
  const auto item = [&out](const char* key, const auto& value) {
    out << YAML::Key << key << YAML::Value << value;
  };
  StateArchive then;
  Surroundings surroundings = dump.then;
  Exchange(&surroundings, &then);
  out << YAML::BeginMap;
  item("format", kFormat);
  out << YAML::Comment("a cable that failed; cable_replay --resume-dump repeats it");
  item("message", dump.message);
  item("failed", kFailed[static_cast<std::size_t>(dump.failed)]);
  item("stamp_ns", dump.stamp);
  item("world_frame", dump.world_frame);
  item("vehicle", dump.vehicle_file);
  out << YAML::Key << "obstacles" << YAML::Value << YAML::Flow << dump.obstacles;
  // For the eye: in the world frame, x y z qx qy qz qw.
  out << YAML::Key << "shown" << YAML::Value << YAML::BeginMap << YAML::Key << "clamp_a"
      << YAML::Value;
  Emit(dump.then.a.X, &out);
  out << YAML::Key << "clamp_b" << YAML::Value;
  Emit(dump.then.b.X, &out);
  out << YAML::Key << "last_good_nodes" << YAML::Value << YAML::BeginSeq;
  for (const Pose& node : dump.nodes) Emit(node, &out);
  out << YAML::EndSeq << YAML::EndMap;
  const Eigen::Vector3d& g = dump.gravity_W;
  out << YAML::Key << "gravity_and_step" << YAML::Value << YAML::Literal
      << InHexadecimal({g.x(), g.y(), g.z(), dump.dt});
  out << YAML::Key << "then" << YAML::Value << YAML::Literal << InHexadecimal(then.numbers());
  if (dump.failed != StateDump::Failed::kSettling)
    out << YAML::Key << "state" << YAML::Value << YAML::Literal << InHexadecimal(dump.state);
  out << YAML::EndMap;
  return WriteTextFile(
      path, std::string(out.c_str()) + "\ncable_file:\n" + Indented(WriteCableFile(dump.cable)));
}

StateDump ReadStateDump(const std::string& path, Problems* problems) {
  StateDump dump;
  const std::size_t problems_before = problems->all().size();
  const YamlValue root = LoadYamlFile(path, problems);
  if (!root.given()) return dump;
  MapReader map(root);
  const YamlValue format = map.Required("format");
  if (!format.IsText(std::to_string(kFormat)))
    format.ReportUnexpected(std::to_string(kFormat) + ", the version of a state's file");
  dump.message = map.Required("message").Text().value_or("");
  const std::string failed = map.Required("failed").OneOf(kFailed).value_or("step");
  for (std::size_t i = 0; i < kFailed.size(); ++i)
    if (failed == kFailed[i]) dump.failed = static_cast<StateDump::Failed>(i);
  const NumberSpec stamps = NumberSpec::AtLeast(0, "ns").AtMost(9e18);  // fits into 64 bits
  dump.stamp = static_cast<std::int64_t>(map.Required("stamp_ns").Number(stamps).value_or(0));
  dump.world_frame = map.Required("world_frame").Text().value_or("");
  const YamlValue vehicle = map.Required("vehicle");
  if (!vehicle.IsText("")) dump.vehicle_file = vehicle.Text("a URDF").value_or("");
  for (const YamlValue& link : map.Required("obstacles").Items("a list of links"))
    dump.obstacles.push_back(link.Text("the name of a link").value_or(""));
  map.Optional("shown");
  const YamlValue gravity_and_step = map.Required("gravity_and_step");
  const std::vector<double> four = NumbersOf(gravity_and_step);
  if (four.size() == 4) {
    dump.gravity_W = {four[0], four[1], four[2]};
    dump.dt = four[3];
  } else {
    gravity_and_step.ReportUnexpected("four numbers");
  }
  const YamlValue then = map.Required("then");
  dump.then.obstacles.resize(dump.obstacles.size());
  try {
    StateArchive archive(NumbersOf(then));
    Exchange(&dump.then, &archive);
    archive.Finish();
  } catch (const std::invalid_argument&) {
    then.ReportUnexpected("the motion of two clamps and of each obstacle");
  }
  if (dump.failed != StateDump::Failed::kSettling) dump.state = NumbersOf(map.Required("state"));
  const YamlValue cable = map.Required("cable_file");
  dump.cable = ReadCableFile(cable, problems);
  if (problems->all().size() == problems_before && dump.cable.cables.size() != 1)
    cable.ReportUnexpected("one cable");
  return dump;
}

std::string SettlingFailure(const StepOutcome& outcome) {
  return outcome.ok ? "" : "no equilibrium at the start: " + outcome.message;
}

std::string FailAgain(const StateDump& dump, const std::vector<const Body*>& bodies,
                      Problems* problems) {
  CableSimulation cable(dump.cable.cables.front(), bodies, dump.gravity_W);
  if (dump.failed == StateDump::Failed::kSettling)
    return SettlingFailure(cable.Settle(dump.then, Unstable::kFalls));
  try {
    cable.SetState(dump.state);
  } catch (const std::invalid_argument& error) {
    problems->Add("", 0, "state", error.what());
    return "";
  }
  if (dump.failed == StateDump::Failed::kState) {
    for (const Pose& node : cable.nodes())
      if (!node.p.allFinite() || !node.q.coeffs().allFinite()) return kNotFinite;
    return "";
  }
  CableFleet fleet({&cable});
  return fleet.Step(dump.dt, {&dump.then}).front().message;
}

}  // namespace cosserat_cable
