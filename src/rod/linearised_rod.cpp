#include "linearised_rod.h"

#include "element.h"
#include "lane_view.h"
#include "step_kernels.h"

namespace cosserat_cable::rod {
namespace {

using V3 = Vec3<double>;

// Steps of the derivatives of GeometricStiffness [rad] and [of the element length]: the
// fourth-order difference is then exact to 1e-12.
constexpr double kStep = 1e-3;

/// What the element between `a` and `b` exerts under the force and moment of `stress`, wherever its
/// nodes are.
Eigen::Matrix<double, 12, 1> ElementResidual(const Node<double>& a, const Node<double>& b, double h,
                                             const ElementStress& stress) {
  ElementState<double> state;
  EvaluateStrain(a, b, h, &state);
  state.n = stress.n;
  state.m = stress.m;
  const ElementForces<double> forces = EvaluateForces(state);
  Eigen::Matrix<double, 12, 1> residual;
  residual << -forces.f.x, -forces.f.y, -forces.f.z, forces.g1.x, forces.g1.y, forces.g1.z,
      forces.f.x, forces.f.y, forces.f.z, forces.g2.x, forces.g2.y, forces.g2.z;
  return residual;
}

/// The stiffness of the stresses last evaluated: how the forces turn with the nodes.
///
/// A Newton iteration is served by AssembleTangent's, which has the second order in the elements'
/// angles only; in a natural frequency its error would be seen (1e-3 at 40 elements). Differences
/// of forces at constant stress, which do not suffer from the stiffness of stretch.
SymmetricBands GeometricStiffness(const StepWorkspace<double>& w) {
  SymmetricBands stiffness(w.count);
  for (int e = 0; e + 1 < w.count; ++e) {
    const ElementStress stress = w.chain.Stress(e, 0);
    Eigen::Matrix<double, 12, 12> k;
    for (int column = 0; column < 12; ++column) {
      const bool turns = column % 6 >= 3;
      const double step = turns ? kStep : kStep * w.law.h;
      const auto residual = [&](double by) {
        Node<double> nodes[2] = {w.trial[e], w.trial[e + 1]};
        Node<double>& node = nodes[column / 6];
        V3 d;
        (column % 3 == 0 ? d.x : column % 3 == 1 ? d.y : d.z) = by;
        if (turns)
          node.q = node.q * Exp(d);
        else
          node.r += d;
        return ElementResidual(nodes[0], nodes[1], w.law.h, stress);
      };
      k.col(column) =
          (8 * (residual(step) - residual(-step)) - (residual(2 * step) - residual(-2 * step))) /
          (12 * step);
    }
    // The skew part adds up to the moments that a node lacks to balance: zero.
    k = (0.5 * (k + k.transpose())).eval();
    stiffness.diagonal[e] += k.topLeftCorner<6, 6>();
    stiffness.diagonal[e + 1] += k.bottomRightCorner<6, 6>();
    stiffness.lower[e] += k.bottomLeftCorner<6, 6>();
  }
  return stiffness;
}

/// The elements' tangent for these moduli and the stresses last evaluated.
void Assemble(const std::array<double, LinearisedRod::kComponents>& C, StepWorkspace<double>* w) {
  w->law.C_F = {C[0], C[1], C[2]};
  w->law.C_M = {C[3], C[4], C[5]};
  AssembleTangent(0.0, w);
}

}  // namespace

LinearisedRod::LinearisedRod(const std::array<DynamicModulus, kComponents>& moduli_of,
                             const std::vector<bool>& held_of, const Load* load,
                             StepWorkspace<double>* w)
    : held(held_of),
      mass(6 * w->count),
      geometric(w->count),
      load_damping(w->count),
      moduli(moduli_of) {
  for (int i = 0; i < w->count; ++i)
    mass.segment<6>(6 * i) << w->mass[i], w->mass[i], w->mass[i], w->inertia[i].x, w->inertia[i].y,
        w->inertia[i].z;

  EvaluateForces(w);
  geometric = GeometricStiffness(*w);
  // The tangent is linear in the moduli: one at a time, less what the stresses do.
  Assemble({}, w);
  const SymmetricBands no_moduli = SymmetricBands::Of(&w->system, w->count);
  for (int i = 0; i < kComponents; ++i) {
    std::array<double, kComponents> C{};
    C[i] = moduli[i].C;
    Assemble(C, w);
    material.push_back(SymmetricBands::Of(&w->system, w->count).Add(-1, no_moduli));
  }
  if (load) {
    const auto with_load = [&](double rate_factor) {
      Assemble({}, w);
      AddLoad(*load, 0, true, rate_factor, w);
      return SymmetricBands::Of(&w->system, w->count);
    };
    const SymmetricBands at_rest = with_load(0.0);
    load_damping = with_load(1.0).Add(-1, at_rest);
    geometric.Add(1, at_rest).Add(-1, no_moduli);
  }
  for (int k = 0; k < unknowns(); ++k) {
    if (!held[k]) continue;
    mass[k] = 0;
    geometric.Clear(k);
    load_damping.Clear(k);
    for (SymmetricBands& stiffness : material) stiffness.Clear(k);
  }
}

SymmetricBands LinearisedRod::Stiffness() const {
  SymmetricBands sum = geometric;
  for (const SymmetricBands& stiffness : material) sum.Add(1, stiffness);
  return sum;
}

}  // namespace cosserat_cable::rod
