#pragma once

#include <Eigen/Core>
#include <functional>

namespace cosserat_cable::generator {

/// A mechanical system: residual(t, q, v, a) = 0 with v = dq/dt, a = dv/dt, linear in a.
class SecondOrderSystem {
 public:
  virtual ~SecondOrderSystem() = default;
  virtual int size() const = 0;
  virtual Eigen::VectorXd residual(double t, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                   const Eigen::VectorXd& a) = 0;
  /// Derivatives of the residual by a, v and q; only M must be exact, the others serve Newton's
  /// iteration and the error estimate.
  virtual void linearise(double t, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                         const Eigen::VectorXd& a, Eigen::MatrixXd* M, Eigen::MatrixXd* D,
                         Eigen::MatrixXd* K) = 0;
  /// Whether the residual has kinks, so that Newton's matrices are worth renewing within a step.
  virtual bool abrupt() const { return false; }
  /// Told before linearise(): the step that will be tried, for laws that depend on it.
  virtual void expectStep(double /*h*/) {}
  /// What one unit of each coordinate counts in error norms.
  virtual Eigen::VectorXd scale() const = 0;
};

/// State at one instant.
struct MotionState {
  double t = 0.0;  ///< [s]
  Eigen::VectorXd q, v, a;
};

struct RadauOptions {
  double tolerance = 1e-7;    ///< of the local error estimate, in units of SecondOrderSystem::scale
  double first_step = 1e-7;   ///< [s]
  double longest_step = 0.0;  ///< [s]; 0: no bound
};

struct RadauCounts {
  int steps = 0;
  int rejected = 0;
  int newton_iterations = 0;
  int factorisations = 0;
};

/// Accelerations that the residual asks for at (t, q, v).
Eigen::VectorXd accelerations(SecondOrderSystem& system, double t, const Eigen::VectorXd& q,
                              const Eigen::VectorXd& v);

/// Radau IIA of order five (Hairer and Wanner, Solving ODEs II, IV.8), applied to the second-order
/// form with the stages' accelerations as unknowns. Calls `observe(begin, end)` after every step.
/// Throws std::runtime_error where the step size vanishes.
RadauCounts integrateRadau(
    SecondOrderSystem& system, const Eigen::VectorXd& q0, const Eigen::VectorXd& v0, double t0,
    double t1, const RadauOptions& options,
    const std::function<void(const MotionState&, const MotionState&)>& observe);

}  // namespace cosserat_cable::generator
