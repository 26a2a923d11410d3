// Section laws that are not linear over a step, in statics.
#include <limits>

#include "exact_tangent.h"
#include "rod_impl.h"
#include "step_kernels.h"

namespace cosserat_cable::rod {

LawElement Rod::Impl::StaticElement(int e) const {
  const Quat<double> straight{1, 0, 0, 0};
  const ElementJoint<double> joint = {joints.empty() ? straight : joints[e], straight};
  return LawElement(joints.empty() ? nullptr : &joint, w.trial[e], w.trial[e + 1],
                    Bowed(w.law.bowing, stiffening[e], 1.0));
}

ElementStrain Rod::Impl::StaticStrain(const LawElement& element) const {
  return element.Strain(1 / h, model.section.gamma0, model.section.kappa0);
}

void Rod::Impl::PlaceLawStress() {
  const V3 unbend = -Scale(w.law.C_M, ToSmall(model.section.kappa0));
  laws.BeginStep(std::numeric_limits<double>::infinity());
  for (int e = 0; e < model.elements; ++e) {
    const SectionValue stress = Split(laws.Evaluate(e, StaticStrain(StaticElement(e)), 0).stress);
    w.chain.SetOffset(e, 0, ToSmall(stress.F), unbend + ToSmall(stress.M));
  }
}

void Rod::Impl::EvaluateStatics() {
  if (!laws.empty()) PlaceLawStress();
  EvaluateForces(&w);
}

void Rod::Impl::AssembleStatics(bool exact) {
  if (exact)
    AssembleExactTangent(joints, stiffening, &w);
  else
    AssembleTangent(0.0, &w);
  if (laws.empty()) return;
  const int from = laws.answers_to_gamma() ? 0 : 3;
  for (int e = 0; e < model.elements; ++e) {
    const LawElement element = StaticElement(e);
    LawTangent by_nodes;
    element.Tangent(laws.Evaluate(e, StaticStrain(element), 0).tangent, h, laws.answers_to_gamma(),
                    &by_nodes);
    for (int i = from; i < 6; ++i) {
      for (int j = from; j <= i; ++j) {
        w.system.diagonal(e)[i][j] += by_nodes.first(i, j);
        w.system.diagonal(e + 1)[i][j] += by_nodes.second(i, j);
      }
      for (int j = from; j < 6; ++j) w.system.lower(e)[j][i] += by_nodes.coupling(i, j);
    }
  }
}

}  // namespace cosserat_cable::rod
