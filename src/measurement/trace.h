// A quantity known at even steps, and its value and derivatives in between.
#pragma once

#include <Eigen/Core>
#include <array>
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

  /// Coefficients of the polynomial from a step to the next one, by powers of the part of a step
  /// that has passed.
  std::array<double, 6> Polynomial(int quantity, int step) const;

  int steps() const { return static_cast<int>(rows_.cols()); }
  double start() const { return start_; }
  double dt() const { return dt_; }
  double value(int quantity, int step) const { return rows_(quantity, step); }

 private:
  /// The first of the steps that a polynomial goes through.
  int FirstOf(int step, int count) const;

  double start_, dt_;
  Eigen::MatrixXd rows_;  // a column per step: written step by step
};

}  // namespace cosserat_cable
