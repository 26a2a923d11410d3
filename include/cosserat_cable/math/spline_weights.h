// First and second derivative of a natural interpolating spline at one of its knots, as weights of
// the values there.
//
// The natural spline of degree 2m - 1 is the interpolant f with the least integral of (f^(m))^2
// (Schoenberg; e.g. Wahba, Spline Models for Observational Data, ch. 1). It reproduces polynomials
// of degree m - 1, and does not run away where samples are unevenly spaced, as a polynomial would.
#pragma once

#include <array>

namespace cosserat_cable {

/// Of one knot: f' = sum_k first[k] f_k [1/s], f'' = sum_k second[k] f_k [1/s^2].
struct SplineWeights {
  static constexpr int kMaxKnots = 32;
  std::array<double, kMaxKnots> first{};
  std::array<double, kMaxKnots> second{};
};

/// Degrees that are implemented.
enum class SplineDegree { kCubic = 3, kSeven = 7, kNine = 9 };

/// The weights for knot `knot` of `count` <= kMaxKnots knots at strictly increasing `times` [s];
/// all zero for a single knot. @pre cubic: any count; else count >= (degree + 1) / 2
SplineWeights NaturalSplineWeights(const double* times, int count, int knot, SplineDegree degree);

}  // namespace cosserat_cable
