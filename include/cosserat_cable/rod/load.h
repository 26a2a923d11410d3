// Forces on a rod from outside, evaluated inside the implicit step.
#pragma once

#include <utility>
#include <vector>

#include "cosserat_cable/math/pose.h"
#include "cosserat_cable/math/small.h"

namespace cosserat_cable::rod {

/// The rod as a load sees it: its current iterate, at the end of the step.
class Centreline {
 public:
  virtual ~Centreline() = default;
  /// Of the iterate: counted from Rod::SetTime, in statics that of the last state [s].
  virtual double time() const { return 0; }
  /// Clamp a's frame in the world at that time; where no clamp is known, the world's origin.
  virtual Motion clamp_a() const { return {}; }
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
  /// A force [N] on a node, with its derivatives as above. Costs less than one between two nodes.
  virtual void AddNodeForce(int node, const Vec3<double>& force, const Mat3<double>& by_position,
                            const Mat3<double>& by_velocity) = 0;
  /// A moment [N m] on the section of a node, in the section's own frame. Its derivatives are left
  /// out: Newton's iteration converges linearly then.
  virtual void AddMoment(int node, const Vec3<double>& moment) = 0;
  /// What of the forces' power on the rod is lost as heat [W], >= 0: counted as dissipation, not as
  /// negative work of the load.
  virtual void AddDissipation(double power) = 0;
};

/// A function of the rod's state and of time, without memory: rods may share one.
class Load {
 public:
  virtual ~Load() = default;
  virtual void Evaluate(const Centreline& rod, LoadSink* sink) const = 0;
  /// Potential [J] of the conservative part at the present positions.
  virtual double Energy(const Centreline& rod) const = 0;
  /// False where Energy is not all: the work depends on the way, as for moments in space.
  virtual bool HasPotential() const { return true; }
  /// False for what acts on moving rods only, as the air does: statics leaves it out.
  virtual bool ActsAtRest() const { return true; }
};

/// Several loads at once. They outlive the sum.
class LoadSum final : public Load {
 public:
  explicit LoadSum(std::vector<const Load*> of = {}) : loads(std::move(of)) {}

  void Evaluate(const Centreline& rod, LoadSink* sink) const override {
    for (const Load* load : loads) load->Evaluate(rod, sink);
  }
  double Energy(const Centreline& rod) const override {
    double energy = 0;
    for (const Load* load : loads) energy += load->Energy(rod);
    return energy;
  }
  bool HasPotential() const override {
    for (const Load* load : loads)
      if (!load->HasPotential()) return false;
    return true;
  }
  bool ActsAtRest() const override {
    for (const Load* load : loads)
      if (load->ActsAtRest()) return true;
    return false;
  }

  std::vector<const Load*> loads;
};

}  // namespace cosserat_cable::rod
