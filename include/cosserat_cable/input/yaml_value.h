// A value in a user's YAML file that knows where it stands, and says there what is wrong with it.
//
// How a schema is written with it:
//
//     Problems problems;
//     MapReader rig(LoadYamlFile("rig.yaml", &problems));          // map_reader.h
//     const auto name = rig.Required("name").Name();               // std::optional<std::string>
//     const auto length = rig.Required("length").Number(NumberSpec::Above(0, "m").AtMost(20));
//     const double mass = rig.Optional("mass").Number(NumberSpec::AtLeast(0, "kg")).value_or(0);
//     for (const YamlValue& item : rig.Optional("clamps").Items("a list of clamps")) {
//       MapReader clamp(item);
//       const auto X_WC = clamp.Required("pose").PoseOf();
//     }
//
// Each key is written once, with its type, unit, range and default. Whatever is wrong goes to
// `problems` ("rig.yaml:3: length: got 200, expected a number in (0, 20] [m]"), and reading goes
// on.
#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cosserat_cable/input/number_spec.h"
#include "cosserat_cable/input/problems.h"
#include "cosserat_cable/math/pose.h"

namespace cosserat_cable {

/// A value, or the place of one that is not there.
///
/// The readers below return nothing where the value is wrong, and then have said so. They are
/// silent for an optional key that is absent, and for everything below a value that was wrong
/// already; for a required key that is absent they say what was expected of it.
class YamlValue {
 public:
  /// Absent: every reader returns nothing, in silence.
  YamlValue() = default;

  /// @param problems outlives this value and all that are read from it.
  static YamlValue Root(const std::string& file, const YAML::Node& node, Problems* problems);

  bool given() const { return state_ == State::kGiven; }
  bool IsNull() const { return given() && node_.IsNull(); }
  bool IsMap() const { return given() && node_.IsMap(); }
  bool IsList() const { return given() && node_.IsSequence(); }
  /// null, a map without keys or a list without items.
  bool IsEmpty() const { return IsNull() || ((IsMap() || IsList()) && node_.size() == 0); }
  /// An unquoted or quoted scalar that reads exactly so.
  bool IsText(const std::string& text) const;

  /// File, line and path of the key; for an absent key those of the map that lacks it.
  const SourceMark& mark() const { return mark_; }

  /// Says "got VALUE, expected `expected`" at this place ("missing, expected ..." for a required
  /// key that is not there). Nothing for one that is absent.
  void ReportUnexpected(const std::string& expected) const;
  /// Says `message` at this place. Nothing for one that is absent.
  void Report(const std::string& message) const;
  /// What a message says that it got: the scalar as written, "a map", "a list of 3", "nothing".
  std::string Shown() const;

  /// A finite number in the range of `spec`. Quoted numbers are texts.
  std::optional<double> Number(const NumberSpec& spec) const;
  /// A whole number in [low, high].
  std::optional<int> Integer(int low, int high) const;
  /// true or false.
  std::optional<bool> Flag() const;
  /// A scalar that is not empty.
  std::optional<std::string> Text(const std::string& expected = "a text") const;
  /// A ROS graph name without namespace: a letter, then letters, digits and underscores.
  std::optional<std::string> Name() const;
  /// One of `words`; otherwise the nearest is suggested.
  std::optional<std::string> OneOf(const std::vector<std::string>& words) const;
  /// Exactly `count` numbers in the range of `spec`.
  std::optional<Eigen::VectorXd> Numbers(int count, const NumberSpec& spec) const;
  std::optional<Eigen::Vector3d> Vector3(const NumberSpec& spec) const;
  /// [x, y, z, qx, qy, qz, qw]: position [m] and rotation. The quaternion is normalised; one that
  /// is off unit length by more than 1e-3 is a mistake of the user's. Positions beyond 100 m are
  /// taken for a slip of units.
  std::optional<Pose> PoseOf() const;
  /// The items of a list; none where it is not one. `expected` names it: "a list of clamps".
  std::vector<YamlValue> Items(const std::string& expected) const;

 private:
  friend class MapReader;
  enum class State { kGiven, kAbsent, kMissing };

  YamlValue(State state, const YAML::Node& node, SourceMark mark, Problems* problems)
      : state_(state), node_(node), mark_(std::move(mark)), problems_(problems) {}

  bool IsScalar() const { return given() && node_.IsScalar(); }
  bool IsQuoted() const { return node_.Tag() == "!"; }

  State state_ = State::kAbsent;
  YAML::Node node_;
  SourceMark mark_;
  Problems* problems_ = nullptr;
};

/// Reads a file that holds one YAML document. A file that is missing, a directory, unreadable,
/// malformed or of several documents is a problem, with its line where there is one; then the
/// result is absent.
YamlValue LoadYamlFile(const std::string& path, Problems* problems);

}  // namespace cosserat_cable
