#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "../effects/effect.h"

namespace cosserat_cable::generator {

/// A short piece of the rod on which a force acts: a parabola of force per length about `centre`,
/// zero at `half_width` from it.
class Patch {
 public:
  Patch(double centre, double half_width) : centre_(centre), half_width_(half_width) {}

  /// Force per length at s of a total of 1 [1/m].
  double density(double s) const {
    const double x = (s - centre_) / half_width_;
    return std::max(0.0, 0.75 / half_width_ * (1.0 - x * x));
  }
  /// Mean of what is given at the stations.
  Eigen::Vector3d mean(const Eigen::VectorXd& s, const Points& values) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weight = 0.0;
    for (int i = 0; i < s.size(); ++i) {
      sum += density(s[i]) * values.col(i);
      weight += density(s[i]);
    }
    return sum / weight;
  }
  void add(const Eigen::VectorXd& s, const Eigen::Vector3d& force, Points* forces) const {
    for (int i = 0; i < s.size(); ++i) forces->col(i) += density(s[i]) * force;
  }

  /// Stations that resolve a patch of a twelfth of the length or more.
  static constexpr int kStations = 72;

 private:
  double centre_, half_width_;
};

/// The part of a world vector across the axis a3 of clamp a.
inline Eigen::Vector3d acrossAxis(const FrameMotion& clamp, const Eigen::Vector3d& x) {
  const Eigen::Vector3d axis = clamp.R.col(2);
  return x - axis.dot(x) * axis;
}

/// Place and velocity against clamp a's frame, in that frame.
struct RelativeMotion {
  Eigen::Vector3d x, v;
  RelativeMotion(const FrameMotion& a, const Eigen::Vector3d& position,
                 const Eigen::Vector3d& velocity)
      : x(a.R.transpose() * (position - a.p)),
        v(a.R.transpose() * (velocity - a.v - a.w.cross(position - a.p))) {}
};

}  // namespace cosserat_cable::generator
