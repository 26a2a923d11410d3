#include "cosserat_cable/input/yaml_value.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {
namespace {

// More off unit length than rounding to four digits explains.
constexpr double kQuaternionTolerance = 1e-3;
// [m] No vehicle is longer; a clamp 150 mm from its link's origin, written in mm, is beyond.
constexpr double kFarthest = 100;
constexpr std::size_t kLongestShown = 60;

bool IsLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool IsWordCharacter(char c) { return IsLetter(c) || (c >= '0' && c <= '9') || c == '_'; }

}  // namespace

YamlValue YamlValue::Root(const std::string& file, const YAML::Node& node, Problems* problems) {
  return YamlValue(State::kGiven, node, {file, std::max(1, node.Mark().line + 1), ""}, problems);
}

bool YamlValue::IsText(const std::string& text) const {
  return IsScalar() && node_.Scalar() == text;
}

std::string YamlValue::Shown() const {
  if (!given() || node_.IsNull()) return "nothing";
  if (node_.IsMap()) return "a map";
  if (node_.IsSequence()) return "a list of " + std::to_string(node_.size());
  std::string text = node_.Scalar();
  const bool number = !IsQuoted() && ParseNumber(text).kind != NumberText::Kind::kNone;
  if (text.size() > kLongestShown) text = text.substr(0, kLongestShown) + "...";
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return number ? text : "'" + text + "'";
}

void YamlValue::Report(const std::string& message) const {
  if (state_ != State::kAbsent) problems_->Add(mark_, message);
}

void YamlValue::ReportUnexpected(const std::string& expected) const {
  Report((given() ? "got " + Shown() : "missing") + ", expected " + expected);
}

std::optional<double> YamlValue::Number(const NumberSpec& spec) const {
  NumberText number;
  if (IsScalar() && !IsQuoted()) number = ParseNumber(node_.Scalar());
  if (number.kind == NumberText::Kind::kFinite && spec.Contains(number.value)) return number.value;
  const bool finite = number.kind == NumberText::Kind::kFinite;
  ReportUnexpected(spec.Expected() + (finite ? spec.HintFor(number.value) : ""));
  return std::nullopt;
}

std::optional<int> YamlValue::Integer(int low, int high) const {
  NumberText number;
  if (IsScalar() && !IsQuoted()) number = ParseNumber(node_.Scalar());
  if (number.kind == NumberText::Kind::kFinite && number.value == std::floor(number.value) &&
      number.value >= low && number.value <= high) {
    return static_cast<int>(number.value);
  }
  ReportUnexpected("a whole number in [" + std::to_string(low) + ", " + std::to_string(high) + "]");
  return std::nullopt;
}

std::optional<bool> YamlValue::Flag() const {
  if (IsScalar() && !IsQuoted() && (IsText("true") || IsText("false"))) return IsText("true");
  ReportUnexpected("true or false");
  return std::nullopt;
}

std::optional<std::string> YamlValue::Text(const std::string& expected) const {
  if (IsScalar() && !node_.Scalar().empty()) return node_.Scalar();
  ReportUnexpected(expected);
  return std::nullopt;
}

std::optional<std::string> YamlValue::Name() const {
  if (IsScalar()) {
    const std::string& text = node_.Scalar();
    if (!text.empty() && IsLetter(text[0]) &&
        std::all_of(text.begin(), text.end(), IsWordCharacter)) {
      return text;
    }
  }
  ReportUnexpected("a name of letters, digits and underscores that starts with a letter");
  return std::nullopt;
}

std::optional<std::string> YamlValue::OneOf(const std::vector<std::string>& words) const {
  if (IsScalar() && std::find(words.begin(), words.end(), node_.Scalar()) != words.end()) {
    return node_.Scalar();
  }
  std::string expected;
  for (const std::string& word : words) expected += (expected.empty() ? "one of " : ", ") + word;
  const std::string nearest = IsScalar() ? NearestWord(node_.Scalar(), words) : "";
  if (!nearest.empty()) expected += ": did you mean '" + nearest + "'?";
  ReportUnexpected(expected);
  return std::nullopt;
}

std::optional<Eigen::VectorXd> YamlValue::Numbers(int count, const NumberSpec& spec) const {
  const std::string expected = "a list of " + std::to_string(count) + " numbers";
  if (!IsList() || static_cast<int>(node_.size()) != count) {
    ReportUnexpected(expected);
    return std::nullopt;
  }
  Eigen::VectorXd numbers(count);
  bool all_good = true;
  int i = 0;
  for (const YamlValue& item : Items(expected)) {
    const std::optional<double> number = item.Number(spec);
    all_good = all_good && number.has_value();
    numbers[i++] = number.value_or(0);
  }
  return all_good ? std::make_optional(numbers) : std::nullopt;
}

std::optional<Eigen::Vector3d> YamlValue::Vector3(const NumberSpec& spec) const {
  const std::optional<Eigen::VectorXd> numbers = Numbers(3, spec);
  return numbers ? std::make_optional<Eigen::Vector3d>(*numbers) : std::nullopt;
}

std::optional<Pose> YamlValue::PoseOf() const {
  const std::string expected = "a pose [x, y, z, qx, qy, qz, qw] in metres";
  const std::vector<YamlValue> items =
      IsList() && node_.size() == 7 ? Items(expected) : std::vector<YamlValue>();
  if (items.empty()) {
    ReportUnexpected(expected);
    return std::nullopt;
  }
  const NumberSpec position =
      NumberSpec::AtLeast(-kFarthest, "m").AtMost(kFarthest).Hint("is it in mm?");
  double numbers[7];
  bool all_good = true;
  for (int i = 0; i < 7; ++i) {
    const std::optional<double> number = items[i].Number(i < 3 ? position : NumberSpec::Any(""));
    all_good = all_good && number.has_value();
    numbers[i] = number.value_or(0);
  }
  if (!all_good) return std::nullopt;
  Pose pose;
  pose.p = {numbers[0], numbers[1], numbers[2]};
  pose.q = Eigen::Quaterniond(numbers[6], numbers[3], numbers[4], numbers[5]);
  const double norm = pose.q.coeffs().stableNorm();
  if (!(std::abs(norm - 1) <= kQuaternionTolerance)) {
    Report("got a quaternion of length " + FormatRounded(norm) + ", expected unit length within " +
           FormatRounded(kQuaternionTolerance));
    return std::nullopt;
  }
  // One that is normalised already keeps its bits, so that a written file reads back the same.
  constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();
  if (std::abs(norm - 1) > kRounding) pose.q.coeffs() /= norm;
  return pose;
}

std::vector<YamlValue> YamlValue::Items(const std::string& expected) const {
  std::vector<YamlValue> items;
  if (!IsList()) {
    ReportUnexpected(expected);
    return items;
  }
  for (const YAML::Node& node : node_) {
    const std::string key = mark_.key + "[" + std::to_string(items.size()) + "]";
    items.push_back(
        YamlValue(State::kGiven, node, {mark_.file, node.Mark().line + 1, key}, problems_));
  }
  return items;
}

}  // namespace cosserat_cable
