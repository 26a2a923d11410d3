#include "element_watches.h"

#include <algorithm>
#include <cmath>

#include "cosserat_cable/math/kernel.h"
#include "cosserat_cable/math/lane_rows.h"

namespace cosserat_cable {
namespace {

constexpr std::size_t kStep = Lanes::kCount;

std::size_t RoundedUp(std::size_t count) { return (count + kStep - 1) / kStep * kStep; }

// What is left of each element's distance after the way of its ends; returns the smallest.
COSSERAT_CABLE_KERNEL
double Left(std::size_t stride, const double* watches, const double* x, const double* y,
            const double* z, double* left) {
  Lanes smallest(std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < stride; i += kStep) {
    const double* then = watches + i;
    const Lanes ax = LoadLanes(x + i) - LoadLanes(then),
                ay = LoadLanes(y + i) - LoadLanes(then + stride),
                az = LoadLanes(z + i) - LoadLanes(then + 2 * stride);
    const Lanes bx = LoadLanes(x + i + 1) - LoadLanes(then + 3 * stride),
                by = LoadLanes(y + i + 1) - LoadLanes(then + 4 * stride),
                bz = LoadLanes(z + i + 1) - LoadLanes(then + 5 * stride);
    const Lanes way = Sqrt(Max(ax * ax + ay * ay + az * az, bx * bx + by * by + bz * bz));
    const Lanes distance = LoadLanes(then + 6 * stride) - way;
    StoreLanes(distance, left + i);
    smallest = Min(distance, smallest);
  }
  return std::min({smallest[0], smallest[1], smallest[2], smallest[3]});
}

}  // namespace

ElementWatches::ElementWatches(std::size_t elements)
    : elements_(elements),
      stride_(RoundedUp(elements)),
      data_(stride_ * kRows, 0.0),
      at_least_(stride_) {
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

double ElementWatches::Look(const PointRows& nodes_B) {
  return Left(stride_, data_.data(), nodes_B.x(), nodes_B.y(), nodes_B.z(), at_least_.data());
}

}  // namespace cosserat_cable
