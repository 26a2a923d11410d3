// Rotations of the small angles that occur in one element or one time step, without trigonometry.
#pragma once

#include "cosserat_cable/math/lanes.h"
#include "cosserat_cable/math/small.h"

namespace cosserat_cable::rod {

/// Functions of x^2 with x = tan(angle/4), the length of the modified Rodrigues vector.
template <class T>
struct ArcTangentSeries {
  T angle;  ///< 4 atan(x)/x, so that the rotation vector is `angle` times the Rodrigues vector
  T tau;    ///< 1/angle
  T c;      ///< (1 - (angle/2) cot(angle/2))/angle^2
};

// Below this, an angle of 0.35 rad in one element, the series are exact to rounding: seven terms of
// the first (x2^7/15 < 1e-16); the other two are multiplied by the angle and its square.
constexpr double kArcTangentSeriesBelow = 0.0075;

template <class T>
ArcTangentSeries<T> SumArcTangentSeries(const T& x2) {
  ArcTangentSeries<T> s;
  s.angle =
      4.0 -
      x2 * (4.0 / 3 -
            x2 * (4.0 / 5 - x2 * (4.0 / 7 - x2 * (4.0 / 9 - x2 * (4.0 / 11 - x2 * (4.0 / 13))))));
  s.tau =
      1.0 / 4 +
      x2 * (1.0 / 12 -
            x2 * (1.0 / 45 - x2 * (11.0 / 945 - x2 * (107.0 / 14175 - x2 * (2549.0 / 467775 -
                                                                            x2 * 0.0041968878)))));
  s.c = 1.0 / 12 +
        x2 * (1.0 / 45 -
              x2 * (2.0 / 315 - x2 * (7.0 / 2025 - x2 * (1076.0 / 467775 - x2 * 0.0016922626))));
  return s;
}

inline ArcTangentSeries<double> EvaluateArcTangent(double x2) {
  if (x2 < kArcTangentSeriesBelow) return SumArcTangentSeries(x2);
  const double x = std::sqrt(x2);
  const double A = std::atan(x) / x;
  return {4 * A, 0.25 / A, (1.0 - A * (1.0 - x2)) / (16 * A * A * x2)};
}

/// Replaces what the series gave in the lanes whose angle is too large for them. Not inline, for it
/// is rare.
template <int N>
__attribute__((noinline)) void CorrectArcTangent(const BasicLanes<N>& x2,
                                                 ArcTangentSeries<BasicLanes<N>>* series) {
  for (int lane = 0; lane < N; ++lane) {
    if (x2[lane] < kArcTangentSeriesBelow) continue;
    const ArcTangentSeries<double> one = EvaluateArcTangent(x2[lane]);
    SetLane(&series->angle, lane, one.angle);
    SetLane(&series->tau, lane, one.tau);
    SetLane(&series->c, lane, one.c);
  }
}

template <int N>
ArcTangentSeries<BasicLanes<N>> EvaluateArcTangent(const BasicLanes<N>& x2) {
  ArcTangentSeries<BasicLanes<N>> series = SumArcTangentSeries(x2);
  CorrectArcTangent(x2, &series);
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

/// Replaces what the series gave in the lanes whose angle is too large for it.
template <int N>
__attribute__((noinline)) void CorrectExp(const Vec3<BasicLanes<N>>& phi, const BasicLanes<N>& y,
                                          Quat<BasicLanes<N>>* q) {
  for (int lane = 0; lane < N; ++lane) {
    if (y[lane] < kExpSeriesBelow) continue;
    const Quat<double> one = Exp(Vec3<double>{phi.x[lane], phi.y[lane], phi.z[lane]});
    SetLane(&q->w, lane, one.w);
    SetLane(&q->x, lane, one.x);
    SetLane(&q->y, lane, one.y);
    SetLane(&q->z, lane, one.z);
  }
}

}  // namespace cosserat_cable::rod
