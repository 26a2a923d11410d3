// The smallest distance between a cable and the bodies around it, at the cost of a few queries.
#pragma once

#include <vector>

#include "contact_set.h"

namespace cosserat_cable {

/// A distance changes by no more than its point moves in the body's frame. So each site keeps its
/// last exact distance, and only sites that could be the nearest by that bound are asked again.
class NearestBody {
 public:
  NearestBody(std::vector<ContactSite> sites, std::vector<const Body*> bodies, double reach);

  /// Smallest signed distance [m] from the centreline to any body; +infinity where all are beyond
  /// reach.
  double Distance(const std::vector<Pose>& nodes_W, const std::vector<Motion>& bodies_W);

 private:
  struct Memory {
    Eigen::Vector3d p_B = Eigen::Vector3d::Zero();
    double distance = -std::numeric_limits<double>::infinity();  // at p_B; a lower bound
  };
  struct Candidate {
    double bound;
    int index;
    Eigen::Vector3d p_B;
  };

  std::vector<ContactSite> sites_;
  std::vector<const Body*> bodies_;
  double reach_;
  std::vector<Memory> memory_;  // site-major
  std::vector<Candidate> candidates_;
};

}  // namespace cosserat_cable
