#include "cosserat_cable/math/pose.h"

namespace cosserat_cable {

Motion Motion::operator*(const Motion& BC) const {
  const Eigen::Vector3d& p_BC = BC.X.p;
  const Eigen::Quaterniond q_CB = BC.X.q.conjugate();
  Motion AC;
  AC.X = X * BC.X;
  AC.v = v + X.q * (BC.v + omega.cross(p_BC));
  AC.a = a + X.q * (BC.a + 2.0 * omega.cross(BC.v) + alpha.cross(p_BC) +
                    omega.cross(omega.cross(p_BC)));
  const Eigen::Vector3d omega_in_C = q_CB * omega;
  AC.omega = omega_in_C + BC.omega;
  // d/dt (R_CB omega) = R_CB alpha - omega_BC x (R_CB omega): C turns against B.
  AC.alpha = q_CB * alpha - BC.omega.cross(omega_in_C) + BC.alpha;
  return AC;
}

Motion Motion::operator*(const Pose& X_BC) const {
  const Eigen::Quaterniond q_CB = X_BC.q.conjugate();
  Motion AC;
  AC.X = X * X_BC;
  AC.v = v + X.q * omega.cross(X_BC.p);
  AC.a = a + X.q * (alpha.cross(X_BC.p) + omega.cross(omega.cross(X_BC.p)));
  AC.omega = q_CB * omega;
  AC.alpha = q_CB * alpha;
  return AC;
}

}  // namespace cosserat_cable
