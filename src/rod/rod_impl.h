// What statics and dynamics of a rod share: its state, and the sweep over its elements.
#pragma once

#include <array>
#include <vector>

#include "block_tridiagonal.h"
#include "cosserat_cable/math/small_eigen.h"
#include "cosserat_cable/rod/rod.h"
#include "element_chain.h"
#include "shear_series.h"
#include "step_kernels.h"

namespace cosserat_cable::rod {

using Scalar = double;
using V3 = Vec3<Scalar>;
using NodeState = Node<Scalar>;

struct Rod::Impl : public Centreline {
  explicit Impl(const RodModel& m);

  // ---- constants
  RodModel model;
  int count;                 // of nodes
  double h;                  // element length [m]
  std::vector<double> mass;  // lumped at the nodes [kg]
  std::vector<V3> inertia;   // about the section's axes [kg m^2]
  V3 gravity;
  ElementLaw<Scalar> law;  // of the step or of statics, whichever was prepared last
  ShearSeries shear1, shear2;

  // ---- state at the last accepted instant
  std::vector<NodeState> node;
  std::vector<NodeRates> rate;       // true accelerations
  std::vector<NodeRates> algorithm;  // generalised-alpha's own
  using ShearHistory = std::array<ShearSeries::History, 2>;
  std::vector<ShearHistory> shear;

  // ---- the iterate, and the stresses that belong to it
  std::vector<NodeState> trial;
  ElementChain chain;
  BlockTridiagonal<Scalar> system;
  std::vector<Vec6<Scalar>> rhs;        // minus the residual, then the correction
  std::vector<Vec6<Scalar>> increment;  // of the step: displacement, rotation vector
  std::vector<NodeRates> trial_rate, trial_algorithm;

  int first_free() const { return model.held_a ? 1 : 0; }
  int last_free() const { return model.held_b ? count - 2 : count - 1; }

  // Centreline, of the iterate.
  int elements() const override { return model.elements; }
  V3 position(int i) const override { return trial[i].r; }
  V3 velocity(int i) const override { return trial[i].v; }

  void PrepareStatics();
  void PrepareStep(double dt);

  /// Strains and stresses of the iterate; internal forces and gravity into `rhs`.
  void EvaluateForces();
  /// Adds what a load exerts to `rhs` and, where wanted, its derivative to `system`.
  /// `rate_factor`: d(velocity)/d(position) of the step [1/s].
  void AddLoad(const Load& load, bool tangent, double rate_factor);
  /// Sets `system` to the elements' tangent with moduli C + rate_factor V.
  void AssembleTangent(double rate_factor);
  /// Largest correction in `rhs`, relative to the length and in rad.
  double CorrectionNorm() const;

  double StrainEnergy() const;
  double GravityEnergy(const std::vector<NodeState>& nodes) const;
};

}  // namespace cosserat_cable::rod
