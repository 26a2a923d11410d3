// extensions.section_friction: Iwan's model over the two curvatures. Twelve Jenkins elements, whose
// thresholds and stiffness shares are the nodes and weights of Gauss' rule over slip_curvature
// (1 - spread) .. (1 + spread), slip each by a radial return to their circle, within a step along a
// straight line from the last commit. From the straight rod on, the history of loading counts.

#include <algorithm>

#include "../legendre.h"
#include "kinds.h"

namespace cosserat_cable::generator {
namespace {

constexpr int kElements = 12;

class SectionFriction : public Effect {
 public:
  SectionFriction(double stiffness, double slip, double spread) {
    const GaussRule rule = gaussRule(kElements);
    for (int j = 0; j < kElements; ++j) {
      share_[j] = 0.5 * rule.weights[j] * stiffness;
      threshold_[j] = slip * (1.0 + spread * rule.nodes[j]);
    }
  }
  bool bends() const override { return true; }
  bool abrupt() const override { return true; }

  void addMoments(const SectionState& at, Points* M) const override {
    for (int i = 0; i < at.K.cols(); ++i) {
      for (int j = 0; j < kElements; ++j) {
        const Eigen::Vector2d K = at.K.col(i).head<2>();
        M->col(i).head<2>() += share_[j] * elastic(K, i, j);
      }
    }
  }

  void commit(const SectionState& at, const ClampTurn*) override {
    for (int i = 0; i < at.K.cols(); ++i) {
      const Eigen::Vector2d K = at.K.col(i).head<2>();
      for (int j = 0; j < kElements; ++j) {
        const Eigen::Vector2d slipped = K - elastic(K, i, j);
        if (slipped_.cols() != kElements * at.K.cols()) {
          slipped_.setZero(2, kElements * at.K.cols());
        }
        slipped_.col(kElements * i + j) = slipped;
      }
    }
  }

 private:
  Eigen::Vector2d elastic(const Eigen::Vector2d& K, int node, int j) const {
    Eigen::Vector2d e = K;
    if (slipped_.cols() > 0) e -= slipped_.col(kElements * node + j);
    const double size = e.norm();
    return size > threshold_[j] ? Eigen::Vector2d(threshold_[j] / size * e) : e;
  }

  double share_[kElements], threshold_[kElements];
  Eigen::Matrix2Xd slipped_;  // element by element of each node
};

EffectValues defaults(const EffectScale& scale, double size) {
  return {{"EI", 0.1 * size * scale.cable.EI},
          {"slip_curvature", 0.2 * scale.curvature()},
          {"spread", 0.5}};
}

std::unique_ptr<Effect> make(const EffectValues& values, const EffectSite&) {
  return std::make_unique<SectionFriction>(valueOf(values, "EI"), valueOf(values, "slip_curvature"),
                                           valueOf(values, "spread"));
}

}  // namespace

const EffectKind kSectionFriction = {"section_friction", "extensions.section_friction", defaults,
                                     make};

}  // namespace cosserat_cable::generator
