#include "arc_length.h"

#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {
namespace {

// Relative: what a program that computed s may have lost to rounding, printed to ten digits.
constexpr double kRounding = 1e-9;

}  // namespace

std::string ArcLengthProblem(double* s, const std::optional<double>& length) {
  if (*s < 0) return "got " + FormatNumber(*s) + ", expected a number >= 0 [m]";
  if (!length || *s <= *length) return "";
  if (*s > *length * (1 + kRounding)) {
    return "got " + FormatNumber(*s) + ", expected at most " + FormatNumber(*length) +
           " [m], the cable's length";
  }
  *s = *length;
  return "";
}

std::optional<double> ReadArcLength(const YamlValue& value, const std::optional<double>& length) {
  std::optional<double> s = value.Number(NumberSpec::Any("m"));
  if (!s) return std::nullopt;
  const std::string wrong = ArcLengthProblem(&*s, length);
  if (wrong.empty()) return s;
  value.Report(wrong);
  return std::nullopt;
}

}  // namespace cosserat_cable
