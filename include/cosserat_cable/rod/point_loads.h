// Prescribed forces and moments at points of a rod: dead (fixed in the world) or following the
// section.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cosserat_cable/rod/load.h"

namespace cosserat_cable::rod {

struct PointLoad {
  double s = 0;                                      ///< arc length [m]
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< [N]
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< [N m], at the node next to s
  bool follower = false;  ///< components along the section's axes, otherwise along the world's
};

/// Change `loads` between steps for loads that vary with time.
class PointLoads : public Load {
 public:
  /// `length`: of the rod, unstressed [m].
  PointLoads(double length, std::vector<PointLoad> loads)
      : loads(std::move(loads)), length_(length) {}

  void Evaluate(const Centreline& rod, LoadSink* sink) const override;
  /// Of the dead forces; follower loads and moments in space have none.
  double Energy(const Centreline& rod) const override;
  bool HasPotential() const override;

  std::vector<PointLoad> loads;

 private:
  struct Place {
    int element;
    double xi;
    int node;  ///< the nearer one
  };
  Place PlaceOf(const PointLoad& load, const Centreline& rod) const;

  double length_;
};

}  // namespace cosserat_cable::rod
