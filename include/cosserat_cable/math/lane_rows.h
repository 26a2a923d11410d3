// Lanes from rows of doubles, and back.
#pragma once

#include "cosserat_cable/math/lanes.h"

namespace cosserat_cable {

// Through a type that may lie anywhere: GCC takes a copy of four doubles apart.
typedef double UnalignedLanes
    __attribute__((vector_size(8 * Lanes::kCount), aligned(alignof(double)), may_alias));

inline Lanes LoadLanes(const double* from) {
  Lanes lanes;
  lanes.v = *reinterpret_cast<const UnalignedLanes*>(from);
  return lanes;
}

inline void StoreLanes(const Lanes& lanes, double* to) {
  *reinterpret_cast<UnalignedLanes*>(to) = lanes.v;
}

}  // namespace cosserat_cable
