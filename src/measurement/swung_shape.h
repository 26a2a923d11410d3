// A cable's rest, bent and twisted by the strains of small swings.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cosserat_cable/math/pose.h"
#include "cosserat_cable/measurement/specimen.h"

namespace cosserat_cable {

/// The sections turn as the swing has it, and the shape is what elements, stretched and sheared as
/// they were at rest, make of that. So a large swing does not stretch the cable, as displacements
/// along its straight shapes would.
class SwungShape {
 public:
  /// `rest`: nodes at even arc lengths of a cable of this length [m]. `held`: takes from a vector
  /// (world) the part along which end b is held; there the last node stays where the swing's own
  /// displacement has it, and what is missing is spread along the cable. The swing outlives this.
  SwungShape(const std::vector<Pose>& rest, double length, const Swing& swing,
             const Eigen::Matrix3d& held);

  std::vector<Pose> Nodes() const { return At(0); }
  /// [m/s] in the world, [rad/s] in the section.
  void Velocities(std::vector<Eigen::Vector3d>* v, std::vector<Eigen::Vector3d>* omega) const;

 private:
  /// As far as the velocities lead in a time [s].
  std::vector<Pose> At(double time) const;

  const std::vector<Pose>& rest_;
  double h_;  // of an element [m]
  const Swing& swing_;
  Eigen::Matrix3d held_;
};

}  // namespace cosserat_cable
