#include "cosserat_cable/math/rotation.h"

#include <cmath>

namespace cosserat_cable {
namespace {

// Below this angle [rad] closed forms lose digits by cancellation (the worst ones like eps/t^5),
// and the series below, cut after t^10, are good to 1e-14.
constexpr double kSeriesAngle = 0.3;
// Below this sin^2 of half the angle a series gives the logarithm in a fraction of atan2's time.
constexpr double kSmallSineSquared = 1e-3;
// Below this length the sum of two unit vectors is rounding.
constexpr double kOpposite = 1e-14;

/// a = (1 - cos t)/t^2 and b = (t - sin t)/t^3, with a' = (da/dt)/t and b' = (db/dt)/t, which stay
/// finite at t = 0.
struct JacobianCoefficients {
  double a, b, da, db;

  explicit JacobianCoefficients(double t) {
    const double t2 = t * t;
    if (t < kSeriesAngle) {
      a = 1. / 2 - t2 * (1. / 24 - t2 * (1. / 720 - t2 * (1. / 40320 - t2 / 3628800)));
      b = 1. / 6 - t2 * (1. / 120 - t2 * (1. / 5040 - t2 * (1. / 362880 - t2 / 39916800)));
      da = -1. / 12 + t2 * (1. / 180 - t2 * (1. / 6720 - t2 * (1. / 453600 - t2 / 47900160)));
      db = -1. / 60 + t2 * (1. / 1260 - t2 * (1. / 60480 - t2 * (1. / 4989600 - t2 / 622702080)));
    } else {
      const double s = std::sin(t), c = std::cos(t);
      a = (1 - c) / t2;
      b = (t - s) / (t2 * t);
      da = (s / t - 2 * a) / t2;
      db = (a - 3 * b) / t2;
    }
  }
};

/// (dJ_r/dt) phi'.
Eigen::Vector3d JacobianRateTimesRate(const JacobianCoefficients& k, const Eigen::Vector3d& phi,
                                      const Eigen::Vector3d& d_phi) {
  const double phi_dot_rate = phi.dot(d_phi);
  const Eigen::Vector3d turned = phi.cross(d_phi);
  return -k.da * phi_dot_rate * turned + k.db * phi_dot_rate * phi.cross(turned) +
         k.b * d_phi.cross(turned);
}

Eigen::Vector3d TimesRightJacobian(const JacobianCoefficients& k, const Eigen::Vector3d& phi,
                                   const Eigen::Vector3d& x) {
  const Eigen::Vector3d turned = phi.cross(x);
  return x - k.a * turned + k.b * phi.cross(turned);
}

/// (1 - (t/2) cot(t/2))/t^2, the factor of [phi]^2 in the inverse of J_r.
double InverseCoefficient(double t) {
  const double t2 = t * t;
  if (t < kSeriesAngle) {
    return 1. / 12 + t2 * (1. / 720 + t2 * (1. / 30240 + t2 * (1. / 1209600 + t2 / 47900160)));
  }
  return (1 - 0.5 * t / std::tan(0.5 * t)) / t2;
}

Eigen::Vector3d TimesRightJacobianInverse(double coefficient, const Eigen::Vector3d& phi,
                                          const Eigen::Vector3d& x) {
  const Eigen::Vector3d turned = phi.cross(x);
  return x + 0.5 * turned + coefficient * phi.cross(turned);
}

}  // namespace

Eigen::Quaterniond RotationExp(const Eigen::Vector3d& phi) {
  const double half = 0.5 * phi.norm();
  // sin(x)/x; the series' first dropped term is x^6/5040.
  const double sinc =
      half < 1e-3 ? 1 - half * half / 6 * (1 - half * half / 20) : std::sin(half) / half;
  const Eigen::Vector3d vector = 0.5 * sinc * phi;
  return {std::cos(half), vector.x(), vector.y(), vector.z()};
}

Eigen::Vector3d RotationLog(const Eigen::Quaterniond& q) {
  const double sign = q.w() < 0 ? -1 : 1;
  const double x = q.vec().squaredNorm();
  if (x < kSmallSineSquared) {
    // 2 asin(s)/s in x = s^2; the first dropped term is below 1e-17.
    return q.vec() *
           (sign * (2 + x * (1. / 3 +
                             x * (3. / 20 + x * (5. / 56 + x * (35. / 576 + x * (63. / 1408)))))));
  }
  const double sine = std::sqrt(x);
  return q.vec() * (sign * 2 * std::atan2(sine, sign * q.w()) / sine);
}

Eigen::Quaterniond ShortestTurn(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d a = from.normalized(), sum = a + to.normalized();
  Eigen::Quaterniond q;
  if (sum.norm() < kOpposite) {
    q.w() = 0;
    q.vec() = a.unitOrthogonal();
  } else {
    // A vector and the half of the way: half the angle is between them.
    const Eigen::Vector3d half = sum.normalized();
    q.w() = a.dot(half);
    q.vec() = a.cross(half);
  }
  return q.normalized();
}

Eigen::Matrix3d RightJacobian(const Eigen::Vector3d& phi) {
  const JacobianCoefficients k(phi.norm());
  Eigen::Matrix3d jacobian;
  for (int i = 0; i < 3; ++i) {
    jacobian.col(i) = TimesRightJacobian(k, phi, Eigen::Vector3d::Unit(i));
  }
  return jacobian;
}

Eigen::Matrix3d RightJacobianInverse(const Eigen::Vector3d& phi) {
  const double coefficient = InverseCoefficient(phi.norm());
  Eigen::Matrix3d inverse;
  for (int i = 0; i < 3; ++i) {
    inverse.col(i) = TimesRightJacobianInverse(coefficient, phi, Eigen::Vector3d::Unit(i));
  }
  return inverse;
}

BodyRates ToBodyRates(const Eigen::Vector3d& phi, const ChartRates& chart) {
  const JacobianCoefficients k(phi.norm());
  return {TimesRightJacobian(k, phi, chart.d_phi),
          TimesRightJacobian(k, phi, chart.dd_phi) + JacobianRateTimesRate(k, phi, chart.d_phi)};
}

ChartRates ToChartRates(const Eigen::Vector3d& phi, const BodyRates& body) {
  const double t = phi.norm();
  const double coefficient = InverseCoefficient(t);
  ChartRates chart;
  chart.d_phi = TimesRightJacobianInverse(coefficient, phi, body.omega);
  chart.dd_phi = TimesRightJacobianInverse(
      coefficient, phi,
      body.alpha - JacobianRateTimesRate(JacobianCoefficients(t), phi, chart.d_phi));
  return chart;
}

}  // namespace cosserat_cable
