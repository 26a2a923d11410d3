#include "cosserat_cable/math/motion_between.h"

#include "cosserat_cable/math/rotation.h"

namespace cosserat_cable {
namespace {

Quintic LogarithmFromLeft(const Motion& left, const Motion& right, double h) {
  const Eigen::Vector3d turn = RotationLog(left.X.q.conjugate() * right.X.q);
  const ChartRates end = ToChartRates(turn, {right.omega, right.alpha});
  return {{Eigen::Vector3d::Zero(), left.omega, left.alpha}, {turn, end.d_phi, end.dd_phi}, h};
}

}  // namespace

MotionPiece::MotionPiece(const Motion& left, const Motion& right, double h)
    : q_left_(left.X.q),
      position_({left.X.p, left.v, left.a}, {right.X.p, right.v, right.a}, h),
      phi_(LogarithmFromLeft(left, right, h)) {}

Motion MotionPiece::At(double time) const {
  const Jet position = position_.At(time);
  const Jet phi = phi_.At(time);
  const BodyRates body = ToBodyRates(phi.value, {phi.first, phi.second});
  Motion motion;
  motion.X = {position.value, (q_left_ * RotationExp(phi.value)).normalized()};
  motion.v = position.first;
  motion.a = position.second;
  motion.omega = body.omega;
  motion.alpha = body.alpha;
  return motion;
}

Motion MotionBetween(const Motion& left, const Motion& right, double h, double time) {
  return MotionPiece(left, right, h).At(time);
}

}  // namespace cosserat_cable
