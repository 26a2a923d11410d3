#include "cosserat_cable/cable/resolution.h"

#include <algorithm>
#include <cmath>

#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {
namespace {

constexpr double kTautAt = 12;  // T h^2/EI: the residual bending of an element, see shear_series.h
constexpr double kMostTurn = 0.5;  // of an element [rad]

}  // namespace

NeededElements ElementsFor(const CableModel& cable, double tension, double curvature) {
  const double EI = std::min(cable.EI1, cable.EI2), L = cable.length;
  const auto at_least = [](double elements) { return static_cast<int>(std::ceil(elements)); };
  return {at_least(L * std::sqrt(std::max(0.0, tension) / (kTautAt * EI))),
          at_least(curvature * L / kMostTurn)};
}

std::string TooLongElements(const CableModel& cable, double tension, double curvature) {
  const NeededElements needed = ElementsFor(cable, tension, curvature);
  const double h = cable.length / cable.elements;
  std::string text;
  if (needed.for_tension > cable.elements) {
    const double layer = std::sqrt(std::min(cable.EI1, cable.EI2) / tension);
    text = "elements of " + FormatRounded(1e3 * h) + " mm do not resolve its bending under " +
           FormatRounded(tension) + " N, which is over " + FormatRounded(1e3 * layer) +
           " mm at clamps: tension and shape hold, the largest curvature is a mean; " +
           std::to_string(needed.for_tension) + " elements would do";
  }
  if (needed.for_curvature > cable.elements) {
    if (!text.empty()) text += "; ";
    text += "elements of " + FormatRounded(1e3 * h) + " mm turn by up to " +
            FormatRounded(curvature * h) + " rad, expected at most " + FormatRounded(kMostTurn) +
            " rad; " + std::to_string(needed.for_curvature) + " elements would do";
  }
  return text;
}

}  // namespace cosserat_cable
