#include "element_watches.h"

#include <algorithm>
#include <cmath>

#include "cosserat_cable/math/kernel.h"
#include "cosserat_cable/math/lanes.h"

namespace cosserat_cable {
namespace {

constexpr std::size_t kStep = Lanes::kCount;

std::size_t RoundedUp(std::size_t count) { return (count + kStep - 1) / kStep * kStep; }

// Through a type that may lie anywhere: GCC takes a copy of four doubles apart.
typedef double Anywhere __attribute__((vector_size(sizeof(double) * kStep), aligned(8), may_alias));

inline Lanes Load(const double* from) {
  Lanes lanes;
  lanes.v = *reinterpret_cast<const Anywhere*>(from);
  return lanes;
}

inline void Store(const Lanes& lanes, double* to) { *reinterpret_cast<Anywhere*>(to) = lanes.v; }

// R: of the frame B in W, by columns.
COSSERAT_CABLE_KERNEL
void Transform(std::size_t stride, const double* W, const double* R, const double* p, double* B) {
  for (std::size_t i = 0; i < stride; i += kStep) {
    const Lanes x = Load(W + i) - Lanes(p[0]);
    const Lanes y = Load(W + stride + i) - Lanes(p[1]);
    const Lanes z = Load(W + 2 * stride + i) - Lanes(p[2]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double* column = R + 3 * axis;
      Store(Lanes(column[0]) * x + Lanes(column[1]) * y + Lanes(column[2]) * z,
            B + axis * stride + i);
    }
  }
}

// How far the farthest-moving element has moved beyond what it may, in squares of lengths.
COSSERAT_CABLE_KERNEL
double LargestExcess(std::size_t stride, const double* watches, double distance, const double* x,
                     const double* y, const double* z) {
  Lanes worst(-1.0);
  for (std::size_t i = 0; i < stride; i += kStep) {
    const double* then = watches + i;
    const Lanes ax = Load(x + i) - Load(then), ay = Load(y + i) - Load(then + stride),
                az = Load(z + i) - Load(then + 2 * stride);
    const Lanes bx = Load(x + i + 1) - Load(then + 3 * stride),
                by = Load(y + i + 1) - Load(then + 4 * stride),
                bz = Load(z + i + 1) - Load(then + 5 * stride);
    const Lanes way = Max(ax * ax + ay * ay + az * az, bx * bx + by * by + bz * bz);
    const Lanes may = Max(Load(then + 6 * stride) - Lanes(distance), Lanes(0.0));
    worst = Max(way - may * may, worst);
  }
  return std::max({worst[0], worst[1], worst[2], worst[3]});
}

}  // namespace

void NodeRows::Resize(std::size_t size) {
  if (size == size_) return;
  size_ = size;
  // One step more, since elements are read with their right ends.
  stride_ = RoundedUp(size) + kStep;
  data_.assign(3 * stride_, 0.0);
}

void NodeRows::Assign(const std::vector<Eigen::Vector3d>& nodes) {
  Resize(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) Put(i, nodes[i]);
}

void NodeRows::Assign(const std::vector<Pose>& nodes) {
  Resize(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) Put(i, nodes[i].p);
}

void NodeRows::Assign(const NodeRows& nodes_W, const Pose& X_WB) {
  Resize(nodes_W.size());
  const Eigen::Matrix3d R_WB = X_WB.q.toRotationMatrix();
  Transform(stride_, nodes_W.data_.data(), R_WB.data(), X_WB.p.data(), data_.data());
}

ElementWatches::ElementWatches(std::size_t elements)
    : stride_(RoundedUp(elements)), data_(stride_ * kRows, 0.0) {
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

bool ElementWatches::AnyWithin(double distance, const NodeRows& nodes_B) const {
  return LargestExcess(stride_, data_.data(), distance, nodes_B.x(), nodes_B.y(), nodes_B.z()) >= 0;
}

}  // namespace cosserat_cable
