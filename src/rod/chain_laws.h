// What the section laws of one rod do to a chain.
#pragma once

#include <algorithm>

#include "lane_access.h"
#include "law_element.h"
#include "section_branches.h"
#include "step_coefficients.h"

namespace cosserat_cable::rod {

/// The laws of one rod's section, and what else makes the offsets that theirs are added to.
struct LawsOfRod {
  const SectionLaws* laws = nullptr;  ///< null: none
  const SectionBranches* branches = nullptr;
  Eigen::Vector3d gamma0, kappa0;
};

/// Forgets the tangents of laws.
template <class T>
void ClearLaws(StepChain<T>* chain) {
  const T zero(0.0);
  for (Triangle6<T>& s : chain->law_diagonal)
    for (T& x : s.v) x = zero;
  for (Block6<T>& s : chain->law_lower)
    for (auto& row : s.m)
      for (T& x : row) x = zero;
}

/// Sets the elements' offsets to the stress at the iterate's strains and, where wanted, adds the
/// consistent tangent.
template <class T>
void AddLaws(const StepCoefficients& c, const LawsOfRod& rod, int rod_lane, bool tangent,
             StepChain<T>* chain) {
  StepChain<T>& w = *chain;
  const ChainLayout& layout = w.layout;
  const SectionLaws& laws = *rod.laws;
  const bool answers_to_gamma = laws.answers_to_gamma();
  const int from = answers_to_gamma ? 0 : 3;  // of the blocks' rows and columns
  for (int lane = 0; lane < kLaneCount<T>; ++lane) {
    if (!layout.halves && lane != rod_lane) continue;
    const auto add = [lane](double value, T* to) { SetLane(to, lane, GetLane(*to, lane) + value); };
    const double per_length = GetLane(w.shear_law.per_length, lane);
    const double forwards = GetLane(w.shear_law.forwards, lane);
    const Bowing<double> slack = GetLane(w.law.bowing, lane);
    Node<double> a = GetLane(w.nodes[0].at, lane);
    for (int k = 0; k < layout.chain_elements; ++k) {
      const Node<double> first = a;
      a = GetLane(w.nodes[k + 1].at, lane);
      const int e = layout.ElementAt(k, lane);
      if (e < 0) continue;
      ElementJoint<double> joint;
      if (!w.joints.empty())
        joint = {GetLane(w.joints[k].first, lane), GetLane(w.joints[k].second, lane)};
      const LawElement element(w.joints.empty() ? nullptr : &joint, first, a,
                               w.taut ? GetLane(w.taut_laws[k].bowing, lane) : slack);
      const SectionResponse response = laws.Evaluate(
          e, element.Strain(per_length, rod.gamma0, rod.kappa0), c.velocity_by_increment);
      SectionVector stress = response.stress;
      if (!rod.branches->empty()) {
        const SectionValue more = rod.branches->Offset(e);
        stress.head<3>() += more.F;
        stress.tail<3>() += more.M;
      }
      stress *= forwards;
      SetLane(&w.branch_offsets[k].F, lane, Vec3<double>{stress[0], stress[1], stress[2]});
      SetLane(&w.branch_offsets[k].M, lane, Vec3<double>{stress[3], stress[4], stress[5]});
      if (!tangent) continue;
      LawTangent by_nodes;
      element.Tangent(response.tangent, 1 / std::abs(per_length), answers_to_gamma, &by_nodes);
      for (int i = from; i < 6; ++i) {
        for (int j = from; j <= i; ++j) {
          add(by_nodes.first(i, j), &w.law_diagonal[k].at(i, j));
          add(by_nodes.second(i, j), &w.law_diagonal[k + 1].at(i, j));
        }
        for (int j = from; j < 6; ++j) add(by_nodes.coupling(i, j), &w.law_lower[k][i][j]);
      }
    }
  }
}

}  // namespace cosserat_cable::rod
