// What a rod is made of: its model as the kernels need it, and its state.
#pragma once

#include <array>
#include <vector>

#include "cosserat_cable/math/small_eigen.h"
#include "cosserat_cable/rod/rod.h"
#include "end_part.h"
#include "energy_book.h"
#include "lane_ends.h"
#include "section_branches.h"
#include "shear_series.h"
#include "step_workspace.h"

namespace cosserat_cable::rod {

using V3 = Vec3<double>;
using NodeState = Node<double>;

struct Rod::Impl {
  explicit Impl(const RodModel& m);

  RodModel model;
  double h;  // element length [m]
  ShearSeries shear1, shear2;
  SectionBranches branches;
  EndPart end_a, end_b;
  StepWorkspace<double> w;  // `node`, `rate` and `algorithm` are the state

  // The rest of the state, by element.
  using ShearHistory = std::array<ShearSeries::History, 2>;
  std::vector<ShearHistory> shear;
  std::vector<ElementStress> stress;
  Vec6<double> missing_a, missing_b;  // what the end nodes lack to balance: the clamps supply it
  EnergyBook energy;
  Eigen::Vector3d step_C_M = Eigen::Vector3d::Zero();  // of the step begun [N m^2]

  int first_free() const { return model.a.clamped() ? 1 : 0; }
  int last_free() const { return model.b.clamped() ? w.count - 2 : w.count - 1; }
  LaneEnds ends() const {
    return {end_a.active() ? &end_a : nullptr, end_b.active() ? &end_b : nullptr};
  }

  void PrepareStatics();
  /// The section law over a step of `dt` [s], without the elements' offsets.
  ElementLaw<double> LawOfStep(double dt);
  /// What internal variables and the unstressed curvature add to the stresses of an element in the
  /// step that LawOfStep began.
  SectionValue Offset(int element) const;
  /// The clamps where the step is to end; TakeBackEnds after a step that failed.
  void MoveEnds(const StepCoefficients& c, const Pose& a, const Pose& b);
  void TakeBackEnds();

  /// Takes over what lane `lane` of a workspace found: stresses, end forces and internal variables,
  /// at rest or at the end of the step that LawOfStep began.
  template <class T>
  void TakeStresses(const StepWorkspace<T>& from, int lane, bool at_rest);
  /// After a step of `dt` [s], its state being in place.
  void AccountForStep(double dt, double load_power);

  /// Of the iterate, elastic in statics.
  double StaticEnergy() const;
  double GravityEnergy(const std::vector<NodeState>& nodes) const;
  /// Of the state.
  double KineticEnergy() const;
  double ElasticEnergy() const;
  double StoredEnergy() const;  // all of it

 private:
  EndPart end_a_before_, end_b_before_;

  ElementStrain StrainOf(int element) const;
  double EndPower() const;
  double DissipationRate() const;
};

}  // namespace cosserat_cable::rod
