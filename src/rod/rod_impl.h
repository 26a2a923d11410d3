// What a rod is made of: its model as the kernels need it, and its state.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "cosserat_cable/math/small_eigen.h"
#include "cosserat_cable/rod/rod.h"
#include "end_part.h"
#include "energy_book.h"
#include "section_branches.h"
#include "shear_lanes.h"
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
  ShearLanes<LanePair> shear;
};

struct Rod::Impl {
  explicit Impl(const RodModel& m);

  RodModel model;
  double h;  // element length [m]
  ShearSeries shear1, shear2;
  SectionBranches branches;
  std::vector<Quat<double>> joints;  // by node; none of a rod without joints
  EndParts ends;
  StepWorkspace<double> w;  // `node`, `rate` and `algorithm` are the state

  // The rest of the state, by element.
  std::vector<ShearHistory> shear;
  // With what law and offsets the elements' stresses follow from the state.
  ElementLaw<double> law;
  std::vector<ElementOffset<double>> offsets;
  Vec6<double> missing_a, missing_b;  // what the end nodes lack to balance: the clamps supply it
  EnergyBook energy;

  // The nodes that are unknown.
  int first_free() const { return model.a.clamped() ? 1 : 0; }
  int last_free() const { return model.b.clamped() ? w.count - 2 : w.count - 1; }

  void PrepareStatics();
  /// Minimises the energy of the rod with the law in `w` by moving its iterate, until a correction
  /// is below `tolerance`.
  SolveReport Minimise(double tolerance, int max_iterations, const Load* load);
  /// At rest, with the static law; its iterate becomes the state once it is in equilibrium.
  void BeginStatics();
  void FinishStatics(const Load* load, SolveReport* report);
  /// Brings the iterate near its equilibrium by way of rods that stretch more easily.
  void Soften(const Load* load, SolveReport* report);
  /// The section law over a step of `dt` [s], without the elements' offsets.
  ElementLaw<double> LawOfStep(double dt);
  /// Of shear along a1 and a2, stretch, bending about a1 and a2, and twist.
  std::array<DynamicModulus, 6> Moduli() const;

  /// Law, offsets and clamps of the step.
  void BeginStep(const StepCoefficients& c, const Pose& a, const Pose& b);
  /// The clamps are where they were: the step begun has failed.
  void TakeBackStep() { ends = ends_before_; }
  RodState State() { return {w.node.data(), w.rate.data(), w.algorithm.data()}; }
  template <class T>
  void FillMasses(int lane, const ChainLayout& layout, std::vector<NodeMass<T>>* masses) const;
  /// What a chain needs of the rod in a step besides its state, into a lane, or into both halves.
  template <class T>
  void FillChain(int lane, StepChain<T>* chain, ShearLanes<T>* shear_lanes);
  /// What the branches add to the offsets of the chain.
  template <class T>
  void AddBranches(int lane, StepChain<T>* chain);
  /// The clamped ends into the chain's first iterate.
  template <class T>
  void HoldInChain(int lane, StepChain<T>* chain) const;
  /// Takes over what a chain found besides the state: internal variables and end forces.
  template <class T>
  void TakeStep(const StepChain<T>& chain, const ShearLanes<T>& shear_lanes, int lane);
  /// After a step of `dt` [s] whose state is in place.
  void AccountForStep(double dt, double load_power);
  /// The equilibrium in `trial` becomes what stresses, end forces and internal variables are of.
  void TakeRest();

  /// Of an element in the present state. Found when first asked for.
  const ElementStress& Stress(int element);

  /// Of the iterate that was evaluated last, at rest.
  double StaticEnergy() const;
  double GravityEnergy(const std::vector<NodeState>& nodes) const;
  /// Of the state.
  double KineticEnergy() const;
  double ElasticEnergy();
  double StoredEnergy();  // all of it

  PairMemory pair;

 private:
  void EvaluateStress();
  template <class T>
  void FillJoints(int lane, StepChain<T>* chain) const;
  ElementStrain StrainOf(const ElementStress& stress) const;
  /// Gives the branches of a lane's elements their strains at the step's end; returns the sum of
  /// what they dissipate, per length [W/m].
  template <class T>
  double CommitBranches(const StepChain<T>& chain, int lane, double per_length);
  double EndPower() const;

  ElementLaw<double> next_law_;  // of the step begun
  EndParts ends_before_;         // its start
  double dissipation_rate_ = 0;  // of the sections [W]
  std::vector<ElementOffset<double>> next_offsets_;
  std::vector<ElementStress> stress_;
  bool stress_known_ = false;
};

}  // namespace cosserat_cable::rod
