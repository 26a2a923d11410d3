// The smallest distance between a cable and the bodies around it, at the cost of a few queries.
#pragma once

#include <limits>
#include <vector>

#include "contact_set.h"

namespace cosserat_cable {

/// Each element keeps a bound of its distance from each body; only elements that could be the
/// nearest by that bound are asked again.
class NearestBody {
 public:
  NearestBody(std::vector<ContactSite> sites, std::vector<const Body*> bodies, double reach);

  /// Smallest signed distance [m] from the centreline to any body; +infinity where all are beyond
  /// reach. `X_WC`: see Approaches::Move.
  double Distance(const Pose& X_WC, const std::vector<Eigen::Vector3d>& nodes_W,
                  const std::vector<Motion>& bodies_W);

 private:
  /// An element against one body, its ends in the body's frame [m].
  struct Pair {
    std::size_t body, element;
    Eigen::Vector3d left_B, right_B;

    Eigen::Vector3d At(double xi) const { return left_B + xi * (right_B - left_B); }
  };
  /// What was found when a body was asked for a site last.
  struct Seen {
    Eigen::Vector3d p_B = Eigen::Vector3d::Zero();               // where the site was
    double at_least = -std::numeric_limits<double>::infinity();  // its distance then
    /// The body's nearest point.
    Eigen::Vector3d foot_B = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  };
  std::size_t elements() const { return first_sites_.size() - 1; }
  bool HasSites(std::size_t element) const {
    return first_sites_[element] != first_sites_[element + 1];
  }
  Seen& Memory(std::size_t body, int site) {
    return seen_[body * sites_.size() + static_cast<std::size_t>(site)];
  }
  /// The site's distance from the body, or a bound of it that is not below `reach` [m].
  double Ask(std::size_t body, int site, const Eigen::Vector3d& p_B, double reach);
  /// Asks the pair's sites as far as they could be nearer than `nearest` [m]; returns the smallest
  /// distance found, or `nearest`.
  double Improve(const Pair& pair, double nearest);

  std::vector<ContactSite> sites_;
  std::vector<const Body*> bodies_;
  double reach_;
  std::vector<int> first_sites_;
  Approaches approaches_;
  std::vector<ElementWatches> watches_;  // by body
  std::vector<Seen> seen_;               // body-major, by site
  PointRows nodes_W_, nodes_B_;          // scratch
  // Which were the nearest last time; at first none, as no body has that index.
  std::size_t last_body_;
  int last_site_ = 0;
};

}  // namespace cosserat_cable
