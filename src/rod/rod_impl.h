// What a rod is made of: its model as the kernels need it, and its state.
#pragma once

#include <array>
#include <vector>

#include "cosserat_cable/math/small_eigen.h"
#include "cosserat_cable/rod/rod.h"
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
  StepWorkspace<double> w;  // `node`, `rate` and `algorithm` are the state

  // The rest of the state, by element.
  using ShearHistory = std::array<ShearSeries::History, 2>;
  std::vector<ShearHistory> shear;
  std::vector<ElementStress> stress;
  Vec6<double> missing_a, missing_b;  // what the end nodes lack to balance: the clamps supply it

  int first_free() const { return model.held_a ? 1 : 0; }
  int last_free() const { return model.held_b ? w.count - 2 : w.count - 1; }

  void PrepareStatics();
  /// The section law over a step of `dt` [s], without the elements' offsets.
  ElementLaw<double> LawOfStep(double dt);
  V3 Offset(int element) const;
  /// Of shear along a1 and a2, stretch, bending about a1 and a2, and twist.
  std::array<DynamicModulus, 6> Moduli() const;
  /// The end nodes of the next iterate, where they are held.
  void HoldEnds(const Motion& a, const Motion& b);

  /// Takes over what lane `lane` of a workspace found: stresses, end forces and internal variables,
  /// at rest or at the end of the step that LawOfStep began.
  template <class T>
  void TakeStresses(const StepWorkspace<T>& from, int lane, bool at_rest);
  void TakeIterate(bool at_rest) { TakeStresses(w, 0, at_rest); }

  double StrainEnergy() const;
  double GravityEnergy(const std::vector<NodeState>& nodes) const;
};

}  // namespace cosserat_cable::rod
