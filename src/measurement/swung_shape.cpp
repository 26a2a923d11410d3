#include "swung_shape.h"

#include <algorithm>

#include "cosserat_cable/math/rotation.h"

namespace cosserat_cable {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

// Turn [rad] over which velocities are differences: their error is of its square.
constexpr double kDifference = 1e-4;

/// Values given at evenly spread nodes, at others: the cubic through the four nearest, so that more
/// elements find the same curvatures.
Vector3d Resampled(const std::vector<Vector3d>& values, double fraction) {
  const auto last = static_cast<int>(values.size()) - 1;
  const double x = fraction * last;
  const int first = std::clamp(static_cast<int>(x) - 1, 0, std::max(0, last - 3));
  const int count = std::min(4, last + 1);
  Vector3d sum = Vector3d::Zero();
  for (int i = 0; i < count; ++i) {
    double weight = 1;
    for (int k = 0; k < count; ++k)
      if (k != i) weight *= (x - (first + k)) / (i - k);
    sum += weight * values[static_cast<std::size_t>(first + i)];
  }
  return sum;
}

/// The frame in the middle of an element.
Quaterniond Middle(const Quaterniond& left, const Vector3d& turn) {
  return left * RotationExp(0.5 * turn);
}

/// What an arc of length `h` that turns by `theta` is longer than its chord, in the middle's frame:
/// the rod's elements are as long as their arcs.
Vector3d ArcBeyondChord(double h, const Vector3d& theta) {
  return h / 24 * (theta.squaredNorm() * Vector3d::UnitZ() - theta.z() * theta);
}

}  // namespace

SwungShape::SwungShape(const std::vector<Pose>& rest, double length, const Swing& swing,
                       const Eigen::Matrix3d& held)
    : rest_(rest), h_(length / static_cast<double>(rest.size() - 1)), swing_(swing), held_(held) {}

std::vector<Pose> SwungShape::At(double time) const {
  const std::size_t last = rest_.size() - 1;
  const auto fraction = [&](std::size_t i) {
    return static_cast<double>(i) / static_cast<double>(last);
  };
  const auto rotation = [&](std::size_t i) -> Vector3d {
    return Resampled(swing_.rotation, fraction(i)) +
           time * Resampled(swing_.angular_velocity, fraction(i));
  };
  const auto displacement = [&](std::size_t i) -> Vector3d {
    return Resampled(swing_.displacement, fraction(i)) +
           time * Resampled(swing_.velocity, fraction(i));
  };
  const auto turn = [](const Quaterniond& from, const Quaterniond& to) -> Vector3d {
    return RotationLog(from.conjugate() * to);
  };
  std::vector<Pose> nodes(rest_.size());
  for (std::size_t i = 0; i <= last; ++i)
    nodes[i].q = (rest_[i].q * RotationExp(rotation(i))).normalized();
  nodes[0].p = rest_[0].p + displacement(0);
  for (std::size_t i = 0; i < last; ++i) {
    const Vector3d rest_turn = turn(rest_[i].q, rest_[i + 1].q);
    const Vector3d swung_turn = turn(nodes[i].q, nodes[i + 1].q);
    const Vector3d chord =
        Middle(rest_[i].q, rest_turn).conjugate() * (rest_[i + 1].p - rest_[i].p) +
        ArcBeyondChord(h_, rest_turn) - ArcBeyondChord(h_, swung_turn);
    nodes[i + 1].p = nodes[i].p + Middle(nodes[i].q, swung_turn) * chord;
  }
  const Vector3d gap = held_ * (rest_[last].p + displacement(last) - nodes[last].p);
  for (std::size_t i = 1; i <= last; ++i) nodes[i].p += fraction(i) * gap;
  return nodes;
}

void SwungShape::Velocities(std::vector<Vector3d>* v, std::vector<Vector3d>* omega) const {
  double fastest = 0;
  for (const Vector3d& rate : swing_.angular_velocity) fastest = std::max(fastest, rate.norm());
  const double h = fastest > 0 ? kDifference / fastest : 1.0;
  const std::vector<Pose> before = At(-h), after = At(h);
  v->resize(rest_.size());
  omega->resize(rest_.size());
  for (std::size_t i = 0; i < rest_.size(); ++i) {
    (*v)[i] = (after[i].p - before[i].p) / (2 * h);
    (*omega)[i] = RotationLog(before[i].q.conjugate() * after[i].q) / (2 * h);
  }
}

}  // namespace cosserat_cable
