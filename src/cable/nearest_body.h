// The smallest distance between a cable and the bodies around it, at the cost of a few queries.
#pragma once

#include <vector>

#include "contact_set.h"

namespace cosserat_cable {

/// Each element keeps a bound of its distance from each body; only elements that could be the
/// nearest by that bound are asked again.
class NearestBody {
 public:
  NearestBody(std::vector<ContactSite> sites, std::vector<const Body*> bodies, double reach);

  /// Smallest signed distance [m] from the centreline to any body; +infinity where all are beyond
  /// reach.
  double Distance(const std::vector<Pose>& nodes_W, const std::vector<Motion>& bodies_W);

 private:
  /// An element against one body, its ends in the body's frame [m].
  struct Pair {
    std::size_t index;  // of its watch
    Eigen::Vector3d left_B, right_B;
  };
  std::size_t elements() const { return first_sites_.size() - 1; }
  Pair PairAt(std::size_t index) const;
  /// Asks the pair's sites as far as they could be nearer than `nearest` [m]; returns the smallest
  /// distance found, or `nearest`.
  double Improve(const Pair& pair, double nearest);

  std::vector<ContactSite> sites_;
  std::vector<const Body*> bodies_;
  double reach_;
  std::vector<int> first_sites_;
  std::vector<ElementWatch> watches_;     // body-major
  std::vector<Eigen::Vector3d> nodes_B_;  // likewise, in that body's frame [m]
  std::size_t nodes_ = 0;
  std::size_t last_ = 0;  // the pair that was the nearest last time
};

}  // namespace cosserat_cable
