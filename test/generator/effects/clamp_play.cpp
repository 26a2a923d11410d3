// extensions.clamp_play: the clamp turns freely in bending within the gap, then against a spring.
// Within 5 % of the gap about its edge the moment sets in as a parabola; a spring of a
// ten-thousandth of EI/L within the gap leaves statics an answer.

#include "kinds.h"

namespace cosserat_cable::generator {
namespace {

constexpr double kEdge = 0.05;    // of the gap
constexpr double kCentre = 1e-4;  // of EI/L

class ClampPlay : public Effect {
 public:
  ClampPlay(const EffectValues& values, double own) : centre_(kCentre * own) {
    for (int end = 0; end < 2; ++end) {
      const std::string prefix = end == 0 ? "a." : "b.";
      gap_[end] = valueOf(values, prefix + "gap");
      stiffness_[end] = valueOf(values, prefix + "stiffness");
    }
  }
  bool bendsClamp(int end) const override { return stiffness_[end] > 0.0; }
  bool abrupt() const override { return true; }
  void addClampMoment(int end, const ClampTurn& turn, Eigen::Vector3d* moment) const override {
    const Eigen::Vector2d angle = turn.angle.head<2>();
    const double size = angle.norm(), beyond = size - gap_[end], edge = kEdge * gap_[end];
    double pressed = std::max(0.0, beyond);
    if (std::abs(beyond) < edge) pressed = (beyond + edge) * (beyond + edge) / (4.0 * edge);
    moment->head<2>() += centre_ * angle;
    if (pressed > 0.0) moment->head<2>() += stiffness_[end] * pressed / size * angle;
  }

 private:
  double centre_, gap_[2], stiffness_[2];
};

EffectValues defaults(const EffectScale& scale, double size) {
  const double own = scale.cable.EI / scale.cable.length;
  return {{"a.gap", 0.012 * scale.amplitude * size},
          {"a.stiffness", clampStiffness(own, 0.008 * size)},
          {"b.gap", 0.0},
          {"b.stiffness", 0.0}};
}

std::unique_ptr<Effect> make(const EffectValues& values, const EffectSite& site) {
  return std::make_unique<ClampPlay>(values, site.cable.EI / site.cable.length);
}

}  // namespace

const EffectKind kClampPlay = {"clamp_play", "extensions.clamp_play", defaults, make};

}  // namespace cosserat_cable::generator
