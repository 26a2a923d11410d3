// How far the elements of a cable may move towards a body before they are worth another look.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "cosserat_cable/contact/point_rows.h"

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
  /// The same `distance` for every element that has not been given the distance of one that never
  /// comes near (+infinity).
  void SetAll(const PointRows& nodes_B, double distance);
  /// Nothing is known of the element any more.
  void Forget(std::size_t element) { Row(kDistance)[element] = -kInfinity; }
  /// The lower bound given last [m]; -infinity: none.
  double distance(std::size_t element) const { return Row(kDistance)[element]; }

  /// A lower bound of the distance [m] with the ends where they are now.
  double DistanceAt(std::size_t element, const Eigen::Vector3d& left_B,
                    const Eigen::Vector3d& right_B) const;
  /// The elements that are not farther than `distance` [m] by their bounds. Valid until asked
  /// again.
  const std::vector<std::size_t>& Within(double distance, const PointRows& nodes_B);

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  enum { kLeftX, kLeftY, kLeftZ, kRightX, kRightY, kRightZ, kDistance, kRows };
  double* Row(int row) { return data_.data() + static_cast<std::size_t>(row) * stride_; }
  const double* Row(int row) const {
    return data_.data() + static_cast<std::size_t>(row) * stride_;
  }

  std::size_t elements_, stride_;
  std::vector<double> data_;
  std::vector<double> excess_;       // scratch, of the last question
  std::vector<std::size_t> within_;  // its answer
};

}  // namespace cosserat_cable
