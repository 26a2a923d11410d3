// extensions.drift: EI, eta_EI, GJ, eta_GJ change linearly over each record, from factor 1 at its
// first instant to 1 + x at its last.

#include <algorithm>

#include "kinds.h"

namespace cosserat_cable::generator {
namespace {

class Drift : public Effect {
 public:
  Drift(const Eigen::Vector3d& C, const Eigen::Vector3d& V, double duration)
      : C_(C), V_(V), duration_(duration) {}
  bool bends() const override { return true; }
  void addMoments(const SectionState& at, Points* M) const override {
    if (at.settled) return;
    const double part = std::clamp(at.t / duration_, 0.0, 1.0);
    *M += part * (C_.asDiagonal() * at.K + V_.asDiagonal() * at.Kd);
  }

 private:
  Eigen::Vector3d C_, V_;  // changes by the end
  double duration_;
};

EffectValues defaults(const EffectScale&, double size) {
  return {
      {"EI", -0.08 * size}, {"eta_EI", 0.4 * size}, {"GJ", -0.08 * size}, {"eta_GJ", 0.4 * size}};
}

std::unique_ptr<Effect> make(const EffectValues& values, const EffectSite& site) {
  const double EI = valueOf(values, "EI") * site.cable.EI;
  const double eta_EI = valueOf(values, "eta_EI") * site.cable.eta_EI;
  return std::make_unique<Drift>(
      Eigen::Vector3d(EI, EI, valueOf(values, "GJ") * site.cable.GJ),
      Eigen::Vector3d(eta_EI, eta_EI, valueOf(values, "eta_GJ") * site.cable.eta_GJ),
      site.duration);
}

}  // namespace

const EffectKind kDrift = {"drift", "extensions.drift", defaults, make};

}  // namespace cosserat_cable::generator
