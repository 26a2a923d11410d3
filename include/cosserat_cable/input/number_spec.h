// What number is expected of a user: its range, its unit, and the slip that a wrong one suggests.
#pragma once

#include <limits>
#include <string>

namespace cosserat_cable {

/// A range of finite numbers with a unit. Written as a sentence:
///
///     NumberSpec::Above(0, "m").AtMost(20).Hint("is it in mm?")
///
/// prints as "a number in (0, 20] [m]".
class NumberSpec {
 public:
  /// Any finite number. `unit` may be empty.
  static NumberSpec Any(std::string unit);
  static NumberSpec Above(double low, std::string unit);
  static NumberSpec AtLeast(double low, std::string unit);

  NumberSpec& Below(double high);
  NumberSpec& AtMost(double high);
  /// Said after the expectation where a number lies above the range: the likely slip.
  NumberSpec& Hint(std::string hint);
  /// Says that something else than a number will also do, e.g. "'critical'".
  NumberSpec& Or(std::string alternative);

  bool Contains(double value) const;
  double low() const { return low_; }
  double high() const { return high_; }
  /// Whether the lower end is in the range.
  bool low_belongs() const { return low_belongs_; }
  const std::string& unit() const { return unit_; }
  /// "a positive number [N m^2]", "a number in (0, 20] [m]", ...
  std::string Expected() const;
  /// The hint as ": is it in mm?" where `value` lies above the range, else "".
  std::string HintFor(double value) const;

 private:
  double low_ = -std::numeric_limits<double>::infinity();
  double high_ = std::numeric_limits<double>::infinity();
  bool low_belongs_ = false;
  bool high_belongs_ = false;
  std::string unit_, hint_, alternative_;
};

}  // namespace cosserat_cable
