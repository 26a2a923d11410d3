#include "cosserat_cable/input/gravity.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <set>

#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {
namespace {

// Twice what holds at Jupiter's clouds; 981 is in cm/s^2, and 9810 in mm/s^2.
constexpr double kMost = 50;  // [m/s^2]
// Directions that are nearer to an axis than this are meant to lie along it [rad].
constexpr double kAlongAxis = 1e-3;
// The mean of an accelerometer leans with a vehicle that brakes or stands on a slope; a z axis that
// points the other way is 180 degrees off.
constexpr double kLean = 45 * M_PI / 180;
// Many drivers take gravity out; smaller means say nothing [m/s^2].
constexpr double kFeltAtLeast = 1;
// Accelerometers are calibrated far better, but their mean also holds the ride's.
constexpr double kSizeDiffers = 0.3;
// A size that is so near to what gravity has in another unit, or elsewhere, is that.
constexpr double kSameSize = 0.08;

struct Unit {
  const char* name;
  double size;  // [m/s^2]
};
constexpr Unit kUnits[] = {
    {"g", 9.80665}, {"cm/s^2 or thousandths of g", 0.01}, {"mm/s^2", 0.001}, {"ft/s^2", 0.3048}};
// The moon, Mars, Jupiter [m/s^2].
constexpr double kElsewhere[] = {1.62, 3.71, 24.8};

std::vector<std::string> Split(const std::string& text, const char* separators) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (std::string(separators).find(c) != std::string::npos) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

std::string Trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::string Lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::string Direction(const Eigen::Vector3d& v) {
  const Eigen::Vector3d unit = v.normalized();
  for (int k = 0; k < 3; ++k) {
    if (std::hypot(unit[(k + 1) % 3], unit[(k + 2) % 3]) > kAlongAxis) continue;
    return std::string(unit[k] < 0 ? "-" : "+") + "xyz"[k];
  }
  char text[80];
  std::snprintf(text, sizeof text, "(%.3f, %.3f, %.3f)", unit.x(), unit.y(), unit.z());
  return text;
}

double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// What a user would write for what was felt: along an axis where that is near, with the usual size
// where that is near.
Eigen::Vector3d Rounded(const Eigen::Vector3d& g) {
  constexpr double kNearAxis = 10 * M_PI / 180;
  const double usual = kGravityDown.norm();
  const double size =
      std::abs(g.norm() - usual) < 0.05 * usual ? usual : std::round(100 * g.norm()) / 100;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d axis = std::copysign(1.0, g[k]) * Eigen::Vector3d::Unit(k);
    if (AngleBetween(g, axis) < kNearAxis) return size * axis;
  }
  return (100 * size * g.normalized()).array().round() / 100;
}

}  // namespace

std::optional<Eigen::Vector3d> ReadGravity(const std::vector<double>& values, Problems* problems) {
  const auto refuse = [problems](const std::string& got, const std::string& expected) {
    problems->Add("", 0, "gravity", "got " + got + ", expected " + expected);
    return std::nullopt;
  };
  if (values.size() != 3) {
    return refuse(std::to_string(values.size()) + (values.size() == 1 ? " number" : " numbers"),
                  "three, X,Y,Z [m/s^2] in the inertial frame");
  }
  const Eigen::Vector3d gravity(values[0], values[1], values[2]);
  if (!gravity.allFinite()) return refuse("a number that is not finite", "X,Y,Z [m/s^2]");
  if (gravity.norm() > kMost) {
    return refuse(FormatRounded(gravity.norm(), 4) + " m/s^2",
                  "at most " + FormatRounded(kMost) + " m/s^2, as 0,0,-9.81");
  }
  return gravity;
}

std::optional<Eigen::Vector3d> ReadGravity(const std::string& text, Problems* problems) {
  std::vector<double> values;
  for (const std::string& part : Split(text, ",")) {
    const NumberText number = ParseNumber(Trimmed(part));
    if (number.kind != NumberText::Kind::kFinite) {
      problems->Add("", 0, "gravity",
                    "got '" + text +
                        "', expected X,Y,Z [m/s^2] in the inertial frame, as "
                        "0,0,-9.81");
      return std::nullopt;
    }
    values.push_back(number.value);
  }
  return ReadGravity(values, problems);
}

std::string GravityText(const Eigen::Vector3d& gravity, const std::string& frame) {
  if (gravity.norm() == 0) return "no gravity";
  return "gravity " + FormatRounded(gravity.norm(), 4) + " m/s^2 along " + Direction(gravity) +
         " of " + frame;
}

std::string GravityOption(const Eigen::Vector3d& gravity) {
  std::string text;
  // No minus before a zero.
  for (int k = 0; k < 3; ++k)
    text += (k > 0 ? "," : "") + (gravity[k] == 0 ? "0" : FormatNumber(gravity[k]));
  return text;
}

VerticalAxis VerticalAxisOf(const std::string& frame) {
  static const std::set<std::string> kDown = {"ned", "frd", "zdown", "nwd", "esd"};
  static const std::set<std::string> kUp = {"enu", "flu", "nwu", "zup"};
  std::vector<std::string> words = Split(Lower(frame), "_/-. ");
  // z_down is one word.
  for (std::size_t i = 0; i + 1 < words.size(); ++i)
    if (words[i] == "z") words.push_back("z" + words[i + 1]);
  const auto has = [&words](const std::set<std::string>& any) {
    return std::any_of(words.begin(), words.end(),
                       [&any](const std::string& word) { return any.count(word) > 0; });
  };
  const bool down = has(kDown), up = has(kUp);
  if (down == up) return VerticalAxis::kUnknown;
  return down ? VerticalAxis::kDown : VerticalAxis::kUp;
}

std::string GravityHint(const Eigen::Vector3d& gravity, const std::string& frame) {
  const VerticalAxis axis = VerticalAxisOf(frame);
  if (axis == VerticalAxis::kUnknown || gravity.z() == 0) return "";
  const double sign = axis == VerticalAxis::kDown ? 1 : -1;
  if (gravity.z() * sign > 0) return "";
  Eigen::Vector3d meant = gravity;
  meant.z() = -meant.z();
  return "the name of '" + frame + "' says that its z axis points " + (sign > 0 ? "down" : "up") +
         ", but gravity is taken along " + Direction(gravity) + ": --gravity " +
         GravityOption(meant) + " would fit the name";
}

std::string GravityHint(const Eigen::Vector3d& gravity, const std::string& frame,
                        const Eigen::Vector3d& felt_W, const std::string& source) {
  Eigen::Vector3d felt = -felt_W;  // at rest an accelerometer feels what holds it up
  const double size = felt.norm(), expected = gravity.norm();
  if (!felt.allFinite() || size == 0 || expected == 0) return "";
  // Without gravity it may have any direction.
  const double from_axis =
      std::min(AngleBetween(gravity, felt), AngleBetween(gravity, Eigen::Vector3d(-felt)));
  std::string unit;
  for (const Unit& other : kUnits) {
    if (std::abs(other.size * size - expected) > kSameSize * expected || from_axis > kLean)
      continue;
    unit = other.name;
    felt *= other.size;
  }
  if (unit.empty() && size < kFeltAtLeast) return "";
  const bool leans = AngleBetween(gravity, felt) > kLean;
  const bool differs = std::abs(felt.norm() - expected) > kSizeDiffers * expected;
  if (!unit.empty()) {
    const std::string text = source + " has the size " + FormatRounded(size, 3) + ", gravity has " +
                             FormatRounded(expected, 3) + " m/s^2: is it in " + unit +
                             "? sensor_msgs/Imu is in m/s^2";
    if (!leans) return text;
    return text + "; as such it says " + GravityText(felt, frame) + ": --gravity " +
           GravityOption(Rounded(felt)) + " would fit it";
  }
  if (!leans && !differs) return "";
  const bool is_known =
      !differs || std::any_of(std::begin(kElsewhere), std::end(kElsewhere), [&](double elsewhere) {
        return std::abs(size - elsewhere) < kSameSize * elsewhere;
      });
  const std::string text = source + " says " + GravityText(felt, frame) + ", but " +
                           GravityText(gravity, frame) + " is taken";
  if (is_known) return text + ": --gravity " + GravityOption(Rounded(felt)) + " would fit it";
  const std::string doubt = ": is it raw, in another unit or scaled? sensor_msgs/Imu is in m/s^2";
  if (!leans) return text + doubt;
  return text + doubt + ". Its direction would be that of --gravity " +
         GravityOption(Rounded(expected * felt.normalized()));
}

}  // namespace cosserat_cable
