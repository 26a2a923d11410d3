// Where a cable touches bodies during one step, and the load that this puts on the rod.
//
// The cable's surface is a row of spheres of its radius, no farther apart than that radius. Once
// per step each is asked for the body's surface next to where it is about to be; within the step's
// iterations that surface is the tangent plane there.
#pragma once

#include <vector>

#include "cosserat_cable/cable/cable_simulation.h"
#include "cosserat_cable/contact/tracker.h"
#include "cosserat_cable/rod/load.h"

namespace cosserat_cable {

/// A point of the centreline between two nodes.
struct ContactSite {
  int element;
  double xi;  ///< fraction of the element
  double s;   ///< arc length [m]
};

/// The sites of a cable: nodes, and evenly spaced between them, no farther apart than the radius, and none within a
/// diameter of a clamp, where the fitting is.
std::vector<ContactSite> PlaceContactSites(const CableModel& model);

class ContactSet : public rod::Load {
 public:
  ContactSet(const CableModel& model, std::vector<const Body*> bodies);

  /// Looks for what is near the centreline given by its nodes [m], the bodies being as in
  /// `bodies_W`. Remembers nothing until Accept.
  void Search(const std::vector<Eigen::Vector3d>& nodes_W, const std::vector<Motion>& bodies_W);
  /// The step ended: what Search found becomes memory.
  void Accept();
  /// Forgets every side, as for a cable that is put somewhere else.
  void Reset();

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
  /// When a body was last searched site by site, and how far the cable may move before it must be
  /// again.
  struct Watch {
    bool searched = false;                 // in the last call of Search
    bool known = false;                    // whether the trackers remember anything
    double slack = 0;                      // [m]; 0: search every time
    std::vector<Eigen::Vector3d> nodes_B;  // then [m]
  };
  struct Sphere {
    Eigen::Vector3d centre;
    double radius;
  };
  static Sphere Bound(const std::vector<Eigen::Vector3d>& points);
  /// True where no site can be within the radius and the margin of body `b`; updates its watch.
  bool OutOfReach(std::size_t b, const Pose& X_BW, const Sphere& bound_W,
                  const std::vector<Eigen::Vector3d>& nodes_W);
  void Forget(std::size_t b);
  Gap MeasureGap(const Plane& plane, const rod::Centreline& rod) const;

  double radius_;
  ContactLaw law_;
  std::vector<const Body*> bodies_;
  std::vector<ContactSite> sites_;
  std::vector<ContactTracker> trackers_;  // body-major
  std::vector<Found> found_;              // likewise, of the last search
  std::vector<Watch> watches_;            // by body
  std::vector<Plane> planes_;
};

}  // namespace cosserat_cable
