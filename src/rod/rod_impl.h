// What a rod is made of: its model as the kernels need it, and its state.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "cosserat_cable/math/small_eigen.h"
#include "cosserat_cable/rod/rod.h"
#include "shear_series.h"
#include "step_workspace.h"
#include "time_step.h"

namespace cosserat_cable::rod {

using V3 = Vec3<double>;
using NodeState = Node<double>;

/// What a single rod needs for a step; set up by the first one, not copied with the rod.
struct PairMemory {
  PairMemory() = default;
  PairMemory(const PairMemory&) {}
  PairMemory& operator=(const PairMemory&) { return *this; }
  std::unique_ptr<StepChain<LanePair>> chain;
};

struct Rod::Impl {
  explicit Impl(const RodModel& m);

  RodModel model;
  double h;  // element length [m]
  ShearSeries shear1, shear2;
  StepWorkspace<double> w;  // `node`, `rate` and `algorithm` are the state

  // The rest of the state, by element.
  using ShearHistory = std::array<ShearSeries::History, 2>;
  std::vector<ShearHistory> shear;
  // With what law and offsets the elements' stresses follow from the state.
  ElementLaw<double> law;
  std::vector<ElementOffset<double>> offsets;
  Vec6<double> missing_a, missing_b;  // what the end nodes lack to balance: the clamps supply it

  int first_free() const { return model.held_a ? 1 : 0; }
  int last_free() const { return model.held_b ? w.count - 2 : w.count - 1; }

  void PrepareStatics();
  /// The section law over a step of `dt` [s], without the elements' offsets.
  ElementLaw<double> LawOfStep(double dt);
  /// -C_M K0 [N m], which the moment of every element has besides C_M K.
  V3 MomentOfUnstressedCurvature() const;

  /// The end nodes of the next iterate, where they are held.
  void HoldEnds(const Motion& a, const Motion& b);

  /// Law, offsets and held ends of the step.
  void BeginStep(double dt, const Motion& a, const Motion& b);
  RodState State() { return {w.node.data(), w.rate.data(), w.algorithm.data()}; }
  template <class T>
  void FillMasses(int lane, const ChainLayout& layout, std::vector<NodeMass<T>>* masses) const;
  /// What a chain needs of the rod in a step besides its state, into a lane, or into both halves.
  template <class T>
  void FillChain(int lane, StepChain<T>* chain) const;
  /// The held ends into the chain's first iterate.
  template <class T>
  void HoldInChain(int lane, StepChain<T>* chain) const;
  /// Takes over what a chain found besides the state: internal variables and end forces.
  template <class T>
  void TakeStep(const StepChain<T>& chain, int lane);
  /// The equilibrium in `trial` becomes what stresses, end forces and internal variables are of.
  void TakeRest();

  /// Of an element in the present state. Found when first asked for.
  const ElementStress& Stress(int element);

  /// Of the iterate that was evaluated last.
  double StrainEnergy() const;
  double GravityEnergy(const std::vector<NodeState>& nodes) const;

  PairMemory pair;

 private:
  void EvaluateStress();

  ElementLaw<double> next_law_;  // of the step begun
  std::vector<ElementOffset<double>> next_offsets_;
  std::vector<ElementStress> stress_;
  bool stress_known_ = false;
};

}  // namespace cosserat_cable::rod
