#include "approaches.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cosserat_cable {
namespace {

// How far a body's point moves at most, per distance from the body's origin. A turn about its axis
// does not count.
double Turn(int axis, const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
  if (axis >= 0) {
    const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
    return (to * unit - from * unit).norm();
  }
  // Of a turn by an angle: 4 sin(angle/4), which is not less than its chord 2 sin(angle/2).
  const Eigen::Vector4d q = from.coeffs(), r = to.coeffs();
  return 2 * std::sqrt(std::min((r - q).squaredNorm(), (r + q).squaredNorm()));
}

}  // namespace

Approaches::Approaches(const std::vector<const Body*>& bodies) {
  for (const Body* body : bodies) bodies_.emplace_back().body = body;
}

void Approaches::Move(const Pose& X_WC, const PointRows& nodes_W,
                      const std::vector<Motion>& bodies_W) {
  std::swap(nodes_C_, before_C_);
  nodes_C_.Assign(nodes_W, X_WC);
  const double way = nodes_C_.LongestWay(before_C_);
  const double radius = nodes_C_.Radius();
  const Eigen::Quaterniond q_CW = X_WC.q.conjugate();
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    Approached& body = bodies_[b];
    const Pose X_CB = {q_CW * (bodies_W[b].X.p - X_WC.p), q_CW * bodies_W[b].X.q};
    const double turn = Turn(body.body->axis(), body.X_CB.q, X_CB.q);
    body.at_least -= way + (X_CB.p - body.X_CB.p).norm() + (X_CB.p.norm() + radius) * turn;
    body.X_CB = X_CB;
  }
}

}  // namespace cosserat_cable
