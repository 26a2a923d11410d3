// How far the elements of a cable may move towards a body before they are worth another look.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "cosserat_cable/contact/point_rows.h"
#include "cosserat_cable/math/state_archive.h"

namespace cosserat_cable {

/// What was known of each element's distance from one body, and where its ends were then, in the
/// body's frame. A distance changes by no more than its point moves, and a point between two nodes
/// moves by no more than the farther-moving one.
class ElementWatches {
 public:
  explicit ElementWatches(std::size_t elements);
  std::size_t elements() const { return elements_; }

  /// `distance` [m]: a lower bound with the element's ends at `left_B`, `right_B` [m].
  void Set(std::size_t element, const Eigen::Vector3d& left_B, const Eigen::Vector3d& right_B,
           double distance);
  /// Nothing is known of the element any more.
  void Forget(std::size_t element) { Row(kDistance)[element] = -kInfinity; }
  /// The lower bound given last [m]; -infinity: none.
  double distance(std::size_t element) const { return Row(kDistance)[element]; }

  void ExchangeState(StateArchive* state) { state->Exchange(&data_); }

  /// Takes the nodes to where they are now, and returns the smallest bound of all elements [m].
  double Look(const PointRows& nodes_B);
  /// The element's bound by the last Look [m].
  double at_least(std::size_t element) const { return at_least_[element]; }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  enum { kLeftX, kLeftY, kLeftZ, kRightX, kRightY, kRightZ, kDistance, kRows };
  double* Row(int row) { return data_.data() + static_cast<std::size_t>(row) * stride_; }
  const double* Row(int row) const {
    return data_.data() + static_cast<std::size_t>(row) * stride_;
  }

  std::size_t elements_, stride_;
  std::vector<double> data_;
  std::vector<double> at_least_;
};

}  // namespace cosserat_cable
