#include "cosserat_cable/input/number_spec.h"

#include <cmath>
#include <utility>

#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {

NumberSpec NumberSpec::Any(std::string unit) {
  NumberSpec spec;
  spec.unit_ = std::move(unit);
  return spec;
}

NumberSpec NumberSpec::Above(double low, std::string unit) {
  NumberSpec spec = Any(std::move(unit));
  spec.low_ = low;
  return spec;
}

NumberSpec NumberSpec::AtLeast(double low, std::string unit) {
  NumberSpec spec = Above(low, std::move(unit));
  spec.low_belongs_ = true;
  return spec;
}

NumberSpec& NumberSpec::Below(double high) {
  high_ = high;
  high_belongs_ = false;
  return *this;
}

NumberSpec& NumberSpec::AtMost(double high) {
  high_ = high;
  high_belongs_ = true;
  return *this;
}

NumberSpec& NumberSpec::Hint(std::string hint) {
  hint_ = std::move(hint);
  return *this;
}

NumberSpec& NumberSpec::Or(std::string alternative) {
  alternative_ = std::move(alternative);
  return *this;
}

bool NumberSpec::Contains(double value) const {
  if (!std::isfinite(value)) return false;
  const bool high_enough = low_belongs_ ? value >= low_ : value > low_;
  const bool low_enough = high_belongs_ ? value <= high_ : value < high_;
  return high_enough && low_enough;
}

std::string NumberSpec::Expected() const {
  const bool bounded_below = std::isfinite(low_);
  const bool bounded_above = std::isfinite(high_);
  std::string text;
  if (bounded_below && bounded_above) {
    text = std::string("a number in ") + (low_belongs_ ? "[" : "(") + FormatNumber(low_) + ", " +
           FormatNumber(high_) + (high_belongs_ ? "]" : ")");
  } else if (bounded_below && low_ == 0 && !low_belongs_) {
    text = "a positive number";
  } else if (bounded_below) {
    text = std::string("a number ") + (low_belongs_ ? ">= " : "> ") + FormatNumber(low_);
  } else if (bounded_above) {
    text = std::string("a number ") + (high_belongs_ ? "<= " : "< ") + FormatNumber(high_);
  } else {
    text = "a finite number";
  }
  if (!unit_.empty()) text += " [" + unit_ + "]";
  if (!alternative_.empty()) text += " or " + alternative_;
  return text;
}

std::string NumberSpec::HintFor(double value) const {
  return !hint_.empty() && value >= high_ ? ": " + hint_ : "";
}

}  // namespace cosserat_cable
