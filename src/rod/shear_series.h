// Shear of a two-node element: the section's shear and the element's residual bending in series.
//
// Linear interpolation lets an element bend only as a whole; the S-shaped rest of its bending,
// under a shear force Q, adds Q h^2/(12 EI) to the shear angle (MacNeal 1978). Both are
// Kelvin-Voigt elements carrying the same force,
//
//     Q = GA g1 + eta_GA dg1/dt = B g2 + eta_B dg2/dt,   Gamma = g1 + g2,
//     B = 12 EI/h^2, eta_B = 12 eta_EI/h^2,
//
// with g1 as internal variable: d(g1)/dt = lambda (G - g1), G = (B Gamma + eta_B dGamma/dt)/(GA +
// B), lambda = (GA + B)/(eta_GA + eta_B). It is integrated exactly for a G that is linear over the
// step, which is second order, and stable however stiff (lambda is infinite without damping).
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "dynamic_modulus.h"

namespace cosserat_cable::rod {

/// State of an element in one direction; in lanes, of one of each rod.
template <class T>
struct ShearHistoryOf {
  T g1{};  ///< shear of the section proper [1]
  T G{};   ///< what it tends to [1]
};

/// Of an element, along a1 and a2.
using ShearHistory = std::array<ShearHistoryOf<double>, 2>;

/// The law over one step, for any number of rods side by side.
template <class T>
struct ShearStep {
  T decay, weight_old, weight_new;  // of g1, and of what it tends to at the step's start and end
  T carried;                        // force by what is carried over of g1 [N]
  T target_C, target_V;             // G by Gamma [1], by dGamma/dt [s]
  T lambda;                         // [1/s]; 0 without damping, where it is not asked for
  T eta_GA, eta_B;                  // [N s]

  T Carry(const ShearHistoryOf<T>& past) const { return decay * past.g1 + weight_old * past.G; }
  T Offset(const ShearHistoryOf<T>& past) const { return carried * Carry(past); }
  /// The state at the end of the step.
  ShearHistoryOf<T> Commit(const ShearHistoryOf<T>& past, const T& gamma,
                           const T& gamma_dot) const {
    const T G = target_C * gamma + target_V * gamma_dot;
    return {Carry(past) + weight_new * G, G};
  }
  /// Dissipated per length [W/m].
  T DissipationRate(const ShearHistoryOf<T>& now, const T& gamma_dot) const {
    const T g1_dot = lambda * (now.G - now.g1), g2_dot = gamma_dot - g1_dot;
    return eta_GA * g1_dot * g1_dot + eta_B * g2_dot * g2_dot;
  }
};

class ShearSeries {
 public:
  ShearSeries(double GA, double eta_GA, double B, double eta_B)
      : GA_(GA),
        sum_(GA + B),
        eta_GA_(eta_GA),
        eta_B_(eta_B),
        target_C_(B / sum_),
        target_V_(eta_B / sum_) {
    const double eta = eta_GA + eta_B;
    lambda_ = eta > 0 ? sum_ / eta : std::numeric_limits<double>::infinity();
    viscous_ = eta > 0 ? eta_GA / eta * sum_ : 0.0;
  }

  using History = ShearHistoryOf<double>;

  /// Stored per length [J/m] under the whole shear `gamma`.
  double Energy(const History& now, double gamma) const {
    const double g2 = gamma - now.g1;
    return 0.5 * (GA_ * now.g1 * now.g1 + (sum_ - GA_) * g2 * g2);
  }
  /// Q at this state [N].
  double Force(const History& now) const { return GA_ * now.g1 + viscous_ * (now.G - now.g1); }
  double static_stiffness() const { return GA_ * target_C_; }  ///< [N]
  /// The part of a shear at rest that is the element's residual bending.
  double bending_part() const { return GA_ / sum_; }

  /// Q by Gamma for motion as exp(lambda t), (GA + lambda eta_GA)(B + lambda eta_B)/(GA + B +
  /// lambda (eta_GA + eta_B)), in partial fractions.
  DynamicModulus modulus() const {
    DynamicModulus k;
    k.C = static_stiffness();
    if (std::isinf(lambda_)) return k;
    k.V = viscous_ * target_V_;
    k.branches = {
        {GA_ * target_V_ * lambda_ + viscous_ * target_C_ - k.V * lambda_ - k.C, lambda_}};
    return k;
  }

  /// The law over one step of `dt` [s]: Q = offset + C Gamma + V dGamma/dt.
  void BeginStep(double dt) {
    if (dt == dt_) return;
    dt_ = dt;
    const double x = lambda_ * dt;
    decay_ = std::exp(-x);
    if (x < kSeriesBelow) {
      weight_new_ = x * (1.0 / 2 - x * (1.0 / 6 - x * (1.0 / 24 - x / 120)));
      weight_old_ = x * (1.0 / 2 - x * (1.0 / 3 - x * (1.0 / 8 - x / 30)));
    } else {
      const double mean_decay = -std::expm1(-x) / x;
      weight_new_ = 1.0 - mean_decay;
      weight_old_ = mean_decay - decay_;
    }
    stiffness_ = (GA_ - viscous_) * weight_new_ + viscous_;
  }
  double C() const { return stiffness_ * target_C_; }
  double V() const { return stiffness_ * target_V_; }
  ShearStep<double> step() const {
    const bool damped = eta_GA_ + eta_B_ > 0;
    return {decay_,
            weight_old_,
            weight_new_,
            GA_ - viscous_,
            target_C_,
            target_V_,
            damped ? lambda_ : 0.0,
            eta_GA_,
            eta_B_};
  }

  /// The state at rest under a constant shear angle.
  History Rest(double gamma) const { return {target_C_ * gamma, target_C_ * gamma}; }

 private:
  static constexpr double kSeriesBelow = 0.01;  // below, four terms are exact to 1e-11

  double GA_, sum_, eta_GA_, eta_B_, target_C_, target_V_, lambda_, viscous_;
  double dt_ = 0;  // of the step begun
  double decay_ = 0, weight_old_ = 0, weight_new_ = 1, stiffness_ = 0;
};

}  // namespace cosserat_cable::rod
