// Where the state of a rod is between steps: with the rod, or still in the lanes of the chain that
// stepped it, so that steps in a row need no copying in and out.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cosserat_cable/rod/rod.h"
#include "element.h"

namespace cosserat_cable::rod {

/// A chain that keeps the states of the rods it steps.
class RodHome {
 public:
  virtual ~RodHome() = default;
  /// Copies the state in `lane` to the rod; it stays here as well.
  virtual void Fetch(int lane, Rod::Impl* rod) = 0;
  /// One of its nodes.
  virtual Node<double> NodeAt(int lane, int i) const = 0;
  /// The rod in `lane` changes by itself from now on, or ends.
  virtual void MoveOut(int lane) = 0;
  /// The law of the rod in `lane` has changed.
  virtual void ForgetLaw(int lane) = 0;
  /// As Rod::Predict, without the clamps.
  virtual void Predict(int lane, double dt, std::vector<Eigen::Vector3d>* positions) const = 0;
};

/// Of one rod. A copy of a rod is at no one's home.
struct RodAddress {
  RodAddress() = default;
  RodAddress(const RodAddress&) {}
  RodAddress& operator=(const RodAddress&) { return *this; }

  RodHome* home = nullptr;
  int lane = 0;
  bool fetched = true;  // what the rod itself has is the state at home
};

}  // namespace cosserat_cable::rod
