#include "cosserat_cable/rod/element_curve.h"

#include "cosserat_cable/math/rotation.h"

namespace cosserat_cable::rod {
namespace {

/// Of what an element seems to be sheared, the part that is the section's own, along a1 and a2; the
/// rest is the S-shape of its bending. See shear_series.h.
Eigen::Vector2d OwnShear(const RodModel& model) {
  const double h = model.length / model.elements;
  const auto part = [&](double GA, double EI) {
    const double B = 12 * EI / (h * h);
    return B / (GA + B);
  };
  const Section& section = model.section;
  return {part(section.C_F.x(), section.C_M.y()), part(section.C_F.y(), section.C_M.x())};
}

}  // namespace

// R(t) = R_1 exp(t theta) has the integral R_1 t J_l(t theta), and J_l(phi) = J_r(-phi).
ElementCurve::ElementCurve(const Pose& first, const Pose& second, const Eigen::Vector2d& sheared)
    : first_(first),
      theta_(RotationLog(first.q.conjugate() * second.q)),
      helix_(RightJacobianInverse(-theta_) * (first.q.conjugate() * (second.p - first.p))),
      beyond_((sheared.x() - 1) * helix_.x(), (sheared.y() - 1) * helix_.y(), 0),
      beyond_second_(RotationExp(theta_) * beyond_) {}

ElementCurve::ElementCurve(const Pose& first, const Pose& second)
    : ElementCurve(first, second, Eigen::Vector2d::Zero()) {}

ElementCurve::ElementCurve(const Rod& rod, int element)
    : ElementCurve(rod.pose_behind(element), rod.pose(element + 1), OwnShear(rod.model())) {}

Pose ElementCurve::At(double t) const {
  const double rest = 1 - t;
  const Eigen::Vector3d turned = t * theta_;
  const Eigen::Vector3d way =
      t * (RightJacobian(-turned) * helix_) + t * rest * (rest * beyond_ - t * beyond_second_);
  return {first_.p + first_.q * way, first_.q * RotationExp(turned)};
}

}  // namespace cosserat_cable::rod
