// Where a cable touches bodies during one step, and the load that this puts on the rod.
//
// The cable's surface is a row of spheres of its radius, no farther apart than that radius. Once
// per step each is asked for the body's surface next to where it is about to be; within the step's
// iterations that surface is the tangent plane there.
#pragma once

#include <vector>

#include "approaches.h"
#include "cosserat_cable/cable/cable_simulation.h"
#include "cosserat_cable/cable/contact_sites.h"
#include "cosserat_cable/contact/tracker.h"
#include "cosserat_cable/rod/load.h"
#include "element_watches.h"

namespace cosserat_cable {

/// The sites of a cable.
std::vector<ContactSite> PlaceContactSites(const CableModel& model);

/// For each element the index of its first site, and the number of sites at the end. The last
/// elements may be missing where they have none.
std::vector<int> FirstSites(const std::vector<ContactSite>& sites);

class ContactSet : public rod::Load {
 public:
  ContactSet(const CableModel& model, std::vector<const Body*> bodies);

  /// Looks for what is near the centreline given by its nodes [m], the bodies being as in
  /// `bodies_W`. Remembers no side until Accept. `X_WC`: see Approaches::Move.
  void Search(const Pose& X_WC, const std::vector<Eigen::Vector3d>& nodes_W,
              const std::vector<Motion>& bodies_W);
  /// The step ended: what Search found becomes memory.
  void Accept();
  /// Forgets every side, as for a cable that is put somewhere else.
  void Reset();

  /// Of what Accept has remembered; after reading, nothing is searched yet.
  void ExchangeState(StateArchive* state);

  bool has_bodies() const { return !bodies_.empty(); }
  std::size_t body_count() const { return bodies_.size(); }
  bool empty() const { return planes_.empty(); }
  const std::vector<ContactSite>& sites() const { return sites_; }

  void Evaluate(const rod::Centreline& rod, rod::LoadSink* sink) const override;
  double Energy(const rod::Centreline& rod) const override;
  /// The places that press on something, at the rod's present state.
  std::vector<ContactPoint> Points(const rod::Centreline& rod) const;

 private:
  struct Plane {
    int site, body;
    Vec3<double> point, normal;  // in W; the normal points to the cable
    Vec3<double> velocity;       // of the body's surface there [m/s]
  };
  struct Found {
    Eigen::Vector3d p_B;
    TrackedClearance clearance;
  };
  struct Gap {
    double penetration, rate;
    Vec3<double> position;
  };
  /// A body during one search.
  struct Place {
    std::size_t body;
    const Motion& motion;  // in W
    Eigen::Matrix3d R_WB;
    Eigen::Vector3d omega_W;
  };
  std::size_t elements() const { return first_sites_.size() - 1; }
  bool HasSites(std::size_t element) const {
    return first_sites_[element] != first_sites_[element + 1];
  }
  /// True where the whole cable, at nodes_B_, is out of reach of the body by the simplest of
  /// bounds.
  bool OutOfReach(std::size_t body);
  /// True where no site of the element can be within the radius and the margin of the body; updates
  /// its watch.
  bool OutOfReach(std::size_t body, std::size_t element, const Eigen::Vector3d& left_B,
                  const Eigen::Vector3d& right_B);
  void SearchSites(const Place& place, std::size_t element, const Eigen::Vector3d& left_B,
                   const Eigen::Vector3d& right_B);
  void Forget(std::size_t body, std::size_t element);
  Gap MeasureGap(const Plane& plane, const rod::Centreline& rod) const;

  double radius_;
  ContactLaw law_;
  std::vector<const Body*> bodies_;
  std::vector<ContactSite> sites_;
  std::vector<int> first_sites_;
  std::vector<ContactTracker> trackers_;  // body-major
  std::vector<Found> found_;              // likewise, of the last search
  Approaches approaches_;
  std::vector<ElementWatches> watches_;  // by body
  std::vector<char>
      known_;  // body-major, by element: whether its sites' trackers remember anything

  struct Searched {
    std::size_t body, element;
  };
  std::vector<Searched> searched_;  // in the last search, site by site
  PointRows nodes_W_, nodes_B_;     // scratch
  std::vector<Plane> planes_;
};

}  // namespace cosserat_cable
