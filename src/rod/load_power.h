// What a load puts into a rod and what it takes as heat.
#pragma once

namespace cosserat_cable::rod {

struct LoadPower {
  double work = 0, dissipation = 0;  ///< [W]
};

}  // namespace cosserat_cable::rod
