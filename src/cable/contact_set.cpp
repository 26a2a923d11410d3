#include "contact_set.h"

#include <algorithm>
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
      const double xi = static_cast<double>(k) / per_element;
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
  watches_.resize(bodies_.size());
  planes_.reserve(trackers_.size());
}

ContactSet::Sphere ContactSet::Bound(const std::vector<Eigen::Vector3d>& points) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : points) box.extend(p);
  return {box.center(), 0.5 * box.diagonal().norm()};
}

bool ContactSet::OutOfReach(std::size_t b, const Pose& X_BW, const Sphere& bound_W,
                            const std::vector<Eigen::Vector3d>& nodes_W) {
  Watch& watch = watches_[b];
  const double needed = bound_W.radius + radius_ + kMargin;
  if (bodies_[b]->LowerBound(X_BW * bound_W.centre) > needed) {
    if (watch.known) Forget(b);
    return true;
  }
  if (watch.slack <= 0) return false;
  // A site lies between two nodes and moves by no more than the farther-moving one.
  const Eigen::Matrix3d R_BW = X_BW.q.toRotationMatrix();
  const double square = watch.slack * watch.slack;
  for (std::size_t i = 0; i < nodes_W.size(); ++i)
    if ((R_BW * nodes_W[i] + X_BW.p - watch.nodes_B[i]).squaredNorm() >= square) return false;
  return true;
}

void ContactSet::Forget(std::size_t b) {
  const auto first = trackers_.begin() + b * sites_.size();
  std::fill(first, first + sites_.size(), ContactTracker());
  watches_[b].known = false;
  watches_[b].slack = 0;
}

void ContactSet::Search(const std::vector<Eigen::Vector3d>& nodes_W,
                        const std::vector<Motion>& bodies_W) {
  planes_.clear();
  if (bodies_.empty()) return;
  const Sphere bound_W = Bound(nodes_W);
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const Motion& motion = bodies_W[b];
    const Pose X_BW = motion.X.Inverse();
    Watch& watch = watches_[b];
    watch.searched = !OutOfReach(b, X_BW, bound_W, nodes_W);
    if (!watch.searched) continue;

    const Eigen::Matrix3d R_WB = motion.X.q.toRotationMatrix();
    const Eigen::Vector3d omega_W = R_WB * motion.omega;
    watch.nodes_B.resize(nodes_W.size());
    for (std::size_t i = 0; i < nodes_W.size(); ++i)
      watch.nodes_B[i] = R_WB.transpose() * (nodes_W[i] - motion.X.p);
    watch.slack = kSearchReach;
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      const ContactSite& site = sites_[i];
      const std::size_t k = b * sites_.size() + i;
      Found& found = found_[k];
      found.p_B =
          (1 - site.xi) * watch.nodes_B[site.element] + site.xi * watch.nodes_B[site.element + 1];
      found.clearance = trackers_[k].Look(*bodies_[b], found.p_B, radius_, kMargin, kSearchReach);
      const double apart = found.clearance.distance - radius_ - kMargin;
      watch.slack = std::min(watch.slack, apart);
      if (!found.clearance.exact || apart > 0) continue;
      const Eigen::Vector3d arm = R_WB * found.clearance.nearest;
      planes_.push_back({static_cast<int>(i), static_cast<int>(b), ToSmall(motion.X.p + arm),
                         ToSmall(R_WB * found.clearance.normal),
                         ToSmall(motion.v + omega_W.cross(arm))});
    }
  }
}

void ContactSet::Accept() {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (!watches_[b].searched) continue;
    watches_[b].known = true;
    for (std::size_t k = b * sites_.size(); k < (b + 1) * sites_.size(); ++k)
      trackers_[k].Accept(found_[k].p_B, found_[k].clearance);
  }
}

void ContactSet::Reset() {
  for (std::size_t b = 0; b < bodies_.size(); ++b) Forget(b);
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
