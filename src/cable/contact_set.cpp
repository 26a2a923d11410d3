#include "contact_set.h"

#include <cmath>

#include "cosserat_cable/math/small_eigen.h"

namespace cosserat_cable {
namespace {

// Beyond the cable's radius, how far a surface is still taken into a step: more than a point moves
// between the step's prediction and its end.
constexpr double kMargin = 2e-3;  // [m]
// How far a search looks where it must look at all; bounds what the next steps can skip.
constexpr double kSearchReach = 0.1;  // [m]

Vec3<double> At(const ContactSite& site, const Vec3<double>& a, const Vec3<double>& b) {
  return (1 - site.xi) * a + site.xi * b;
}

}  // namespace

std::vector<ContactSite> PlaceContactSites(const CableModel& model) {
  const double h = model.length / model.elements;
  const int per_element = static_cast<int>(std::ceil(h / (0.5 * model.diameter)));
  std::vector<ContactSite> sites;
  for (int e = 0; e < model.elements; ++e)
    for (int k = 0; k < per_element; ++k) {
      const double xi = (k + 0.5) / per_element;
      const double s = (e + xi) * h;
      if (s >= model.diameter && s <= model.length - model.diameter) sites.push_back({e, xi, s});
    }
  return sites;
}

ContactSet::ContactSet(const CableModel& model, std::vector<const Body*> bodies)
    : radius_(0.5 * model.diameter), law_(model.contact), bodies_(std::move(bodies)) {
  if (!bodies_.empty()) sites_ = PlaceContactSites(model);
  trackers_.resize(sites_.size() * bodies_.size());
  found_.resize(trackers_.size());
  planes_.reserve(trackers_.size());
}

void ContactSet::Search(const std::vector<Eigen::Vector3d>& nodes_W,
                        const std::vector<Motion>& bodies_W) {
  planes_.clear();
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const Motion& motion = bodies_W[b];
    const Eigen::Matrix3d R_WB = motion.X.q.toRotationMatrix();
    const Eigen::Vector3d omega_W = R_WB * motion.omega;
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      const ContactSite& site = sites_[i];
      const Eigen::Vector3d p_W =
          (1 - site.xi) * nodes_W[site.element] + site.xi * nodes_W[site.element + 1];
      const std::size_t k = i * bodies_.size() + b;
      Found& found = found_[k];
      found.p_B = R_WB.transpose() * (p_W - motion.X.p);
      found.clearance = trackers_[k].Look(*bodies_[b], found.p_B, radius_, kMargin, kSearchReach);
      if (!found.clearance.exact || found.clearance.distance > radius_ + kMargin) continue;
      const Eigen::Vector3d arm = R_WB * found.clearance.nearest;
      planes_.push_back({static_cast<int>(i), static_cast<int>(b), ToSmall(motion.X.p + arm),
                         ToSmall(R_WB * found.clearance.normal),
                         ToSmall(motion.v + omega_W.cross(arm))});
    }
  }
}

void ContactSet::Accept() {
  for (std::size_t k = 0; k < trackers_.size(); ++k)
    trackers_[k].Accept(found_[k].p_B, found_[k].clearance);
}

void ContactSet::Reset() {
  for (ContactTracker& tracker : trackers_) tracker = ContactTracker();
  planes_.clear();
}

ContactSet::Gap ContactSet::MeasureGap(const Plane& plane, const rod::Centreline& rod) const {
  const ContactSite& site = sites_[plane.site];
  const int e = site.element;
  const Vec3<double> position = At(site, rod.position(e), rod.position(e + 1));
  const Vec3<double> velocity = At(site, rod.velocity(e), rod.velocity(e + 1));
  return {radius_ - Dot(plane.normal, position - plane.point),
          -Dot(plane.normal, velocity - plane.velocity), position};
}

void ContactSet::Evaluate(const rod::Centreline& rod, rod::LoadSink* sink) const {
  for (const Plane& plane : planes_) {
    const Gap gap = MeasureGap(plane, rod);
    const ContactLaw::Force force = law_.Evaluate(gap.penetration, gap.rate);
    if (force.value == 0) continue;
    const Mat3<double> nn = Outer(plane.normal, plane.normal);
    const ContactSite& site = sites_[plane.site];
    sink->AddForce(site.element, site.xi, force.value * plane.normal, -force.by_penetration * nn,
                   -force.by_rate * nn);
  }
}

double ContactSet::Energy(const rod::Centreline& rod) const {
  double energy = 0;
  for (const Plane& plane : planes_) energy += law_.Energy(MeasureGap(plane, rod).penetration);
  return energy;
}

std::vector<ContactPoint> ContactSet::Points(const rod::Centreline& rod) const {
  std::vector<ContactPoint> points;
  for (const Plane& plane : planes_) {
    const Gap gap = MeasureGap(plane, rod);
    const double force = law_.Evaluate(gap.penetration, gap.rate).value;
    if (force <= 0) continue;
    const Eigen::Vector3d normal = ToEigen(plane.normal);
    points.push_back({plane.body, sites_[plane.site].s, ToEigen(gap.position) - radius_ * normal,
                      force * normal, gap.penetration});
  }
  return points;
}

}  // namespace cosserat_cable
