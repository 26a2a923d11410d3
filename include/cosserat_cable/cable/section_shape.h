// The outline of a cable's section, as far as its file says it.
#pragma once

#include <algorithm>

namespace cosserat_cable {

/// A disc, or a rectangle (a flat cable, a strip): what rotary inertia, defaults and plausibility
/// follow from.
struct SectionShape {
  double diameter = 0;           ///< of a round one [m]
  double width = 0, height = 0;  ///< of a flat one, along a1 and a2 [m]; 0 of a round one

  bool flat() const { return width > 0; }
  double largest() const { return flat() ? std::max(width, height) : diameter; }  ///< [m]
  double area() const {                                                           ///< [m^2]
    return flat() ? width * height : kPi * diameter * diameter / 4;
  }
  /// Squared radii of gyration about a1 and a2 [m^2]: bending about a1 goes with the height.
  double gyration1() const { return flat() ? height * height / 12 : diameter * diameter / 16; }
  double gyration2() const { return flat() ? width * width / 12 : diameter * diameter / 16; }
  double polar() const { return gyration1() + gyration2(); }  ///< about a3 [m^2]

 private:
  static constexpr double kPi = 3.14159265358979323846;
};

}  // namespace cosserat_cable
