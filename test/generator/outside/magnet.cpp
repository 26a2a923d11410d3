// A magnet beside clamp a's axis attracts the end, which carries iron: the potential is a bell of
// width `reach` about it, across the axis; the largest force is `force`.

#include "kinds.h"
#include "patch.h"

namespace cosserat_cable::generator {
namespace {

class Magnet : public Effect {
 public:
  Magnet(double force, const Eigen::Vector3d& place, double reach, double length)
      : force_(force), place_(place), reach_(reach), end_(0.9 * length, 0.1 * length) {}
  int stations() const override { return Patch::kStations; }
  void addForces(const StationState& at, Points* force) const override {
    const RelativeMotion motion(at.clamp, end_.mean(at.s, at.position), at.clamp.v);
    Eigen::Vector3d x = (motion.x - place_) / reach_;
    x.z() = 0.0;
    // Largest at a distance of reach, where x exp((1 - x^2)/2) is 1.
    const double bell = force_ * std::exp(0.5 * (1.0 - x.squaredNorm()));
    end_.add(at.s, at.clamp.R * (-bell * x), force);
  }

 private:
  double force_;
  Eigen::Vector3d place_;
  double reach_;
  Patch end_;
};

EffectValues defaults(const EffectScale& scale, double size) {
  const CableData& c = scale.cable;
  const double swing = scale.amplitude * c.length;
  return {{"force", 0.05 * size * 3.0 * c.EI / (c.length * c.length) * scale.amplitude},
          {"x", 0.6 * swing * std::cos(scale.azimuth + 0.4)},
          {"y", 0.6 * swing * std::sin(scale.azimuth + 0.4)},
          {"reach", 0.4 * swing}};
}

std::unique_ptr<Effect> make(const EffectValues& values, const EffectSite& site) {
  const Eigen::Vector3d place(valueOf(values, "x"), valueOf(values, "y"), 0.0);
  return std::make_unique<Magnet>(valueOf(values, "force"), place, valueOf(values, "reach"),
                                  site.cable.length);
}

}  // namespace

const EffectKind kMagnet = {"magnet", "outside.magnet", defaults, make};

}  // namespace cosserat_cable::generator
