// A second strand lies along the rod, of `mass` per length, coupled to it everywhere by springs and
// dashpots: on a rod that holds still it would swing at `frequency` [rad/s] with `ratio`. Its
// weight is the rod's.

#include "follower.h"
#include "kinds.h"

namespace cosserat_cable::generator {
namespace {

class CoupledStrand : public Effect {
 public:
  CoupledStrand(double mass, double w, double ratio)
      : mass_(mass), strand_(w, ratio, Eigen::Vector3d::Zero()) {}
  int stations() const override { return 24; }
  void addForces(const StationState& at, Points* force) const override {
    if (at.settled || strand_.empty()) return;
    const Follower::State strand = strand_.at(at.t, at.position, at.velocity);
    *force -= mass_ * strand_.pull(strand, at.position, at.velocity);
  }
  void commitLoads(const StationState& at) override {
    strand_.commit(at.t, at.position, at.velocity, at.settled);
  }

 private:
  double mass_;  // [kg/m]
  Follower strand_;
};

EffectValues defaults(const EffectScale& scale, double size) {
  return {{"mass", 0.1 * size * scale.cable.rhoA},
          {"frequency", 1.3 * scale.frequency},
          {"ratio", 0.05}};
}

std::unique_ptr<Effect> make(const EffectValues& values, const EffectSite&) {
  return std::make_unique<CoupledStrand>(valueOf(values, "mass"), valueOf(values, "frequency"),
                                         valueOf(values, "ratio"));
}

}  // namespace

const EffectKind kCoupledStrand = {"coupled_strand", "outside.coupled_strand", defaults, make};

}  // namespace cosserat_cable::generator
