// How far the elements of a cable may move towards a body before they are worth another look.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "cosserat_cable/math/pose.h"

namespace cosserat_cable {

/// Positions of a cable's nodes [m], each coordinate in a row of its own: four nodes at a time.
class NodeRows {
 public:
  void Assign(const std::vector<Eigen::Vector3d>& nodes);
  void Assign(const std::vector<Pose>& nodes);
  /// The nodes `nodes_W` as seen from a frame B at X_WB.
  void Assign(const NodeRows& nodes_W, const Pose& X_WB);

  std::size_t size() const { return size_; }
  Eigen::Vector3d operator[](std::size_t i) const { return {x()[i], y()[i], z()[i]}; }
  const double* x() const { return data_.data(); }
  const double* y() const { return data_.data() + stride_; }
  const double* z() const { return data_.data() + 2 * stride_; }

 private:
  void Resize(std::size_t size);
  void Put(std::size_t node, const Eigen::Vector3d& p) {
    for (int axis = 0; axis < 3; ++axis)
      data_[static_cast<std::size_t>(axis) * stride_ + node] = p[axis];
  }

  std::size_t size_ = 0, stride_ = 0;
  std::vector<double> data_;
};

/// What was known of each element's distance from one body, and where its ends were then, in the
/// body's frame. A distance changes by no more than its point moves, and a point between two nodes
/// moves by no more than the farther-moving one.
class ElementWatches {
 public:
  explicit ElementWatches(std::size_t elements);

  /// `distance` [m]: a lower bound with the element's ends at `left_B`, `right_B` [m].
  void Set(std::size_t element, const Eigen::Vector3d& left_B, const Eigen::Vector3d& right_B,
           double distance);
  /// Nothing is known of the element any more.
  void Forget(std::size_t element) { Row(kDistance)[element] = -kInfinity; }
  /// The lower bound given last [m]; -infinity: none.
  double distance(std::size_t element) const { return Row(kDistance)[element]; }

  /// A lower bound of the distance [m] with the ends where they are now.
  double DistanceAt(std::size_t element, const Eigen::Vector3d& left_B,
                    const Eigen::Vector3d& right_B) const;
  /// False where every element is farther than `distance` [m] by its bound.
  bool AnyWithin(double distance, const NodeRows& nodes_B) const;

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  enum { kLeftX, kLeftY, kLeftZ, kRightX, kRightY, kRightZ, kDistance, kRows };
  double* Row(int row) { return data_.data() + static_cast<std::size_t>(row) * stride_; }
  const double* Row(int row) const {
    return data_.data() + static_cast<std::size_t>(row) * stride_;
  }

  std::size_t stride_;
  std::vector<double> data_;
};

}  // namespace cosserat_cable
