#include "cosserat_cable/contact/point_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cosserat_cable/math/kernel.h"
#include "cosserat_cable/math/lane_rows.h"

namespace cosserat_cable {
namespace {

constexpr std::size_t kStep = Lanes::kCount;

// R: of the frame B in W, by columns.
COSSERAT_CABLE_KERNEL
void Transform(std::size_t stride, const double* W, const double* R, const double* p, double* B) {
  for (std::size_t i = 0; i < stride; i += kStep) {
    const Lanes x = LoadLanes(W + i) - Lanes(p[0]);
    const Lanes y = LoadLanes(W + stride + i) - Lanes(p[1]);
    const Lanes z = LoadLanes(W + 2 * stride + i) - Lanes(p[2]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double* column = R + 3 * axis;
      StoreLanes(Lanes(column[0]) * x + Lanes(column[1]) * y + Lanes(column[2]) * z,
                 B + axis * stride + i);
    }
  }
}

// The largest length of several vectors, of which `component(axis, i)` tells some from the i-th on;
// infinite where one is not finite.
template <class Component>
double Longest(std::size_t count, const Component& component) {
  Lanes longest(0.0), sum(0.0);
  for (std::size_t i = 0; i < count; i += kStep) {
    Lanes square(0.0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Lanes c = component(axis, i);
      square += c * c;
    }
    longest = Max(longest, square);
    sum += square;  // a maximum may lose a NaN, a sum does not
  }
  if (!std::isfinite(sum[0] + sum[1] + sum[2] + sum[3]))
    return std::numeric_limits<double>::infinity();
  return std::sqrt(std::max({longest[0], longest[1], longest[2], longest[3]}));
}

COSSERAT_CABLE_KERNEL
double LongestStepOf(std::size_t stride, std::size_t size, const double* rows) {
  return Longest(size, [&](std::size_t axis, std::size_t i) {
    const double* row = rows + axis * stride + i;
    return LoadLanes(row + 1) - LoadLanes(row);
  });
}

COSSERAT_CABLE_KERNEL
double LongestWayOf(std::size_t stride, const double* from, const double* to) {
  return Longest(stride, [&](std::size_t axis, std::size_t i) {
    return LoadLanes(to + axis * stride + i) - LoadLanes(from + axis * stride + i);
  });
}

COSSERAT_CABLE_KERNEL
double RadiusOf(std::size_t stride, const double* rows) {
  return Longest(
      stride, [&](std::size_t axis, std::size_t i) { return LoadLanes(rows + axis * stride + i); });
}

}  // namespace

void PointRows::Resize(std::size_t size) {
  if (size == size_) return;
  size_ = size;
  stride_ = size / kStep * kStep + 2 * kStep;
  data_.assign(3 * stride_, 0.0);
}

void PointRows::Assign(const std::vector<Eigen::Vector3d>& points) {
  Resize(points.size());
  if (points.empty()) return;
  for (std::size_t i = 0; i < stride_; ++i) {
    const Eigen::Vector3d& p = points[std::min(i, size_ - 1)];
    data_[i] = p.x();
    data_[stride_ + i] = p.y();
    data_[2 * stride_ + i] = p.z();
  }
}

void PointRows::Assign(const PointRows& points_W, const Pose& X_WB) {
  Resize(points_W.size());
  const Eigen::Matrix3d R_WB = X_WB.q.toRotationMatrix();
  Transform(stride_, points_W.data_.data(), R_WB.data(), X_WB.p.data(), data_.data());
}

double PointRows::LongestStep() const { return LongestStepOf(stride_, size_, data_.data()); }

double PointRows::Radius() const { return RadiusOf(stride_, data_.data()); }

double PointRows::LongestWay(const PointRows& before) const {
  if (before.size_ != size_) return std::numeric_limits<double>::infinity();
  return LongestWayOf(stride_, before.data_.data(), data_.data());
}

}  // namespace cosserat_cable
