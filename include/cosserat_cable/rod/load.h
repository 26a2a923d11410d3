// Forces on a rod from outside, evaluated inside the implicit step.
#pragma once

#include "cosserat_cable/math/small.h"

namespace cosserat_cable::rod {

/// The rod as a load sees it: its current iterate.
class Centreline {
 public:
  virtual ~Centreline() = default;
  virtual int elements() const = 0;
  virtual Vec3<double> position(int node) const = 0;  ///< [m]
  virtual Vec3<double> velocity(int node) const = 0;  ///< [m/s]
};

/// Takes what a load contributes.
class LoadSink {
 public:
  virtual ~LoadSink() = default;
  /// A force [N] at the fraction `xi` of `element`, with its derivatives by the point's position
  /// [N/m] and velocity [N s/m]; both symmetric, and not positive for a force that resists.
  virtual void AddForce(int element, double xi, const Vec3<double>& force,
                        const Mat3<double>& by_position, const Mat3<double>& by_velocity) = 0;
};

class Load {
 public:
  virtual ~Load() = default;
  virtual void Evaluate(const Centreline& rod, LoadSink* sink) const = 0;
  /// Potential [J] of the conservative part at the present positions.
  virtual double Energy(const Centreline& rod) const = 0;
};

}  // namespace cosserat_cable::rod
