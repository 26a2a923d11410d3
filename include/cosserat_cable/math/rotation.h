// The rotation group through its logarithm: phi [rad] stands for the rotation by |phi| about phi.
//
// For R(t) = R_0 exp(phi(t)) the angular velocity in the body's axes is omega = J_r(phi) phi' with
//   J_r(phi) = I - (1 - cos t)/t^2 [phi] + (t - sin t)/t^3 [phi]^2,   t = |phi|
// (Chirikjian, Stochastic Models, Information Theory, and Lie Groups 2, eq. 10.86).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace cosserat_cable {

/// The rotation by |phi| [rad] about phi; phi may be zero or longer than a turn.
Eigen::Quaterniond RotationExp(const Eigen::Vector3d& phi);

/// The shortest phi [rad], |phi| <= pi, with RotationExp(phi) = q or -q. @pre q has unit length
Eigen::Vector3d RotationLog(const Eigen::Quaterniond& q);

/// The smallest rotation that turns `from` to point along `to`, of any lengths but zero; by half a
/// turn about some axis across them where they are opposite.
Eigen::Quaterniond ShortestTurn(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// J_r(phi) with omega = J_r(phi) phi'.
Eigen::Matrix3d RightJacobian(const Eigen::Vector3d& phi);

/// The inverse of J_r(phi). @pre |phi| < 2 pi
Eigen::Matrix3d RightJacobianInverse(const Eigen::Vector3d& phi);

/// Angular velocity [rad/s] and acceleration [rad/s^2] of a body, in its own axes.
struct BodyRates {
  Eigen::Vector3d omega = Eigen::Vector3d::Zero();
  Eigen::Vector3d alpha = Eigen::Vector3d::Zero();
};

/// First and second time derivative of phi [rad/s], [rad/s^2].
struct ChartRates {
  Eigen::Vector3d d_phi = Eigen::Vector3d::Zero();
  Eigen::Vector3d dd_phi = Eigen::Vector3d::Zero();
};

/// How the body R_0 exp(phi(t)) turns, from the motion of phi.
BodyRates ToBodyRates(const Eigen::Vector3d& phi, const ChartRates& chart);

/// The inverse of ToBodyRates. @pre |phi| < 2 pi
ChartRates ToChartRates(const Eigen::Vector3d& phi, const BodyRates& body);

}  // namespace cosserat_cable
