// extensions.nonlinear_stiffness: M = EI kappa (1 + x kappa^2/(kappa^2 + c^2)) along the bending
// part of the curvature, kappa its size.

#include "kinds.h"

namespace cosserat_cable::generator {
namespace {

class NonlinearStiffness : public Effect {
 public:
  NonlinearStiffness(double EI, double change, double curvature)
      : EI_(EI), change_(change), c2_(curvature * curvature) {}
  bool bends() const override { return true; }
  void addMoments(const SectionState& at, Points* M) const override {
    for (int i = 0; i < at.K.cols(); ++i) {
      const Eigen::Vector2d K = at.K.col(i).head<2>();
      const double k2 = K.squaredNorm();
      M->col(i).head<2>() += EI_ * change_ * k2 / (k2 + c2_) * K;
    }
  }

 private:
  double EI_, change_, c2_;
};

EffectValues defaults(const EffectScale& scale, double size) {
  return {{"change", 0.1 * size}, {"curvature", 0.5 * scale.curvature()}};
}

std::unique_ptr<Effect> make(const EffectValues& values, const EffectSite& site) {
  return std::make_unique<NonlinearStiffness>(site.cable.EI, valueOf(values, "change"),
                                              valueOf(values, "curvature"));
}

}  // namespace

const EffectKind kNonlinearStiffness = {"nonlinear_stiffness", "extensions.nonlinear_stiffness",
                                        defaults, make};

}  // namespace cosserat_cable::generator
