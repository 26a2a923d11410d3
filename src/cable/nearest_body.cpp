#include "nearest_body.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cosserat_cable {
namespace {

// Beyond what is the nearest now, how far a pair's distance is still told apart: it may move by so
// much before it is asked again [m].
constexpr double kAhead = 2e-3;
// Distances are 1-Lipschitz, but for rounding [m].
constexpr double kRounding = 1e-9;
// The distance of an element without sites.
constexpr double kNever = std::numeric_limits<double>::infinity();

}  // namespace

NearestBody::NearestBody(std::vector<ContactSite> sites, std::vector<const Body*> bodies,
                         double reach)
    : sites_(std::move(sites)),
      bodies_(std::move(bodies)),
      reach_(reach),
      first_sites_(FirstSites(sites_)),
      approaches_(bodies_),
      watches_(bodies_.size(), ElementWatches(elements())),
      feet_B_(bodies_.size() * elements(), Eigen::Vector3d::Constant(kNever)),
      last_body_(bodies_.size()) {
  for (ElementWatches& watches : watches_)
    for (std::size_t e = 0; e < elements(); ++e)
      if (!HasSites(e)) watches.Set(e, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), kNever);
}

double NearestBody::Improve(const Pair& pair, double nearest) {
  const Body& body = *bodies_[pair.body];
  const Eigen::Vector3d along_B = pair.right_B - pair.left_B;
  const double length = along_B.norm();
  const auto watch = [&](double distance) {
    watches_[pair.body].Set(pair.element, pair.left_B, pair.right_B, distance);
  };
  const double at_least = body.LowerBound(pair.left_B + 0.5 * along_B) - 0.5 * length;
  if (at_least >= nearest) {
    watch(at_least);
    return nearest;
  }

  const double limit = std::min(nearest + kAhead, reach_);
  double bound = limit;
  // From the middle outwards: how far a site can be follows from the one before it.
  const int* first = &first_sites_[pair.element];
  const int middle = (first[0] + first[1]) / 2;
  double known_at = 0, known = kNever;
  Eigen::Vector3d& foot_B = feet_B_[pair.body * elements() + pair.element];
  const auto look = [&](int i) {
    const double xi = sites_[i].xi;
    const double way = std::abs(xi - known_at) * length;
    if (i != middle && known - way >= nearest) {
      bound = std::min(bound, known - way);
      return;
    }
    const Eigen::Vector3d p_B = pair.left_B + xi * along_B;
    // Where nothing is within the limit, the others of this element are hardly nearer. The body is
    // no farther than a point of it that is known.
    const double reach = std::min(
        {limit + 0.5 * length, known + way + kRounding, (p_B - foot_B).norm() + kRounding});
    const Clearance found = body.Query(p_B, reach);
    if (found.shape >= 0) foot_B = found.nearest;
    known = std::min(reach, found.distance);
    known_at = xi;
    bound = std::min(bound, known);
    nearest = std::min(nearest, known);
  };
  look(middle);
  const double from_middle = known;
  for (int i = middle + 1; i < first[1]; ++i) look(i);
  known = from_middle;
  known_at = sites_[middle].xi;
  for (int i = middle - 1; i >= first[0]; --i) look(i);
  watch(bound);
  return nearest;
}

double NearestBody::Distance(const Pose& X_WC, const std::vector<Eigen::Vector3d>& nodes_W,
                             const std::vector<Motion>& bodies_W) {
  nodes_W_.Assign(nodes_W);
  approaches_.Move(X_WC, nodes_W_, bodies_W);
  double nearest = reach_;
  const auto look = [&](std::size_t b, std::size_t e) {
    const double improved = Improve({b, e, nodes_B_[e], nodes_B_[e + 1]}, nearest);
    if (improved < nearest) {
      last_body_ = b;
      last_element_ = e;
    }
    nearest = improved;
  };
  // What was the nearest will hardly be far now: with it first, little else needs a look.
  const std::size_t likely_body = last_body_, likely_element = last_element_;
  if (likely_body < bodies_.size()) {
    nodes_B_.Assign(nodes_W_, bodies_W[likely_body].X);
    look(likely_body, likely_element);
  }
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (approaches_.at_least(b) >= nearest) continue;
    nodes_B_.Assign(nodes_W_, bodies_W[b].X);
    const double watched = watches_[b].Look(nodes_B_);
    // What elements know holds for a body as it is turned.
    double at_least = bodies_[b]->axis() < 0 ? watched : -kNever;
    if (at_least < nearest) {
      const double of_nodes = bodies_[b]->LowerBoundTurned(nodes_B_);
      at_least = std::max(at_least, of_nodes - 0.5 * nodes_B_.LongestStep());
    }
    approaches_.Set(b, at_least);
    if (at_least >= nearest) continue;
    for (std::size_t e = 0; e < elements(); ++e)
      if (watches_[b].at_least(e) < nearest && (b != likely_body || e != likely_element))
        look(b, e);
  }
  return nearest < reach_ ? nearest : std::numeric_limits<double>::infinity();
}

}  // namespace cosserat_cable
