#include "exact_tangent.h"

namespace cosserat_cable::rod {
namespace {

using V3 = Vec3<double>;

// Steps of the derivatives [rad] and [of the element length]: the fourth-order difference is then
// exact to 1e-12.
constexpr double kStep = 1e-3;

/// Of `f(first node, second node)`, a vector, with the nodes as the element sees them.
template <int kRows, class Function>
Eigen::Matrix<double, kRows, 12> Derivatives(const PlacedElement& element, const Function& f) {
  Eigen::Matrix<double, kRows, 12> derivatives;
  for (int column = 0; column < 12; ++column) {
    const bool turns = column % 6 >= 3;
    const double step = turns ? kStep : kStep * element.h;
    const auto at = [&](double by) -> Eigen::Matrix<double, kRows, 1> {
      Node<double> nodes[2] = {element.a, element.b};
      Node<double>& node = nodes[column / 6];
      V3 d{0, 0, 0};
      (column % 3 == 0 ? d.x : column % 3 == 1 ? d.y : d.z) = by;
      if (turns)
        node.q = node.q * Exp(d);
      else
        node.r += d;
      return f(SeenThrough(element.joint.first, nodes[0]),
               SeenThrough(element.joint.second, nodes[1]));
    };
    derivatives.col(column) =
        (8 * (at(step) - at(-step)) - (at(2 * step) - at(-2 * step))) / (12 * step);
  }
  return derivatives;
}

void AddTo(const Eigen::Matrix<double, 6, 6>& k, Block6<double>* block) {
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(&block->m[0][0]) += k;
}

}  // namespace

PlacedElement PlaceElement(const StepWorkspace<double>& w, const std::vector<Quat<double>>& joints,
                           int e) {
  const Quat<double> straight{1, 0, 0, 0};
  return {w.trial[e],
          w.trial[e + 1],
          {joints.empty() ? straight : joints[e], straight},
          w.chain.BowingOf(e, 0),
          w.law.h};
}

Matrix6By12 StrainDerivatives(const PlacedElement& element) {
  return Derivatives<6>(element, [&](const Node<double>& a, const Node<double>& b) {
    ElementState<double> state;
    EvaluateStrain<double>(a, b, element.bowing, &state);
    Eigen::Matrix<double, 6, 1> strains;
    strains << state.u.x, state.u.y, state.u.z, state.theta.x, state.theta.y, state.theta.z;
    return strains;
  });
}

Matrix12 GeometricStiffness(const PlacedElement& element, const ElementStress& stress) {
  const Matrix12 turning =
      Derivatives<12>(element, [&](const Node<double>& a, const Node<double>& b) {
        ElementState<double> state;
        EvaluateStrain<double>(a, b, element.bowing, &state);
        state.n = stress.n;
        state.m = stress.m;
        BowStress(element.bowing, &state);
        ElementForces<double> forces = EvaluateForces(state, element.bowing);
        TurnBack(element.joint, &forces);
        Eigen::Matrix<double, 12, 1> residual;
        residual << -forces.f.x, -forces.f.y, -forces.f.z, forces.g1.x, forces.g1.y, forces.g1.z,
            forces.f.x, forces.f.y, forces.f.z, forces.g2.x, forces.g2.y, forces.g2.z;
        return residual;
      });
  return 0.5 * (turning + turning.transpose());
}

void AssembleExactTangent(const std::vector<Quat<double>>& joints,
                          const std::vector<Stiffening<double>>& stiffening,
                          StepWorkspace<double>* w) {
  for (int i = 0; i < w->count; ++i) {
    w->system.diagonal(i) = {};
    w->system.lower(i) = {};
  }
  for (int e = 0; e + 1 < w->count; ++e) {
    const PlacedElement element = PlaceElement(*w, joints, e);
    const Matrix6By12 strains = StrainDerivatives(element);
    const Stiffening<double>& by = stiffening[e];
    Eigen::Matrix<double, 6, 1> moduli;
    moduli << w->law.C_F.x + by.y.C_F, w->law.C_F.y + by.x.C_F, w->law.C_F.z,
        w->law.C_M.x + by.x.C_M, w->law.C_M.y + by.y.C_M, w->law.C_M.z;
    const Matrix12 k = GeometricStiffness(element, w->chain.Stress(e, 0)) +
                       strains.transpose() * (moduli / element.h).asDiagonal() * strains;
    AddTo(k.topLeftCorner<6, 6>(), &w->system.diagonal(e));
    AddTo(k.bottomRightCorner<6, 6>(), &w->system.diagonal(e + 1));
    AddTo(k.bottomLeftCorner<6, 6>(), &w->system.lower(e));
  }
}

}  // namespace cosserat_cable::rod
