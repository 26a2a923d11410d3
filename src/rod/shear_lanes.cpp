#include "shear_lanes.h"

#include <algorithm>

#include "cosserat_cable/math/kernel.h"

namespace cosserat_cable::rod {
namespace {

template <int N, class Get>
BasicLanes<N> Gather(const ShearHistory* const (&from)[N], const Get& get) {
  BasicLanes<N> lanes;
#pragma GCC unroll 8
  for (int l = 0; l < N; ++l) lanes.v[l] = get(*from[l]);
  return lanes;
}

/// Both directions of one element of each rod.
template <int N>
struct Histories {
  ShearHistoryOf<BasicLanes<N>> axis[2];

  explicit Histories(const ShearHistory* const (&from)[N])
      : axis{{Gather(from, [](const ShearHistory& h) { return h[0].g1; }),
              Gather(from, [](const ShearHistory& h) { return h[0].G; })},
             {Gather(from, [](const ShearHistory& h) { return h[1].g1; }),
              Gather(from, [](const ShearHistory& h) { return h[1].G; })}} {}
};

template <int N>
void OffsetShearOf(const ShearLanes<BasicLanes<N>>& shear, StepChain<BasicLanes<N>>* chain) {
  using T = BasicLanes<N>;
  const Vec3<T> unbend = shear.forwards * shear.unbend;
  for (int k = 0; k < chain->layout.chain_elements; ++k) {
    const ShearHistory* from[N];
    ElementOffset<double>* to[N];
#pragma GCC unroll 8
    for (int l = 0; l < N; ++l) {
      const int e = std::max(0, chain->layout.ElementAt(k, l));
      from[l] = shear.history[l] + e;
      to[l] = shear.offsets[l] + e;
    }
    const Histories<N> before(from);
    const T x = shear.axis[0].Offset(before.axis[0]), y = shear.axis[1].Offset(before.axis[1]);
    chain->offsets[k] = {{shear.forwards * x, shear.forwards * y, 0.0}, unbend};
#pragma GCC unroll 8
    for (int l = 0; l < N; ++l) {
      to[l]->F.x = x[l];
      to[l]->F.y = y[l];
    }
  }
}

template <int N>
void CommitShearOf(const StepChain<BasicLanes<N>>& chain, ShearLanes<BasicLanes<N>>* shear) {
  using T = BasicLanes<N>;
  ShearHistory nobody{};  // of a lane that takes no step, or an element that is nowhere
  const ShearStep<T> axis1 = shear->axis[0], axis2 = shear->axis[1];
  T dissipation(0.0);
  for (int k = 0; k < chain.layout.chain_elements; ++k) {
    ShearHistory* of[N];
    const ShearHistory* from[N];
#pragma GCC unroll 8
    for (int l = 0; l < N; ++l) {
      const int e = chain.layout.ElementAt(k, l);
      from[l] = of[l] = shear->history[l] && e >= 0 ? shear->history[l] + e : &nobody;
    }
    const Histories<N> before(from);
    const ChainStrain<T>& strain = chain.strains[k];
    const T rate1 = shear->per_length * strain.u_rate.x,
            rate2 = shear->per_length * strain.u_rate.y;
    const ShearHistoryOf<T> now1 =
        axis1.Commit(before.axis[0], shear->per_length * strain.u.x - shear->gamma0.x, rate1);
    const ShearHistoryOf<T> now2 =
        axis2.Commit(before.axis[1], shear->per_length * strain.u.y - shear->gamma0.y, rate2);
    const T lost = axis1.DissipationRate(now1, rate1) + axis2.DissipationRate(now2, rate2);
    dissipation += k < chain.layout.padding ? chain.exists * lost : lost;
#pragma GCC unroll 8
    for (int l = 0; l < N; ++l) *of[l] = {{{now1.g1[l], now1.G[l]}, {now2.g1[l], now2.G[l]}}};
  }
  shear->dissipation = dissipation;
}

}  // namespace

#define COSSERAT_CABLE_DEFINE_SHEAR(KERNEL, T)                        \
  KERNEL                                                              \
  void OffsetShear(const ShearLanes<T>& shear, StepChain<T>* chain) { \
    OffsetShearOf(shear, chain);                                      \
  }                                                                   \
  KERNEL                                                              \
  void CommitShear(const StepChain<T>& chain, ShearLanes<T>* shear) { CommitShearOf(chain, shear); }

COSSERAT_CABLE_DEFINE_SHEAR(COSSERAT_CABLE_WIDE_KERNEL, WideLanes)
COSSERAT_CABLE_DEFINE_SHEAR(COSSERAT_CABLE_KERNEL, Lanes)
COSSERAT_CABLE_DEFINE_SHEAR(COSSERAT_CABLE_KERNEL, LanePair)

}  // namespace cosserat_cable::rod
