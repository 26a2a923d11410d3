#include "linearised_rod.h"

#include <algorithm>
#include <iterator>

#include "exact_tangent.h"
#include "lane_view.h"
#include "step_kernels.h"

namespace cosserat_cable::rod {
namespace {

void AddElement(int e, const Eigen::Matrix<double, 12, 12>& k, SymmetricBands* bands) {
  bands->diagonal[e] += k.topLeftCorner<6, 6>();
  bands->diagonal[e + 1] += k.bottomRightCorner<6, 6>();
  bands->lower[e] += k.bottomLeftCorner<6, 6>();
}

/// The elements' tangent without moduli and stresses: what is left are the loads'.
void ClearTangent(StepWorkspace<double>* w) {
  for (int i = 0; i < w->count; ++i) {
    for (auto& row : w->system.diagonal(i).m) std::fill(std::begin(row), std::end(row), 0.0);
    if (i + 1 == w->count) break;
    for (auto& row : w->system.lower(i).m) std::fill(std::begin(row), std::end(row), 0.0);
  }
}

}  // namespace

LinearisedRod::LinearisedRod(const std::array<DynamicModulus, kComponents>& moduli_of,
                             const std::vector<Quat<double>>& joints, const EndParts& ends,
                             const std::vector<Stiffening<double>>& stiffening,
                             const std::vector<SectionMatrix>& tangents,
                             const std::vector<bool>& held_of, const Load* load,
                             StepWorkspace<double>* w)
    : held(held_of),
      mass(6 * w->count),
      geometric(w->count),
      load_damping(w->count),
      moduli(moduli_of),
      move_a(Eigen::Matrix3d::Identity()),
      move_b(Eigen::Matrix3d::Identity()),
      turn_a(Eigen::Matrix3d::Identity()),
      turn_b(Eigen::Matrix3d::Identity()) {
  for (int i = 0; i < w->count; ++i)
    mass.segment<6>(6 * i) << w->mass[i], w->mass[i], w->mass[i], w->inertia[i].x, w->inertia[i].y,
        w->inertia[i].z;

  // Not AssembleTangent's, which serves Newton's iteration and has the second order in the
  // elements' angles only: in a natural frequency its error would be seen (1e-3 at 40 elements).
  EvaluateForces(w);
  if (load) AddLoad(*load, ends, false, 0.0, w);
  const Vec6<double> missing[] = {w->rhs.front(), w->rhs.back()};
  const double h = w->law.h;
  material.assign(kComponents, SymmetricBands(w->count));
  laws.assign(tangents.empty() ? 0 : kComponents, SymmetricBands(w->count));
  for (int e = 0; e + 1 < w->count; ++e) {
    const PlacedElement element = PlaceElement(*w, joints, e);
    // How the forces turn with the nodes, at constant stress.
    AddElement(e, GeometricStiffness(element, w->chain.Stress(e, 0)), &geometric);
    const Matrix6By12 strains = StrainDerivatives(element);
    const auto add = [&](int strain, double stiffness, int as_in) {
      AddElement(e, stiffness / h * strains.row(strain).transpose() * strains.row(strain),
                 &material[as_in]);
    };
    for (int i = 0; i < kComponents; ++i) add(i, moduli[i].C, i);
    for (std::size_t i = 0; i < laws.size(); ++i) {
      const Eigen::Matrix<double, 12, 12> half =
          0.5 / h * strains.row(i).transpose() * (tangents[e].row(i) * strains);
      AddElement(e, half + half.transpose(), &laws[i]);
    }
    // What a tension adds is bending's, whatever strain it is of.
    const Stiffening<double>& by = stiffening[e];
    if (by.x.C_M == 0 && by.y.C_M == 0) continue;
    const double bending1 = moduli[3].C / w->law.column.x.C_M;
    const double bending2 = moduli[4].C / w->law.column.y.C_M;
    add(0, bending2 * by.y.C_F, 4);
    add(1, bending1 * by.x.C_F, 3);
    add(3, bending1 * by.x.C_M, 3);
    add(4, bending2 * by.y.C_M, 4);
  }
  if (load) {
    const auto of_load = [&](double rate_factor) {
      ClearTangent(w);
      AddLoad(*load, ends, true, rate_factor, w);
      return SymmetricBands::Of(&w->system, w->count);
    };
    const SymmetricBands at_rest = of_load(0.0);
    load_damping = of_load(1.0).Add(-1, at_rest);
    geometric.Add(1, at_rest);
  }
  ends.ForEachActive([&](const EndPart& end, bool at_b) {
    const int i = at_b ? w->count - 1 : 0;
    const Node<double>& node = w->trial[i];
    const Vec6<double>& lacks = missing[at_b ? 1 : 0];
    geometric.diagonal[i].bottomRightCorner<3, 3>() +=
        end.StaticTangent(node, {lacks[3], lacks[4], lacks[5]});
    load_damping.diagonal[i].bottomRightCorner<3, 3>() +=
        end.SpringTangent(node, 1.0) - end.SpringTangent(node, 0.0);
    if (!end.holds()) return;
    // The mass stays: in these axes too, all but diagonal, and of half an element only.
    Eigen::Matrix3d &move = at_b ? move_b : move_a, &turn = at_b ? turn_b : turn_a;
    move = end.clamp().X.q.toRotationMatrix();
    if (end.holds_rotation()) turn = end.RotationByPsi(node);
    SymmetricBands::Block S = SymmetricBands::Block::Identity();
    S.topLeftCorner<3, 3>() = move;
    S.bottomRightCorner<3, 3>() = turn;
    geometric.Substitute(i, S);
    load_damping.Substitute(i, S);
    for (auto* all : {&material, &laws})
      for (SymmetricBands& stiffness : *all) stiffness.Substitute(i, S);
  });
  for (int k = 0; k < unknowns(); ++k) {
    if (!held[k]) continue;
    mass[k] = 0;
    geometric.Clear(k);
    load_damping.Clear(k);
    for (auto* all : {&material, &laws})
      for (SymmetricBands& stiffness : *all) stiffness.Clear(k);
  }
}

Eigen::Vector3d LinearisedRod::Displacement(const Eigen::VectorXd& x, int node) const {
  const Eigen::Vector3d first = x.segment<3>(6 * node);
  if (node == 0) return move_a * first;
  return 6 * (node + 1) == unknowns() ? Eigen::Vector3d(move_b * first) : first;
}

Eigen::Vector3d LinearisedRod::Rotation(const Eigen::VectorXd& x, int node) const {
  const Eigen::Vector3d last = x.segment<3>(6 * node + 3);
  if (node == 0) return turn_a * last;
  return 6 * (node + 1) == unknowns() ? Eigen::Vector3d(turn_b * last) : last;
}

SymmetricBands LinearisedRod::Stiffness() const {
  SymmetricBands sum = geometric;
  for (const auto* all : {&material, &laws})
    for (const SymmetricBands& stiffness : *all) sum.Add(1, stiffness);
  return sum;
}

}  // namespace cosserat_cable::rod
