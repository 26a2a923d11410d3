#include "cosserat_cable/math/motion_between.h"

#include "cosserat_cable/math/quintic.h"
#include "cosserat_cable/math/rotation.h"

namespace cosserat_cable {

Motion MotionBetween(const Motion& left, const Motion& right, double h, double time) {
  const Jet position =
      EvaluateQuintic({left.X.p, left.v, left.a}, {right.X.p, right.v, right.a}, h, time);
  const Eigen::Vector3d turn = RotationLog(left.X.q.conjugate() * right.X.q);
  const ChartRates end = ToChartRates(turn, {right.omega, right.alpha});
  const Jet phi = EvaluateQuintic({Eigen::Vector3d::Zero(), left.omega, left.alpha},
                                  {turn, end.d_phi, end.dd_phi}, h, time);
  const BodyRates body = ToBodyRates(phi.value, {phi.first, phi.second});
  Motion motion;
  motion.X = {position.value, (left.X.q * RotationExp(phi.value)).normalized()};
  motion.v = position.first;
  motion.a = position.second;
  motion.omega = body.omega;
  motion.alpha = body.alpha;
  return motion;
}

}  // namespace cosserat_cable
