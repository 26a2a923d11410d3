// extensions.clamp_friction: the clamp turns in bending against a spring beside a Jenkins element,
// a spring `stuck` in series with a slider of moment `slip_moment`; isotropic, by a radial return
// at the end of each step.

#include "kinds.h"

namespace cosserat_cable::generator {
namespace {

class ClampFriction : public Effect {
 public:
  explicit ClampFriction(const EffectValues& values) {
    for (int end = 0; end < 2; ++end) {
      const std::string prefix = end == 0 ? "a." : "b.";
      stuck_[end] = valueOf(values, prefix + "stuck");
      slip_[end] = valueOf(values, prefix + "slip_moment");
      spring_[end] = valueOf(values, prefix + "spring");
    }
  }
  bool bendsClamp(int end) const override { return spring_[end] > 0.0; }
  bool abrupt() const override { return true; }
  void addClampMoment(int end, const ClampTurn& turn, Eigen::Vector3d* moment) const override {
    const Eigen::Vector2d angle = turn.angle.head<2>();
    moment->head<2>() += spring_[end] * angle + jenkins(end, angle);
  }
  void commit(const SectionState&, const ClampTurn* turns) override {
    for (int end = 0; end < 2; ++end) {
      if (!bendsClamp(end) || stuck_[end] <= 0.0) continue;
      const Eigen::Vector2d angle = turns[end].angle.head<2>();
      slid_[end] = angle - jenkins(end, angle) / stuck_[end];
    }
  }

 private:
  Eigen::Vector2d jenkins(int end, const Eigen::Vector2d& angle) const {
    const Eigen::Vector2d trial = stuck_[end] * (angle - slid_[end]);
    const double size = trial.norm();
    return size > slip_[end] ? Eigen::Vector2d(slip_[end] / size * trial) : trial;
  }

  double stuck_[2], slip_[2], spring_[2];
  Eigen::Vector2d slid_[2] = {Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
};

EffectValues defaults(const EffectScale& scale, double size) {
  const double own = scale.cable.EI / scale.cable.length;
  return {{"a.stuck", clampStiffness(own, 0.012 * size)},
          {"a.slip_moment", 0.25 * scale.cable.EI * scale.curvature()},
          {"a.spring", clampStiffness(own, 0.03 * size)},
          {"b.stuck", 0.0},
          {"b.slip_moment", 0.0},
          {"b.spring", 0.0}};
}

std::unique_ptr<Effect> make(const EffectValues& values, const EffectSite&) {
  return std::make_unique<ClampFriction>(values);
}

}  // namespace

const EffectKind kClampFriction = {"clamp_friction", "extensions.clamp_friction", defaults, make};

}  // namespace cosserat_cable::generator
