#include "radau.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <stdexcept>

namespace cosserat_cable::generator {
namespace {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr int kMaxIterations = 10;
constexpr double kNewtonTolerance = 1e-2;  // of the error tolerance, so that it adds nothing to it
constexpr double kStaleRate = 0.05;        // contraction beyond which factors are renewed
constexpr int kPatience = 15;              // steps without growth after Newton's method failed
constexpr double kAbruptRate = 0.3;  // contraction beyond which a kink is taken for the reason
constexpr int kRenewals = 3;
constexpr double kSafety = 0.9;
constexpr double kLeastFactor = 0.2;
constexpr double kMostFactor = 6.0;
constexpr double kKeepAbove =
    1.0;  // step changes within these bounds are not worth a factorisation
constexpr double kKeepBelow = 1.25;

/// The method's coefficients and the transform that decouples its stages.
struct Tableau {
  Eigen::Matrix3d A, A2;
  Eigen::Vector3d c;
  Eigen::Vector3d error;  ///< of the embedded formula of order three, over h gamma
  double gamma = 0.0;     ///< real eigenvalue of A
  std::complex<double> lambda;
  Eigen::Vector3d real_left, real_right;         ///< eigenvectors for gamma
  Eigen::Vector3cd complex_left, complex_right;  ///< for lambda; its conjugate goes with it

  Tableau() {
    const double r = std::sqrt(6.0);
    A << (88 - 7 * r) / 360, (296 - 169 * r) / 1800, (-2 + 3 * r) / 225,  //
        (296 + 169 * r) / 1800, (88 + 7 * r) / 360, (-2 - 3 * r) / 225,   //
        (16 - r) / 36, (16 + r) / 36, 1.0 / 9;
    A2 = A * A;
    c = A.rowwise().sum();
    // The eigenvalues of A^-1 in closed form (ibid., IV.8).
    const double root = std::cbrt(3.0);
    gamma = 1.0 / (3.0 + root * root - root);
    lambda = 1.0 / std::complex<double>(3.0 + 0.5 * (root - root * root),
                                        0.5 * std::sqrt(3.0) * (root + root * root));
    vectors(gamma, &real_left, &real_right);
    vectors(lambda, &complex_left, &complex_right);
    error = gamma / 3.0 * Eigen::Vector3d(-13.0 - 7.0 * r, -13.0 + 7.0 * r, -1.0);
  }

  /// Left and right eigenvector: what is normal to two rows or columns of A - value.
  template <typename Scalar>
  void vectors(Scalar value, Eigen::Matrix<Scalar, 3, 1>* left,
               Eigen::Matrix<Scalar, 3, 1>* right) const {
    Eigen::Matrix<Scalar, 3, 3> B = A.template cast<Scalar>();
    B.diagonal().array() -= value;
    const auto normal = [](const Eigen::Matrix<Scalar, 3, 1>& a,
                           const Eigen::Matrix<Scalar, 3, 1>& b) {
      // Eigen's cross product of complex vectors is conjugated.
      return Eigen::Matrix<Scalar, 3, 1>(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                         a[0] * b[1] - a[1] * b[0]);
    };
    *right = normal(B.row(0).transpose(), B.row(1).transpose());
    *left = normal(B.col(0), B.col(1));
    *left /= (left->transpose() * *right).value();
  }
};

/// Newton's matrices for one step size.
class Factors {
 public:
  void linearise(SecondOrderSystem& system, const MotionState& at) {
    system.linearise(at.t, at.q, at.v, at.a, &M_, &D_, &K_);
  }
  void factorise(const Tableau& tableau, double h) {
    h_gamma_ = h * tableau.gamma;
    const std::complex<double> z = h * tableau.lambda;
    real_.compute(M_ + h_gamma_ * D_ + h_gamma_ * h_gamma_ * K_);
    const MatrixXcd sum = M_.cast<std::complex<double>>() + z * D_ + (z * z) * K_;
    complex_.compute(sum);
  }
  /// Change of the stages' accelerations that cancels their residuals.
  MatrixXd solve(const Tableau& tableau, const MatrixXd& residuals) const {
    const VectorXd real = real_.solve(residuals * tableau.real_left);
    const VectorXcd complex =
        complex_.solve(residuals.cast<std::complex<double>>() * tableau.complex_left);
    return -(real * tableau.real_right.transpose() +
             2.0 * (complex * tableau.complex_right.transpose()).real());
  }
  /// (I - h gamma J)^-1 applied to a first-order defect (q, v); its position part.
  VectorXd filter(const VectorXd& q, const VectorXd& v) const {
    return q + h_gamma_ * real_.solve(M_ * v - h_gamma_ * (K_ * q));
  }

 private:
  MatrixXd M_, D_, K_;
  Eigen::PartialPivLU<MatrixXd> real_;
  Eigen::PartialPivLU<MatrixXcd> complex_;
  double h_gamma_ = 0.0;
};

double norm(const VectorXd& x, const VectorXd& scale) {
  return x.cwiseProduct(scale).norm() / std::sqrt(static_cast<double>(x.size()));
}

/// The quadratic through the last step's three stages, at c_i of the next; extrapolating far
/// beyond the stages is worse than holding the last.
MatrixXd predictStages(const Tableau& tableau, const MatrixXd& last, double ratio) {
  MatrixXd next(last.rows(), 3);
  for (int i = 0; i < 3; ++i) {
    const double x = ratio > 1.6 ? 1.0 : 1.0 + ratio * tableau.c[i];
    Eigen::Vector3d w;
    for (int j = 0; j < 3; ++j) {
      const int k = (j + 1) % 3, l = (j + 2) % 3;
      w[j] = (x - tableau.c[k]) * (x - tableau.c[l]) /
             ((tableau.c[j] - tableau.c[k]) * (tableau.c[j] - tableau.c[l]));
    }
    next.col(i) = last * w;
  }
  return next;
}

}  // namespace

VectorXd accelerations(SecondOrderSystem& system, double t, const VectorXd& q, const VectorXd& v) {
  MatrixXd M, D, K;
  const VectorXd zero = VectorXd::Zero(system.size());
  system.linearise(t, q, v, zero, &M, &D, &K);
  return -M.partialPivLu().solve(system.residual(t, q, v, zero));
}

RadauCounts integrateRadau(
    SecondOrderSystem& system, const VectorXd& q0, const VectorXd& v0, double t0, double t1,
    const RadauOptions& options,
    const std::function<void(const MotionState&, const MotionState&)>& observe) {
  static const Tableau tableau;
  const VectorXd scale = system.scale();
  const int n = system.size();
  const double longest = options.longest_step > 0.0 ? options.longest_step : t1 - t0;

  MotionState now{t0, q0, v0, accelerations(system, t0, q0, v0)};
  MatrixXd stages = now.a.replicate(1, 3);
  MatrixXd positions(n, 3), velocities(n, 3), residuals(n, 3);
  Factors factors;
  RadauCounts counts;
  double h = std::min(options.first_step, longest);
  double last_h = h, factorised_h = 0.0, last_error = 1.0;
  bool stale = true;
  int hold_back = 0;

  while (now.t < t1 * (1.0 - 1e-14)) {
    const bool last = now.t + h * (1.0 + 1e-9) >= t1;
    if (last) h = t1 - now.t;
    if (h < 1e-15 * std::max(1.0, std::abs(t1)))
      throw std::runtime_error("the step size of the integrator vanished");
    if (stale) {
      system.expectStep(h);
      factors.linearise(system, now);
      stale = false;
      factorised_h = 0.0;
    }
    if (factorised_h != h) {
      factors.factorise(tableau, h);
      factorised_h = h;
      ++counts.factorisations;
    }

    MatrixXd a = predictStages(tableau, stages, h / last_h);
    bool converged = false;
    double previous = 0.0, rate = 0.0;
    int iteration = 0, renewed = 0;
    while (iteration < kMaxIterations) {
      velocities = (h * a * tableau.A.transpose()).colwise() + now.v;
      positions = h * h * a * tableau.A2.transpose();
      for (int i = 0; i < 3; ++i) {
        positions.col(i) += now.q + h * tableau.c[i] * now.v;
        residuals.col(i) = system.residual(now.t + tableau.c[i] * h, positions.col(i),
                                           velocities.col(i), a.col(i));
      }
      const MatrixXd change = factors.solve(tableau, residuals);
      a += change;
      ++iteration;
      ++counts.newton_iterations;
      double size = 0.0;
      for (int i = 0; i < 3; ++i) size = std::max(size, h * h * norm(change.col(i), scale));
      if (!std::isfinite(size)) break;
      if (iteration > 1) rate = std::max(rate, size / previous);
      previous = size;
      const double left = iteration > 1 && rate < 1.0 ? rate / (1.0 - rate) * size : size;
      if (left < kNewtonTolerance * options.tolerance) {
        converged = true;
        break;
      }
      if (system.abrupt() && renewed < kRenewals && iteration > 1 && rate > kAbruptRate) {
        // A kink: the matrices of where the step ends, and the same iterate.
        velocities = (h * a * tableau.A.transpose()).colwise() + now.v;
        positions = h * h * a * tableau.A2.transpose();
        factors.linearise(
            system, {now.t + h, now.q + h * now.v + positions.col(2), velocities.col(2), a.col(2)});
        factors.factorise(tableau, h);
        stale = true;
        ++renewed;
        iteration = 0;
        rate = 0.0;
        continue;
      }
      if (iteration > 1 && rate >= 1.0) break;
    }
    if (!converged) {
      ++counts.rejected;
      h *= 0.5;
      hold_back = kPatience;
      stale = true;
      continue;
    }

    velocities = (h * a * tableau.A.transpose()).colwise() + now.v;
    positions = h * h * a * tableau.A2.transpose();
    for (int i = 0; i < 3; ++i) positions.col(i) += h * tableau.c[i] * now.v;
    const VectorXd defect_q = h * tableau.gamma * now.v + positions * tableau.error;
    const VectorXd defect_v =
        h * tableau.gamma * now.a + (velocities.colwise() - now.v) * tableau.error;
    const double error =
        std::max(1e-12, norm(factors.filter(defect_q, defect_v), scale) / options.tolerance);
    double factor = std::pow(error, -0.25);
    if (error < 1.0 && counts.steps > 0) {
      // Gustafsson's predictive controller: the trend of the error counts too.
      factor = std::min(factor, h / last_h * std::pow(last_error / (error * error), 0.25));
    }
    factor = std::clamp(kSafety * factor, kLeastFactor, kMostFactor);
    if (error >= 1.0) {
      ++counts.rejected;
      h *= factor;
      stale = true;
      continue;
    }
    MotionState end{now.t + h, now.q + positions.col(2), velocities.col(2), a.col(2)};
    if (last) end.t = t1;
    ++counts.steps;
    observe(now, end);
    now = std::move(end);
    stages = a;
    last_h = h;
    last_error = std::max(1e-2, error);
    if (hold_back > 0) {
      --hold_back;
      factor = std::min(factor, 1.0);
    }
    if (factor < kKeepAbove || factor > kKeepBelow || rate > kStaleRate) {
      h = std::min(longest, h * factor);
      stale = true;
    }
  }
  return counts;
}

}  // namespace cosserat_cable::generator
