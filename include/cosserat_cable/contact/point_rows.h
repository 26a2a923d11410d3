// Points of which each coordinate lies in a row of its own, for loops over four at a time.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cosserat_cable/math/pose.h"

namespace cosserat_cable {

/// Points along a line, such as a cable's nodes [m].
class PointRows {
 public:
  void Assign(const std::vector<Eigen::Vector3d>& points);
  /// The points `points_W` as seen from a frame B at X_WB.
  void Assign(const PointRows& points_W, const Pose& X_WB);

  std::size_t size() const { return size_; }
  /// What may be read of a row: more than one point beyond size(), in fours. The last point again.
  std::size_t padded_size() const { return stride_; }
  Eigen::Vector3d operator[](std::size_t i) const { return {x()[i], y()[i], z()[i]}; }
  const double* x() const { return data_.data(); }
  const double* y() const { return data_.data() + stride_; }
  const double* z() const { return data_.data() + 2 * stride_; }

  // Lengths [m], infinite where a point is not finite.

  /// The largest distance between two points that follow each other.
  double LongestStep() const;
  /// The largest distance from the frame's origin.
  double Radius() const;
  /// The largest distance between a point and where it was; infinite where that is not known.
  double LongestWay(const PointRows& before) const;

 private:
  void Resize(std::size_t size);

  std::size_t size_ = 0, stride_ = 0;
  std::vector<double> data_;
};

}  // namespace cosserat_cable
