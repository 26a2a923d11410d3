#include "cosserat_cable/contact/point_rows.h"

#include <algorithm>
#include <cmath>

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

COSSERAT_CABLE_KERNEL
double LongestStepOf(std::size_t stride, std::size_t size, const double* rows) {
  Lanes longest(0.0);
  for (std::size_t i = 0; i < size; i += kStep) {
    Lanes square(0.0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double* row = rows + axis * stride + i;
      const Lanes step = LoadLanes(row + 1) - LoadLanes(row);
      square += step * step;
    }
    longest = Max(longest, square);
  }
  return std::sqrt(std::max({longest[0], longest[1], longest[2], longest[3]}));
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

}  // namespace cosserat_cable
