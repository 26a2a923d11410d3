// All elements of a rod: of one, four elements at a time; or of four rods, the same element of
// each.
#pragma once

#include <vector>

#include "block_tridiagonal.h"
#include "element_joint.h"

namespace cosserat_cable::rod {

/// What is known of an element after Evaluate.
struct ElementStress {
  Vec3<double> gamma, gamma_dot;  ///< [1], [1/s]
  Vec3<double> kappa, kappa_dot;  ///< [1/m], [1/(m s)]
  Vec3<double> n, m;              ///< what works on the strains [N], [N m]
};

/// T = double: one rod; T = Lanes: a rod in each lane.
template <class T>
class ElementChain {
 public:
  explicit ElementChain(int elements);

  /// What the section law adds to the force [N] and moment [N m] of an element of the rod in `lane`
  /// in this step or in statics: internal variables, and -C_M K0 of the unstressed curvature.
  void SetOffset(int element, int lane, const Vec3<double>& offset_F, const Vec3<double>& offset_M);

  /// What a tension adds to the law of an element of the rod in `lane`; nothing until this is
  /// called.
  void SetStiffening(int element, int lane, const Stiffening<double>& by);

  /// How the frames that the elements see are turned from their nodes', one per element; none
  /// without joints.
  void SetJoints(std::vector<ElementJoint<double>> joints) { joints_ = std::move(joints); }

  /// Strains, rates and stresses between the `elements + 1` nodes; subtracts what they exert from
  /// `rhs`.
  void Evaluate(const Node<T>* nodes, const ElementLaw<T>& law, Vec6<T>* rhs);

  /// Sets `system` to the tangent at what Evaluate saw, for the moduli C + `rate_factor` V.
  void AssembleTangent(double rate_factor, BlockTridiagonal<T>* system) const;

  /// Of the rod in `lane`.
  ElementStress Stress(int element, int lane) const;
  Bowing<double> BowingOf(int element, int lane) const;

 private:
  int elements_;
  // Of one rod, element e is lane e % 4 of entry e / 4; of four, lane l of entry e belongs to rod
  // l.
  std::vector<ElementState<Lanes>> states_;
  std::vector<Stiffening<Lanes>> stiffening_;
  std::vector<ScaledLaw<Lanes>> laws_;  // as Evaluate found them
  std::vector<ElementOffset<Lanes>> offsets_;
  std::vector<ElementJoint<double>> joints_;
  std::vector<Node<double>> seen_;  // first nodes of the elements, where there are joints
};

}  // namespace cosserat_cable::rod
