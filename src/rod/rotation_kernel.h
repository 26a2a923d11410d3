// Rotations of the small angles that occur in one element or one time step, without trigonometry.
#pragma once

#include "cosserat_cable/math/lanes.h"
#include "cosserat_cable/math/small.h"

namespace cosserat_cable::rod {

/// Functions of x^2 with x = tan(angle/4), the length of the modified Rodrigues vector.
template <class T>
struct ArcTangentSeries {
  T A;  ///< atan(x)/x, so that angle = 4 A x
  T B;  ///< (1 - A (1 - x^2))/x^2
};

// A = sum (-x2)^k/(2k+1), B = sum (-x2)^k (1/(2k+1) + 1/(2k+3)); seven terms are exact to rounding
// (x2^7/15 < 1e-16) below this, an angle of 0.35 rad in one element.
constexpr double kArcTangentSeriesBelow = 0.0075;

template <class T>
ArcTangentSeries<T> SumArcTangentSeries(const T& x2) {
  constexpr auto a = [](int k) { return 1.0 / (2 * k + 1); };
  constexpr auto b = [](int k) { return 1.0 / (2 * k + 1) + 1.0 / (2 * k + 3); };
  constexpr double kA[] = {a(0), a(1), a(2), a(3), a(4), a(5), a(6)};
  constexpr double kB[] = {b(0), b(1), b(2), b(3), b(4), b(5), b(6)};
  const auto horner = [&x2](const double* c) {
    return c[0] - x2 * (c[1] - x2 * (c[2] - x2 * (c[3] - x2 * (c[4] - x2 * (c[5] - x2 * c[6])))));
  };
  return {horner(kA), horner(kB)};
}

inline ArcTangentSeries<double> EvaluateArcTangent(double x2) {
  if (x2 < kArcTangentSeriesBelow) return SumArcTangentSeries(x2);
  const double x = std::sqrt(x2);
  const double A = std::atan(x) / x;
  return {A, (1.0 - A * (1.0 - x2)) / x2};
}

inline ArcTangentSeries<Lanes> EvaluateArcTangent(const Lanes& x2) {
  ArcTangentSeries<Lanes> series = SumArcTangentSeries(x2);
  for (int lane = 0; lane < Lanes::kCount; ++lane) {
    if (x2[lane] < kArcTangentSeriesBelow) continue;
    const ArcTangentSeries<double> one = EvaluateArcTangent(x2[lane]);
    series.A.v[lane] = one.A;
    series.B.v[lane] = one.B;
  }
  return series;
}

// Below this (angle/2)^2 the series of Exp, cut after y^5, are exact to 1e-16.
constexpr double kExpSeriesBelow = 0.05;

template <class T>
Quat<T> ExpSeries(const Vec3<T>& phi, const T& y) {
  const T c =
      1.0 -
      1.0 / 2 * y *
          (1.0 - 1.0 / 12 * y * (1.0 - 1.0 / 30 * y * (1.0 - 1.0 / 56 * y * (1.0 - 1.0 / 90 * y))));
  const T s =
      0.5 *
      (1.0 - 1.0 / 6 * y *
                 (1.0 - 1.0 / 20 * y *
                            (1.0 - 1.0 / 42 * y * (1.0 - 1.0 / 72 * y * (1.0 - 1.0 / 110 * y)))));
  return {c, s * phi.x, s * phi.y, s * phi.z};
}

/// Quaternion of the rotation vector `phi` [rad].
inline Quat<double> Exp(const Vec3<double>& phi) {
  const double y = 0.25 * Dot(phi, phi);  // (angle/2)^2
  if (y < kExpSeriesBelow) return ExpSeries(phi, y);
  const double half = std::sqrt(y), s = 0.5 * std::sin(half) / half;
  return {std::cos(half), s * phi.x, s * phi.y, s * phi.z};
}

inline Quat<Lanes> Exp(const Vec3<Lanes>& phi) {
  const Lanes y = 0.25 * Dot(phi, phi);
  Quat<Lanes> q = ExpSeries(phi, y);
  for (int lane = 0; lane < Lanes::kCount; ++lane) {
    if (y[lane] < kExpSeriesBelow) continue;
    const Quat<double> one = Exp(Vec3<double>{phi.x[lane], phi.y[lane], phi.z[lane]});
    q.w.v[lane] = one.w;
    q.x.v[lane] = one.x;
    q.y.v[lane] = one.y;
    q.z.v[lane] = one.z;
  }
  return q;
}

}  // namespace cosserat_cable::rod
