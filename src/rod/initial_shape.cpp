#include "cosserat_cable/rod/initial_shape.h"

#include <algorithm>
#include <cmath>

#include "cosserat_cable/math/rotation.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Cubic Hermite curve with end tangents of length `reach`, plus a bump that leaves the ends alone.
struct Curve {
  Vector3d p0, p1, t0, t1, bow_direction;
  double reach = 0, bow = 0;

  Vector3d Point(double u) const {
    const double v = 1 - u;
    return v * v * (1 + 2 * u) * p0 + u * u * (3 - 2 * u) * p1 +
           reach * (u * v * v * t0 - u * u * v * t1) + 16 * bow * u * u * v * v * bow_direction;
  }
  Vector3d Derivative(double u) const {
    const double v = 1 - u;
    return 6 * u * v * (p1 - p0) + reach * (v * (1 - 3 * u) * t0 - u * (2 - 3 * u) * t1) +
           32 * bow * u * v * (1 - 2 * u) * bow_direction;
  }
  /// Arc lengths at `kSamples + 1` even values of u.
  static constexpr int kSamples = 400;
  std::vector<double> ArcLengths() const {
    std::vector<double> s(kSamples + 1, 0.0);
    Vector3d last = p0;
    for (int i = 1; i <= kSamples; ++i) {
      const Vector3d next = Point(static_cast<double>(i) / kSamples);
      s[i] = s[i - 1] + (next - last).norm();
      last = next;
    }
    return s;
  }
  double Length() const { return ArcLengths().back(); }
};

/// Sets `*parameter` in [0, upper] so that the curve, whose length grows with it, has the length.
void FitLength(Curve* curve, double Curve::*parameter, double upper, double length) {
  double low = 0, high = upper;
  constexpr int kHalvings = 60;
  for (int i = 0; i < kHalvings; ++i) {
    curve->*parameter = 0.5 * (low + high);
    (curve->Length() < length ? low : high) = curve->*parameter;
  }
}

Vector3d WithoutComponent(const Vector3d& v, const Vector3d& unit) {
  return v - v.dot(unit) * unit;
}

Vector3d BowDirection(const Vector3d& chord, const Vector3d& t0, const Vector3d& t1,
                      const Vector3d& down, const Vector3d& a1) {
  const Vector3d along = chord.norm() > 0 ? chord.normalized() : t0;
  // Where the clamps point counts most; gravity and a fixed axis of the section decide what is left
  // open.
  constexpr double kGravity = 1e-1, kTieBreak = 1e-3;
  const Vector3d unit_down = down.norm() > 0 ? Vector3d(down.normalized()) : Vector3d::Zero();
  Vector3d direction = WithoutComponent(t0 - t1 + kGravity * unit_down + kTieBreak * a1, along);
  if (direction.norm() < kTieBreak * kTieBreak) direction = along.unitOrthogonal();
  return direction.normalized();
}

}  // namespace

std::vector<Pose> BowedShape(const Pose& a, const Pose& b, double length, int elements,
                             const Vector3d& down) {
  Curve curve;
  curve.p0 = a.p;
  curve.p1 = b.p;
  curve.t0 = a.q * Vector3d::UnitZ();
  curve.t1 = b.q * Vector3d::UnitZ();
  curve.bow_direction = BowDirection(b.p - a.p, curve.t0, curve.t1, down, a.q * Vector3d::UnitX());
  curve.reach = length;
  if (curve.Length() > length)
    FitLength(&curve, &Curve::reach, length, length);
  else
    FitLength(&curve, &Curve::bow, length, length);

  // Nodes at even arc lengths.
  const std::vector<double> s = curve.ArcLengths();
  std::vector<Pose> nodes(elements + 1);
  std::vector<Vector3d> tangents(elements + 1);
  int sample = 0;
  for (int i = 0; i <= elements; ++i) {
    const double target = s.back() * i / elements;
    while (sample < Curve::kSamples - 1 && s[sample + 1] < target) ++sample;
    const double step = s[sample + 1] - s[sample];
    const double u = (sample + (step > 0 ? (target - s[sample]) / step : 0.0)) / Curve::kSamples;
    nodes[i].p = curve.Point(std::clamp(u, 0.0, 1.0));
    const Vector3d derivative = curve.Derivative(std::clamp(u, 0.0, 1.0));
    tangents[i] = derivative.norm() > 0 ? Vector3d(derivative.normalized()) : curve.t0;
  }
  tangents.front() = curve.t0;
  tangents.back() = curve.t1;

  // Frames without twist, then the rest of the twist spread evenly.
  nodes.front().q = a.q;
  for (int i = 1; i <= elements; ++i)
    nodes[i].q = (ShortestTurn(tangents[i - 1], tangents[i]) * nodes[i - 1].q).normalized();
  const Quaterniond rest = nodes.back().q.conjugate() * b.q;
  double twist = 2 * std::atan2(rest.z(), rest.w());
  twist = std::remainder(twist, 2 * M_PI);
  for (int i = 1; i <= elements; ++i)
    nodes[i].q =
        nodes[i].q * Quaterniond(Eigen::AngleAxisd(twist * i / elements, Vector3d::UnitZ()));
  nodes.back() = b;
  return nodes;
}

std::vector<Pose> StraightShape(const Pose& a, double length, int elements) {
  std::vector<Pose> nodes(elements + 1);
  for (int i = 0; i <= elements; ++i)
    nodes[i] = a * Pose{Vector3d(0, 0, length * i / elements), Quaterniond::Identity()};
  return nodes;
}

}  // namespace cosserat_cable::rod
