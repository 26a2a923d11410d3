// Forces on a rod from outside, evaluated inside the implicit step.
#pragma once

#include "cosserat_cable/math/small.h"

namespace cosserat_cable::rod {

/// The rod as a load sees it: its current iterate.
class Centreline {
 public:
  virtual ~Centreline() = default;
  virtual int elements() const = 0;
  virtual Vec3<double> position(int node) const = 0;     ///< [m]
  virtual Vec3<double> velocity(int node) const = 0;     ///< [m/s]
  virtual Quat<double> orientation(int node) const = 0;  ///< section frame to world
};

/// Takes what a load contributes.
class LoadSink {
 public:
  virtual ~LoadSink() = default;
  /// A force [N] at the fraction `xi` of `element`, with its derivatives by the point's position
  /// [N/m] and velocity [N s/m]; both symmetric, and not positive for a force that resists.
  virtual void AddForce(int element, double xi, const Vec3<double>& force,
                        const Mat3<double>& by_position, const Mat3<double>& by_velocity) = 0;
  /// A moment [N m] on the section of a node, in the section's own frame. Its derivatives are left
  /// out: Newton's iteration converges linearly then.
  virtual void AddMoment(int node, const Vec3<double>& moment) = 0;
};

class Load {
 public:
  virtual ~Load() = default;
  virtual void Evaluate(const Centreline& rod, LoadSink* sink) const = 0;
  /// Potential [J] of the conservative part at the present positions.
  virtual double Energy(const Centreline& rod) const = 0;
  /// False where Energy is not all: the work depends on the way, as for moments in space.
  virtual bool HasPotential() const { return true; }
};

}  // namespace cosserat_cable::rod
