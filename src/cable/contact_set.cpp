#include "contact_set.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cosserat_cable/math/small_eigen.h"

namespace cosserat_cable {
namespace {

// Beyond the cable's radius, how far a surface is still taken into a step: more than a point moves
// between the step's prediction and its end.
constexpr double kMargin = 2e-3;  // [m]
// How far a search looks where it must look at all; bounds what the next steps can skip.
constexpr double kSearchReach = 0.1;  // [m]
// The distance of an element without sites.
constexpr double kNever = std::numeric_limits<double>::infinity();

Vec3<double> At(const ContactSite& site, const Vec3<double>& a, const Vec3<double>& b) {
  return (1 - site.xi) * a + site.xi * b;
}

}  // namespace

std::vector<ContactSite> PlaceContactSites(const CableModel& model) {
  const ContactSites all(model.length, model.diameter, model.elements);
  std::vector<ContactSite> sites;
  for (int e = 0; e < model.elements; ++e)
    all.ForEach(e, [&](const ContactSite& site) { sites.push_back(site); });
  return sites;
}

std::vector<int> FirstSites(const std::vector<ContactSite>& sites) {
  std::vector<int> first = {0};
  for (const ContactSite& site : sites) {
    first.resize(static_cast<std::size_t>(site.element) + 2, first.back());
    ++first.back();
  }
  return first;
}

ContactSet::ContactSet(const CableModel& model, std::vector<const Body*> bodies)
    : radius_(0.5 * model.diameter),
      law_(model.contact),
      bodies_(std::move(bodies)),
      approaches_(bodies_) {
  if (!bodies_.empty()) sites_ = PlaceContactSites(model);
  first_sites_ = FirstSites(sites_);
  trackers_.resize(sites_.size() * bodies_.size());
  found_.resize(trackers_.size());
  known_.resize(elements() * bodies_.size());
  watches_.assign(bodies_.size(), ElementWatches(elements()));
  Reset();
  planes_.reserve(trackers_.size());
}

bool ContactSet::OutOfReach(std::size_t body) {
  const double needed = radius_ + kMargin;
  const double watched = watches_[body].Look(nodes_B_);
  // What elements know holds for a body as it is turned.
  double at_least = bodies_[body]->axis() < 0 ? watched : -kNever;
  if (at_least <= needed) {
    at_least = bodies_[body]->LowerBoundTurned(nodes_B_) - 0.5 * nodes_B_.LongestStep();
    if (at_least <= needed) return watched > needed;
    for (std::size_t e = 0; e < elements(); ++e)
      if (known_[body * elements() + e]) Forget(body, e);
  }
  approaches_.Set(body, at_least);
  return true;
}

bool ContactSet::OutOfReach(std::size_t body, std::size_t element, const Eigen::Vector3d& left_B,
                            const Eigen::Vector3d& right_B) {
  ElementWatches& watches = watches_[body];
  const double needed = radius_ + kMargin;
  const double half = 0.5 * (right_B - left_B).norm();
  const bool known = known_[body * elements() + element];
  // Sites that remember something look for themselves, as long as one of them is close.
  if (known && watches.distance(element) <= needed + half) return false;
  const Eigen::Vector3d middle_B = 0.5 * (left_B + right_B);
  double distance = bodies_[body]->LowerBound(middle_B);
  if (distance <= needed + half)
    distance = std::min(kSearchReach, bodies_[body]->Query(middle_B, kSearchReach).distance);
  if (distance <= needed + half) return false;
  if (known) Forget(body, element);
  watches.Set(element, left_B, right_B, distance - half);
  return true;
}

void ContactSet::Forget(std::size_t body, std::size_t element) {
  const auto first = trackers_.begin() + static_cast<std::ptrdiff_t>(body * sites_.size());
  std::fill(first + first_sites_[element], first + first_sites_[element + 1], ContactTracker());
  known_[body * elements() + element] = false;
  watches_[body].Forget(element);
}

void ContactSet::SearchSites(const Place& place, std::size_t element, const Eigen::Vector3d& left_B,
                             const Eigen::Vector3d& right_B) {
  searched_.push_back({place.body, element});
  double nearest = kSearchReach;
  for (int i = first_sites_[element]; i < first_sites_[element + 1]; ++i) {
    const std::size_t k = place.body * sites_.size() + static_cast<std::size_t>(i);
    Found& found = found_[k];
    found.p_B = (1 - sites_[i].xi) * left_B + sites_[i].xi * right_B;
    found.clearance =
        trackers_[k].Look(*bodies_[place.body], found.p_B, radius_, kMargin, kSearchReach);
    nearest = std::min(nearest, found.clearance.distance);
    if (!found.clearance.exact || found.clearance.distance > radius_ + kMargin) continue;
    const Eigen::Vector3d arm = place.R_WB * found.clearance.nearest;
    planes_.push_back({i, static_cast<int>(place.body), ToSmall(place.motion.X.p + arm),
                       ToSmall(place.R_WB * found.clearance.normal),
                       ToSmall(place.motion.v + place.omega_W.cross(arm))});
  }
  watches_[place.body].Set(element, left_B, right_B, nearest);
}

void ContactSet::Search(const Pose& X_WC, const std::vector<Eigen::Vector3d>& nodes_W,
                        const std::vector<Motion>& bodies_W) {
  planes_.clear();
  searched_.clear();
  if (bodies_.empty()) return;
  const double needed = radius_ + kMargin;
  nodes_W_.Assign(nodes_W);
  approaches_.Move(X_WC, nodes_W_, bodies_W);
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (approaches_.at_least(b) > needed) continue;
    const Motion& motion = bodies_W[b];
    nodes_B_.Assign(nodes_W_, motion.X);
    if (OutOfReach(b)) continue;
    const Eigen::Matrix3d R_WB = motion.X.q.toRotationMatrix();
    const Place place = {b, motion, R_WB, R_WB * motion.omega};
    for (std::size_t e = 0; e < elements(); ++e) {
      if (!(watches_[b].at_least(e) <= needed)) continue;
      const Eigen::Vector3d left_B = nodes_B_[e], right_B = nodes_B_[e + 1];
      if (!OutOfReach(b, e, left_B, right_B)) SearchSites(place, e, left_B, right_B);
    }
  }
}

void ContactSet::Accept() {
  for (const Searched& searched : searched_) {
    known_[searched.body * elements() + searched.element] = true;
    for (int i = first_sites_[searched.element]; i < first_sites_[searched.element + 1]; ++i) {
      const std::size_t k = searched.body * sites_.size() + static_cast<std::size_t>(i);
      trackers_[k].Accept(found_[k].p_B, found_[k].clearance);
    }
  }
}

void ContactSet::Reset() {
  std::fill(trackers_.begin(), trackers_.end(), ContactTracker());
  std::fill(known_.begin(), known_.end(), false);
  approaches_ = Approaches(bodies_);
  for (ElementWatches& watches : watches_) {
    watches = ElementWatches(elements());
    for (std::size_t e = 0; e < elements(); ++e)
      if (!HasSites(e)) watches.Set(e, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), kNever);
  }
  planes_.clear();
  searched_.clear();
}

void ContactSet::ExchangeState(StateArchive* state) {
  // How near the whole cable came is only a bound that saves searches: it is found anew.
  if (state->reading()) Reset();
  const auto exchange = [&](auto* item) { item->ExchangeState(state); };
  state->ExchangeEach(&trackers_, exchange);
  state->Exchange(&known_);
  state->ExchangeEach(&watches_, exchange);
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
