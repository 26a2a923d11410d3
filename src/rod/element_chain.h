// The elements of a rod, four at a time in the lanes of a vector.
#pragma once

#include <vector>

#include "block_tridiagonal.h"
#include "element.h"

namespace cosserat_cable::rod {

class ElementChain {
 public:
  explicit ElementChain(int elements);

  /// What the section law adds to the force of an element in this step [N].
  void SetOffset(int element, const Vec3<double>& offset_F);
  void ClearOffsets();

  /// Strains, rates and stresses between the `elements + 1` nodes; subtracts what they exert from
  /// `rhs`.
  void Evaluate(const Node<double>* nodes, const ElementLaw<double>& law, Vec6<double>* rhs);

  /// Sets `system` to the tangent at what Evaluate saw, for the moduli C + V d(rate)/d(strain).
  void AssembleTangent(double h, const Vec3<double>& C_F, const Vec3<double>& C_M,
                       BlockTridiagonal<double>* system) const;

  Vec3<double> gamma(int e) const { return OfElement(group(e).gamma, e); }
  Vec3<double> gamma_dot(int e) const { return OfElement(group(e).gamma_dot, e); }
  Vec3<double> kappa(int e) const { return OfElement(group(e).kappa, e); }
  Vec3<double> force(int e) const { return OfElement(group(e).n, e); }
  Vec3<double> moment(int e) const { return OfElement(group(e).m, e); }

 private:
  const ElementState<Lanes>& group(int e) const { return states_[e / Lanes::kCount]; }
  static Vec3<double> OfElement(const Vec3<Lanes>& v, int e) {
    const int lane = e % Lanes::kCount;
    return {v.x[lane], v.y[lane], v.z[lane]};
  }

  int elements_;
  std::vector<ElementState<Lanes>> states_;
  std::vector<Vec3<Lanes>> offsets_;
};

}  // namespace cosserat_cable::rod
