// A quantity known at even steps, and its value and derivatives in between.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace cosserat_cable {

/// The angle [rad] that differs from this one by whole turns and lies within half a turn of `near`.
double Unwrapped(double angle, double near);

/// Rows are time steps, columns quantities. In between runs the polynomial of degree 5 through the
/// six nearest steps, one-sided at the ends: after a release, nothing is known of before.
class Trace {
 public:
  Trace(double start, double dt, int steps, int quantities)
      : start_(start), dt_(dt), rows_(quantities, steps) {}

  /// All quantities at a step.
  Eigen::Ref<Eigen::VectorXd> at(int step) { return rows_.col(step); }

  /// Takes out the whole turns between neighbouring steps of an angle [rad].
  void Unwrap(int quantity);

  /// The derivative of order 0, 1 or 2 at time `t` [s].
  double Evaluate(int quantity, double t, int order) const;

 private:
  double start_, dt_;
  Eigen::MatrixXd rows_;  // a column per step: written step by step
};

}  // namespace cosserat_cable
