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
      seen_(bodies_.size() * sites_.size()),
      last_body_(bodies_.size()) {
  for (ElementWatches& watches : watches_)
    for (std::size_t e = 0; e < elements(); ++e)
      if (!HasSites(e)) watches.Set(e, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), kNever);
}

double NearestBody::Ask(std::size_t body, int site, const Eigen::Vector3d& p_B, double reach) {
  Seen& seen = Memory(body, site);
  // The body is no farther than a point of it that is known.
  const double within = std::min(reach, (p_B - seen.foot_B).norm() + kRounding);
  const Clearance found = bodies_[body]->Query(p_B, within);
  if (found.shape >= 0) seen.foot_B = found.nearest;
  seen.p_B = p_B;
  seen.at_least = std::min(within, found.distance);
  return seen.at_least;
}

double NearestBody::Improve(const Pair& pair, double nearest) {
  const Body& body = *bodies_[pair.body];
  const double length = (pair.right_B - pair.left_B).norm();
  const auto watch = [&](double distance) {
    watches_[pair.body].Set(pair.element, pair.left_B, pair.right_B, distance);
  };
  const double at_least = body.LowerBound(pair.At(0.5)) - 0.5 * length;
  if (at_least >= nearest) {
    watch(at_least);
    return nearest;
  }

  const double limit = std::min(nearest + kAhead, reach_);
  double bound = limit;
  // From the middle outwards: how far a site can be follows from the one asked before it, and from
  // what it was itself.
  struct {
    double xi, at_least, at_most;
  } beside;
  const auto look = [&](int i) {
    const double xi = sites_[i].xi;
    const Eigen::Vector3d p_B = pair.At(xi);
    const Seen& seen = Memory(pair.body, i);
    const double way = std::abs(xi - beside.xi) * length;
    const double site_at_least =
        std::max(seen.at_least - (p_B - seen.p_B).norm(), beside.at_least - way);
    if (site_at_least >= nearest) {
      bound = std::min(bound, site_at_least);
      return;
    }
    // Where nothing is within the limit, the others of this element are hardly nearer.
    const double found =
        Ask(pair.body, i, p_B, std::min(limit + 0.5 * length, beside.at_most + way + kRounding));
    beside = {xi, found, found};
    bound = std::min(bound, found);
    if (found >= nearest) return;
    nearest = found;
    last_body_ = pair.body;
    last_site_ = i;
  };
  const int* first = &first_sites_[pair.element];
  const int middle = (first[0] + first[1]) / 2;
  beside = {0, -kNever, kNever};
  look(middle);
  const auto from_middle = beside;
  for (int i = middle + 1; i < first[1]; ++i) look(i);
  beside = from_middle;
  for (int i = middle - 1; i >= first[0]; --i) look(i);
  watch(bound);
  return nearest;
}

double NearestBody::Distance(const Pose& X_WC, const std::vector<Eigen::Vector3d>& nodes_W,
                             const std::vector<Motion>& bodies_W) {
  nodes_W_.Assign(nodes_W);
  approaches_.Move(X_WC, nodes_W_, bodies_W);
  const auto pair_of = [&](std::size_t b, std::size_t e) {
    return Pair{b, e, nodes_B_[e], nodes_B_[e + 1]};
  };
  double nearest = reach_;
  // What was the nearest will hardly be far now: with it first, little else needs a look.
  if (last_body_ < bodies_.size()) {
    nodes_B_.Assign(nodes_W_, bodies_W[last_body_].X);
    const ContactSite& site = sites_[last_site_];
    const Pair pair = pair_of(last_body_, static_cast<std::size_t>(site.element));
    nearest = Ask(last_body_, last_site_, pair.At(site.xi), reach_);
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
      if (watches_[b].at_least(e) < nearest) nearest = Improve(pair_of(b, e), nearest);
  }
  return nearest < reach_ ? nearest : std::numeric_limits<double>::infinity();
}

}  // namespace cosserat_cable
