#include "nearest_body.h"

#include <algorithm>

namespace cosserat_cable {

NearestBody::NearestBody(std::vector<ContactSite> sites, std::vector<const Body*> bodies,
                         double reach)
    : sites_(std::move(sites)),
      bodies_(std::move(bodies)),
      reach_(reach),
      memory_(sites_.size() * bodies_.size()),
      candidates_(memory_.size()) {}

double NearestBody::Distance(const std::vector<Pose>& nodes_W,
                             const std::vector<Motion>& bodies_W) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const Eigen::Matrix3d R_BW = bodies_W[b].X.q.toRotationMatrix().transpose();
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      const ContactSite& site = sites_[i];
      const Eigen::Vector3d p_W =
          (1 - site.xi) * nodes_W[site.element].p + site.xi * nodes_W[site.element + 1].p;
      const int index = static_cast<int>(i * bodies_.size() + b);
      const Eigen::Vector3d p_B = R_BW * (p_W - bodies_W[b].X.p);
      const Memory& memory = memory_[index];
      const double bound = memory.distance - (p_B - memory.p_B).norm();
      candidates_[index] = {bound, index, p_B};
    }
  }
  // A heap with the smallest bound on top: most candidates are never looked at.
  const auto farther = [](const Candidate& x, const Candidate& y) {
    return x.bound > y.bound || (x.bound == y.bound && x.index > y.index);
  };
  std::make_heap(candidates_.begin(), candidates_.end(), farther);
  double nearest = std::numeric_limits<double>::infinity();
  for (auto end = candidates_.end(); end != candidates_.begin(); --end) {
    const Candidate& top = candidates_.front();
    if (top.bound >= std::min(nearest, reach_)) break;
    const Body& body = *bodies_[top.index % bodies_.size()];
    const double box = body.LowerBound(top.p_B);
    Memory& memory = memory_[top.index];
    memory.p_B = top.p_B;
    if (box >= reach_) {
      memory.distance = box;
    } else {
      const double distance = body.Query(top.p_B, reach_).distance;
      nearest = std::min(nearest, distance);
      memory.distance = std::min(distance, reach_);
    }
    std::pop_heap(candidates_.begin(), end, farther);
  }
  return nearest < reach_ ? nearest : std::numeric_limits<double>::infinity();
}

}  // namespace cosserat_cable
