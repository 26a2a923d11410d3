// What a rod is made of: its model as the kernels need it, and its state.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "chain_stepper.h"
#include "cosserat_cable/math/small_eigen.h"
#include "cosserat_cable/rod/rod.h"
#include "end_part.h"
#include "energy_book.h"
#include "load_power.h"
#include "rod_home.h"
#include "section_branches.h"
#include "section_laws.h"
#include "step_workspace.h"

namespace cosserat_cable::rod {

using V3 = Vec3<double>;
using NodeState = Node<double>;

/// What a single rod needs for a step; set up by the first one, not copied with the rod.
struct PairMemory {
  PairMemory() = default;
  PairMemory(const PairMemory&) {}
  PairMemory& operator=(const PairMemory&) { return *this; }
  std::unique_ptr<ChainStepper<LanePair>> stepper;
};

struct Rod::Impl {
  explicit Impl(const RodModel& m);
  Impl(const Impl&) = default;
  ~Impl();

  RodModel model;
  double h;  // element length [m]
  ShearSeries shear1, shear2;
  SectionBranches branches;
  SectionLaws laws;
  std::vector<Quat<double>> joints;  // by node; none of a rod without joints
  EndParts ends;

  // The state: that of the workspace's nodes, and by element. As it was when it was last fetched
  // from where it is; what the end nodes are is always known.
  StepWorkspace<double> w;
  std::vector<ShearHistory> shear;
  std::vector<double> tension;                 // what the next law is evaluated at [N]
  std::vector<Stiffening<double>> stiffening;  // of the law that stresses are of
  RodAddress address;

  Vec6<double> missing_a, missing_b;  // what the end nodes lack to balance: the clamps supply it
  EnergyBook energy;

  /// To be called before the state is read, and before it is changed.
  void Fetch();
  void MoveOut();
  /// Of all that is not made of the model anew for each step.
  void ExchangeState(StateArchive* state);

  // The nodes that are unknown.
  int first_free() const { return model.a.clamped() ? 1 : 0; }
  int last_free() const { return model.b.clamped() ? w.count - 2 : w.count - 1; }

  /// See Rod::SetSection.
  void SetSection(const Section& section);
  /// The model's loads and the one given, if any; likewise those that act at rest. Valid until the
  /// next call.
  const Load* Acting(const Load* given);
  const Load* ActingAtRest(const Load* given);
  /// The laws of the ends have no past: they take the state that the next step starts from.
  void ForgetHistory() { has_history_ = false; }
  void BeginHistory();

  void PrepareStatics();
  /// The law at `tension`, for statics.
  void StiffenElements();
  /// Forces of the iterate, and their tangent, with the law in `w` and those of the section.
  void EvaluateStatics();
  void AssembleStatics(bool exact);
  /// Sets the elements' offsets to what the section's laws make of the iterate's strains.
  void PlaceLawStress();
  /// Of an element of that iterate.
  LawElement StaticElement(int element) const;
  ElementStrain StaticStrain(const LawElement& element) const;
  /// Takes over the tensions of the iterate; returns the largest change of what they make of the
  /// law, relative to the bending stiffness.
  double UpdateTensions();
  /// Minimises the energy of the rod with the law in `w` by moving its iterate, until a correction
  /// is below `tolerance`; after `quick_iterations` with the exact tangent.
  SolveReport Minimise(double tolerance, int max_iterations, int quick_iterations,
                       const Load* load);
  /// Static equilibrium; `from_afar`: by way of rods that stretch more easily.
  SolveReport FindRest(EndPart::Memory memory, bool from_afar, const Load* given);
  /// At rest, with the static law; its iterate becomes the state once it is in equilibrium.
  void BeginStatics(EndPart::Memory memory);
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
  void TakeBackStep() {
    ends.a.PutBack(a_before_);
    ends.b.PutBack(b_before_);
  }
  template <class T>
  void FillMasses(int lane, const ChainLayout& layout, std::vector<NodeMass<T>>* masses) const;
  /// The law of the step, into a lane of a chain or into both halves, unless this rod's for steps
  /// as long [s] is there and does not change from step to step.
  template <class T>
  void FillLaw(int lane, StepChain<T>* chain, double* dt_there) const;
  /// Whether the section has more than its Kelvin-Voigt elements.
  bool has_branch_stress() const { return !branch_stress_.empty(); }
  LawsOfRod LawsOfStep() const;
  /// What the branches add to the offsets of the chain: of a rod without any, nothing.
  template <class T>
  void FillBranches(int lane, StepChain<T>* chain) const;
  /// The clamped ends into the chain's first iterate.
  template <class T>
  void HoldInChain(int lane, StepChain<T>* chain) const;
  /// Takes over what a chain found in a step of `dt` [s]: end forces, losses, and the internal
  /// variables of branches and ends. The state stays there.
  template <class T>
  void TakeStep(const StepChain<T>& chain, int lane, double dt);
  /// Adds the step of `dt` [s] that was taken to the energy balance. `loads`: at its end.
  void AccountForStep(double dt, const LoadPower& loads);
  /// The state that a chain has, and stresses from its strains.
  template <class T>
  void TakeState(const StepChain<T>& chain, int lane);
  /// The equilibrium in `trial` becomes what stresses, end forces and internal variables are of.
  void TakeRest();

  /// Of an element in the state last fetched.
  const ElementStress& Stress(int element) const { return stress_[element]; }

  /// Of the iterate that was evaluated last, at rest.
  double StaticEnergy() const;
  /// Of what tensions add to the law, in the element at these strains, per length [J/m].
  double StiffeningEnergy(int element, const V3& gamma, const V3& kappa) const;
  double GravityEnergy(const std::vector<NodeState>& nodes) const;
  /// Of the state.
  double KineticEnergy() const;
  double ElasticEnergy() const;
  double StoredEnergy() const;  // all of it

  PairMemory pair;

 private:
  Bowing<double> SlackBowing() const;
  BeamColumn<double> Column() const;
  template <class T>
  void FillJoints(int lane, StepChain<T>* chain) const;
  ElementStrain StrainOf(const ElementStress& stress) const;
  /// Gives the branches and laws of a lane's elements their strains at the step's end; returns the
  /// sum of what the branches dissipate, per length [W/m].
  template <class T>
  double CommitBranches(const StepChain<T>& chain, int lane);
  template <class T>
  ElementStress StressIn(const StepChain<T>& chain, int entry, int lane, int element) const;
  double EndPower() const;

  double dt_of_law_ = 0;                  // of the last step begun [s]
  ElementLaw<double> law_of_step_;        // of that step
  PrescribedMotion a_before_, b_before_;  // clamps at its start
  double dissipation_rate_ = 0;           // of the sections [W], their laws left out:
  double lost_in_step_ = 0;               // what those have dissipated in the last step [J]
  double lost_in_ends_ = 0;               // likewise, the laws of the ends
  bool has_history_ = false;
  EndPart::Memory memory_ = EndPart::Memory::kRested;  // of all laws in statics
  LoadSum acting_, acting_at_rest_;
  std::vector<ElementStress> stress_;        // by element
  std::vector<SectionValue> branch_stress_;  // the branches' and laws' part of it
};

}  // namespace cosserat_cable::rod
