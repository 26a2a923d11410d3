#include "slip_units.h"

#include <cmath>
#include <cstdio>

#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {
namespace {

std::string Formatted(const char* format, double value) {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

std::vector<Unit> UnitsOf(Quantity quantity) {
  constexpr double kDegrees = 57.29577951308232, kGravity = 9.80665;
  switch (quantity) {
    case Quantity::kPosition:
      return {{1e3, "millimetres"},
              {1e2, "centimetres"},
              {39.3700787, "inches"},
              {1e-3, "metres that were taken for millimetres"}};
    case Quantity::kVelocity:
      return {{1e3, "mm/s"}, {1e2, "cm/s"}, {39.3700787, "inches per second"}};
    case Quantity::kAcceleration:
      return {{1 / kGravity, "multiples of g"}, {1e3, "mm/s^2"}, {1e2, "cm/s^2"}};
    case Quantity::kAngle:
      return {{kDegrees, "degrees"},
              {0.15915494309, "turns"},
              {1 / kDegrees, "radians that were taken for degrees"}};
    case Quantity::kRate:
      return {{kDegrees, "degrees per second"},
              {9.5492965855, "turns per minute"},
              {0.15915494309, "turns per second"},
              {1 / kDegrees, "rad/s that were taken for degrees per second"}};
    case Quantity::kForce:
      return {{1e3, "millinewtons"},
              {1 / kGravity, "kilograms"},
              {1e3 / kGravity, "grams"},
              {0.224808943, "pounds"},
              {1e-3, "kilonewtons"}};
    case Quantity::kMoment:
      return {{1e3, "N mm"}, {1e2, "N cm"}, {8.8507457676, "pound inches"}};
  }
  return {};
}

std::string WithUnit(Quantity quantity, double value) {
  switch (quantity) {
    case Quantity::kPosition:
      return std::abs(value) < 1e-3  ? FormatRounded(1e3 * value, 2) + " mm"
             : std::abs(value) < 0.1 ? Formatted("%.1f", 1e3 * value) + " mm"
                                     : FormatRounded(value, 4) + " m";
    case Quantity::kVelocity:
      return FormatRounded(value) + " m/s";
    case Quantity::kAcceleration:
      return FormatRounded(value) + " m/s^2";
    case Quantity::kAngle:
      return FormatRounded(value) + " rad";
    case Quantity::kRate:
      return FormatRounded(value) + " rad/s";
    case Quantity::kForce:
      return FormatRounded(value) + " N";
    case Quantity::kMoment:
      return FormatRounded(value) + " N m";
  }
  return "";
}

std::string Seconds(double value) {
  return Formatted(std::abs(value) < 0.1 ? "%.2g" : "%.2f", value) + " s";
}

}  // namespace cosserat_cable
