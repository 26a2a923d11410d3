#include "nearest_body.h"

#include <algorithm>
#include <cmath>

namespace cosserat_cable {
namespace {

// Beyond what is the nearest now, how far a pair's distance is still told apart: it may move by so
// much before it is asked again [m].
constexpr double kAhead = 2e-3;

}  // namespace

NearestBody::NearestBody(std::vector<ContactSite> sites, std::vector<const Body*> bodies,
                         double reach)
    : sites_(std::move(sites)),
      bodies_(std::move(bodies)),
      reach_(reach),
      first_sites_(FirstSites(sites_)),
      watches_(elements() * bodies_.size()) {}

NearestBody::Pair NearestBody::PairAt(std::size_t index) const {
  const Eigen::Vector3d* left = &nodes_B_[index / elements() * nodes_ + index % elements()];
  return {index, left[0], left[1]};
}

double NearestBody::Improve(const Pair& pair, double nearest) {
  const Body& body = *bodies_[pair.index / elements()];
  const double limit = std::min(nearest + kAhead, reach_);
  ElementWatch& watch = watches_[pair.index];
  watch.left_B = pair.left_B;
  watch.right_B = pair.right_B;

  const Eigen::Vector3d along_B = pair.right_B - pair.left_B;
  const double length = along_B.norm();
  watch.distance = body.LowerBound(pair.left_B + 0.5 * along_B) - 0.5 * length;
  if (watch.distance >= nearest) return nearest;

  // From the middle outwards: how near a site can be at most follows from the one before it.
  const int* first = &first_sites_[pair.index % elements()];
  const int middle = (first[0] + first[1]) / 2;
  watch.distance = limit;
  double known_at = sites_[middle].xi, known = -std::numeric_limits<double>::infinity();
  const auto look = [&](int i) {
    const double xi = sites_[i].xi;
    const double at_least = known - std::abs(xi - known_at) * length;
    if (at_least >= nearest) {
      watch.distance = std::min(watch.distance, at_least);
      return;
    }
    // Where nothing is within the limit, the others of this element are hardly nearer.
    const double reach = limit + 0.5 * length;
    known = std::min(reach, body.Query(pair.left_B + xi * along_B, reach).distance);
    known_at = xi;
    watch.distance = std::min(watch.distance, known);
    nearest = std::min(nearest, known);
  };
  look(middle);
  const double from_middle = known;
  for (int i = middle + 1; i < first[1]; ++i) look(i);
  known = from_middle;
  known_at = sites_[middle].xi;
  for (int i = middle - 1; i >= first[0]; --i) look(i);
  return nearest;
}

double NearestBody::Distance(const std::vector<Pose>& nodes_W,
                             const std::vector<Motion>& bodies_W) {
  nodes_ = nodes_W.size();
  nodes_B_.resize(nodes_ * bodies_.size());
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const Eigen::Matrix3d R_BW = bodies_W[b].X.q.toRotationMatrix().transpose();
    for (std::size_t i = 0; i < nodes_; ++i)
      nodes_B_[b * nodes_ + i] = R_BW * (nodes_W[i].p - bodies_W[b].X.p);
  }
  double nearest = reach_;
  const auto look = [&](std::size_t index) {
    const int* first = &first_sites_[index % elements()];
    if (first[0] == first[1]) return;
    const Pair pair = PairAt(index);
    if (watches_[index].DistanceAt(pair.left_B, pair.right_B) >= nearest) return;
    const double improved = Improve(pair, nearest);
    if (improved < nearest) last_ = index;
    nearest = improved;
  };
  // What was the nearest will hardly be far now: with it first, little else needs a look.
  const std::size_t likely = last_;
  if (likely < watches_.size()) look(likely);
  for (std::size_t index = 0; index < watches_.size(); ++index)
    if (index != likely) look(index);
  return nearest < reach_ ? nearest : std::numeric_limits<double>::infinity();
}

}  // namespace cosserat_cable
