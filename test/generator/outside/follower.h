#pragma once

#include <Eigen/Core>
#include <cmath>

#include "../rod_shape.h"

namespace cosserat_cable::generator {

/// Masses that hang on points of the rod by springs and dashpots: y'' = -w^2 (y - r) - 2 D w (y' -
/// r') + g. Within a step the points move along the cubic through place and velocity at both ends;
/// the masses follow by RK4 in fractions of their period.
class Follower {
 public:
  Follower(double w, double ratio, const Eigen::Vector3d& g) : w_(w), ratio_(ratio), g_(g) {}

  struct State {
    Points y, u;  ///< place [m], velocity [m/s]
  };
  bool empty() const { return now_.y.cols() == 0; }

  /// Acceleration [m/s^2] that springs and dashpots give the masses.
  Points pull(const State& mass, const Points& r, const Points& v) const {
    return -w_ * w_ * (mass.y - r) - 2.0 * ratio_ * w_ * (mass.u - v);
  }

  /// The masses at time t, when their points are at r with velocity v.
  State at(double t, const Points& r, const Points& v) const {
    if (empty() || t <= t_) return empty() ? rest(r, v) : now_;
    const double span = t - t_;
    const int steps = 2 + static_cast<int>(4.0 * w_ * span);
    const double h = span / steps;
    State mass = now_;
    for (int i = 0; i < steps; ++i) {
      const State a = rate(mass, i * h, span, r, v);
      const State b = rate(moved(mass, 0.5 * h, a), (i + 0.5) * h, span, r, v);
      const State c = rate(moved(mass, 0.5 * h, b), (i + 0.5) * h, span, r, v);
      const State d = rate(moved(mass, h, c), (i + 1) * h, span, r, v);
      mass.y += h / 6.0 * (a.y + 2.0 * b.y + 2.0 * c.y + d.y);
      mass.u += h / 6.0 * (a.u + 2.0 * b.u + 2.0 * c.u + d.u);
    }
    return mass;
  }

  void commit(double t, const Points& r, const Points& v, bool settled) {
    now_ = settled ? rest(r, v) : at(t, r, v);
    t_ = t;
    r_ = r;
    v_ = v;
  }

 private:
  State rest(const Points& r, const Points& v) const { return {r.colwise() + g_ / (w_ * w_), v}; }
  State rate(const State& mass, double t, double span, const Points& r, const Points& v) const {
    const double x = t / span, x2 = x * x;
    const double rise = x2 * (3.0 - 2.0 * x), left = span * x * (1.0 - x) * (1.0 - x);
    const double right = -span * x2 * (1.0 - x);
    const Points place = r_ + rise * (r - r_) + left * v_ + right * v;
    const Points speed = 6.0 * x * (1.0 - x) / span * (r - r_) + (1.0 - x) * (1.0 - 3.0 * x) * v_ -
                         x * (2.0 - 3.0 * x) * v;
    return {mass.u, pull(mass, place, speed).colwise() + g_};
  }
  static State moved(const State& mass, double h, const State& rate) {
    return {mass.y + h * rate.y, mass.u + h * rate.u};
  }

  double w_, ratio_;
  Eigen::Vector3d g_;
  double t_ = 0.0;  // of the last commit
  State now_;       // there
  Points r_, v_;    // there
};

}  // namespace cosserat_cable::generator
