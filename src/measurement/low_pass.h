// A first-order low pass of a quantity that is known at even steps.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "trace.h"

namespace cosserat_cable {

/// y' = w (x - y), w = 1/time constant, solved exactly for the polynomials that the trace is
/// between its steps. The sensor behind it has seen the quantity stand, or go on as it begins.
class LowPass {
 public:
  enum class Before {
    kStands,      ///< y = x at the trace's start
    kGoesSteady,  ///< at constant speed: y = x - x'/w
    kSwings       ///< as a sine of the trace's mean and root-mean-square frequency
  };
  /// The trace outlives this.
  LowPass(const Trace& trace, int quantity, double time_constant, Before before);

  /// The derivative of order 0, 1 or 2 at time `t` >= the trace's start [s]: y, w (x - y), w (x' -
  /// y').
  double Evaluate(double t, int order) const;
  /// y at the trace's steps.
  const std::vector<double>& steps() const { return y_; }

 private:
  double Start(Before before) const;
  /// y a part `u` of a step behind step `k`.
  double Behind(int k, double u) const;

  const Trace& trace_;
  int quantity_;
  double w_;
  std::vector<double> y_;
};

}  // namespace cosserat_cable
