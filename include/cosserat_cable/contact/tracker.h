// What one contact point of a cable remembers about one body, so that thin walls stop it.
#pragma once

#include <limits>

#include "cosserat_cable/contact/body.h"
#include "cosserat_cable/math/state_archive.h"

namespace cosserat_cable {

/// Where a contact point stands towards a body, in the body's frame B: the plane that it is to
/// press on.
struct TrackedClearance {
  /// From the surface [m], on the side where the point belongs: negative where it has crossed, also
  /// for a two-sided shell and beyond the middle of a thin plate. Where `exact` is false, only a
  /// lower bound.
  double distance = std::numeric_limits<double>::infinity();
  Eigen::Vector3d nearest = Eigen::Vector3d::Zero();  ///< on the surface [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, to the side where the point belongs
  /// The body, on whichever side, is no farther than this [m].
  double at_most = std::numeric_limits<double>::infinity();
  bool exact = false;    ///< false: no query was needed, or nothing is within reach
  bool crossed = false;  ///< the body's own answer was on the wrong side and was not taken
};

/// Follows one point, the centre of a sphere of the cable's radius, against one body.
///
/// A distance alone cannot tell on which side of a wall a point belongs: a shell has no inside, and
/// beyond the middle of a plate the nearest way out is the far side. So the side is remembered, as
/// the last plane of contact. A point has changed sides if the normal turned by more than 90
/// degrees and either the point is or was beyond the surface, or its way was long enough to have
/// met it (|dp| >= d_before + d_now: distances are 1-Lipschitz along a path that does not cross).
/// Then, and whenever the point is inside a closed body, the body is asked not from the point but
/// from a proxy above it at the remembered plane's height of one radius (after the god-object of
/// Zilles and Salisbury 1995), which slides along on the right side. The side is decided afresh
/// where the point is more than a radius away from the surface, and at the rim of a shell.
///
/// Holds as long as a point moves by less than radius + margin between two calls of Accept.
///
/// A value: copy it, or ask as often as a step's iterations need, and Accept only where the step
/// ended.
class ContactTracker {
 public:
  /// Answers for the point at `p_B` [m] from what was last accepted. Exact wherever the distance is
  /// below `radius` + `margin` [m]; elsewhere it saves the query where the last one's distance,
  /// less the way since, still exceeds that. Where a query is made, shapes farther than `reach`
  /// [m], or than what is known to be there, count as infinitely far.
  /// @pre 0 < radius, 0 <= margin, radius + margin < reach
  TrackedClearance Look(const Body& body, const Eigen::Vector3d& p_B, double radius, double margin,
                        double reach) const;

  void ExchangeState(StateArchive* state) {
    state->Exchange(&known_, &has_side_, &distance_, &at_most_, &p_B_, &nearest_, &normal_);
  }

  /// Remembers that the point is at `p_B` [m], where Look with the same radius gave `seen`.
  void Accept(const Eigen::Vector3d& p_B, const TrackedClearance& seen);

 private:
  /// The answer asked from above the remembered plane.
  TrackedClearance LookFromProxy(const Body& body, const Eigen::Vector3d& p_B, double radius,
                                 double reach) const;

  bool known_ = false;     ///< whether anything was accepted
  bool has_side_ = false;  ///< whether that was exact, so that there is a plane
  double distance_ = 0;    ///< accepted last [m]
  double at_most_ = std::numeric_limits<double>::infinity();  ///< likewise
  Eigen::Vector3d p_B_ = Eigen::Vector3d::Zero();             ///< where
  Eigen::Vector3d nearest_ = Eigen::Vector3d::Zero(),
                  normal_ = Eigen::Vector3d::UnitZ();  ///< the plane
};

}  // namespace cosserat_cable
