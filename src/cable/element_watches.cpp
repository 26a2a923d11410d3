#include "element_watches.h"

#include <algorithm>
#include <cmath>

#include "cosserat_cable/math/kernel.h"
#include "cosserat_cable/math/lane_rows.h"

namespace cosserat_cable {
namespace {

constexpr std::size_t kStep = Lanes::kCount;

std::size_t RoundedUp(std::size_t count) { return (count + kStep - 1) / kStep * kStep; }

// How far each element has moved beyond what it may, in squares of lengths; returns the largest.
COSSERAT_CABLE_KERNEL
double Excess(std::size_t stride, const double* watches, double distance, const double* x,
              const double* y, const double* z, double* excess) {
  Lanes worst(-1.0);
  for (std::size_t i = 0; i < stride; i += kStep) {
    const double* then = watches + i;
    const Lanes ax = LoadLanes(x + i) - LoadLanes(then),
                ay = LoadLanes(y + i) - LoadLanes(then + stride),
                az = LoadLanes(z + i) - LoadLanes(then + 2 * stride);
    const Lanes bx = LoadLanes(x + i + 1) - LoadLanes(then + 3 * stride),
                by = LoadLanes(y + i + 1) - LoadLanes(then + 4 * stride),
                bz = LoadLanes(z + i + 1) - LoadLanes(then + 5 * stride);
    const Lanes way = Max(ax * ax + ay * ay + az * az, bx * bx + by * by + bz * bz);
    const Lanes may = Max(LoadLanes(then + 6 * stride) - Lanes(distance), Lanes(0.0));
    const Lanes beyond = way - may * may;
    StoreLanes(beyond, excess + i);
    worst = Max(beyond, worst);
  }
  return std::max({worst[0], worst[1], worst[2], worst[3]});
}

}  // namespace

ElementWatches::ElementWatches(std::size_t elements)
    : elements_(elements),
      stride_(RoundedUp(elements)),
      data_(stride_ * kRows, 0.0),
      excess_(stride_) {
  std::fill_n(Row(kDistance), elements, -kInfinity);
  // What only fills up the last step never comes near.
  std::fill(Row(kDistance) + elements, Row(kDistance) + stride_, kInfinity);
}

void ElementWatches::Set(std::size_t element, const Eigen::Vector3d& left_B,
                         const Eigen::Vector3d& right_B, double distance) {
  for (int axis = 0; axis < 3; ++axis) {
    Row(kLeftX + axis)[element] = left_B[axis];
    Row(kRightX + axis)[element] = right_B[axis];
  }
  Row(kDistance)[element] = distance;
}

void ElementWatches::SetAll(const PointRows& nodes_B, double distance) {
  const double* nodes[3] = {nodes_B.x(), nodes_B.y(), nodes_B.z()};
  for (int axis = 0; axis < 3; ++axis) {
    std::copy_n(nodes[axis], elements_, Row(kLeftX + axis));
    std::copy_n(nodes[axis] + 1, elements_, Row(kRightX + axis));
  }
  for (std::size_t e = 0; e < elements_; ++e)
    if (Row(kDistance)[e] < kInfinity) Row(kDistance)[e] = distance;
}

double ElementWatches::DistanceAt(std::size_t element, const Eigen::Vector3d& left_B,
                                  const Eigen::Vector3d& right_B) const {
  double left = 0, right = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = left_B[axis] - Row(kLeftX + axis)[element];
    const double b = right_B[axis] - Row(kRightX + axis)[element];
    left += a * a;
    right += b * b;
  }
  return distance(element) - std::sqrt(std::max(left, right));
}

const std::vector<std::size_t>& ElementWatches::Within(double distance, const PointRows& nodes_B) {
  within_.clear();
  const double largest = Excess(stride_, data_.data(), distance, nodes_B.x(), nodes_B.y(),
                                nodes_B.z(), excess_.data());
  if (largest < 0) return within_;
  for (std::size_t e = 0; e < elements_; ++e)
    if (excess_[e] >= 0) within_.push_back(e);
  return within_;
}

}  // namespace cosserat_cable
