#include "cosserat_cable/ros/apex_history.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "cosserat_cable/math/kernel.h"
#include "cosserat_cable/math/lane_rows.h"

namespace cosserat_cable {
namespace {

constexpr std::size_t kStep = Lanes::kCount;

// Sums of x, y, z, then of their squares, then of yz, zx, xy; all relative to `origin`.
COSSERAT_CABLE_KERNEL
void AddUp(const double* const* rows, std::size_t count, const double* origin, double* sums) {
  Lanes lanes[9];
  for (Lanes& sum : lanes) sum = Lanes(0.0);
  const auto add = [&](const Lanes& x, const Lanes& y, const Lanes& z) {
    const Lanes terms[9] = {x, y, z, x * x, y * y, z * z, y * z, z * x, x * y};
    for (int k = 0; k < 9; ++k) lanes[k] += terms[k];
  };
  std::size_t i = 0;
  for (; i + kStep <= count; i += kStep) {
    add(LoadLanes(rows[0] + i) - Lanes(origin[0]), LoadLanes(rows[1] + i) - Lanes(origin[1]),
        LoadLanes(rows[2] + i) - Lanes(origin[2]));
  }
  const auto alone = [](double value) {
    Lanes lanes(0.0);
    lanes.v[0] = value;
    return lanes;
  };
  for (; i < count; ++i) {
    add(alone(rows[0][i] - origin[0]), alone(rows[1][i] - origin[1]),
        alone(rows[2][i] - origin[2]));
  }
  for (int k = 0; k < 9; ++k) sums[k] = lanes[k][0] + lanes[k][1] + lanes[k][2] + lanes[k][3];
}

// How far the positions spread along an axis.
COSSERAT_CABLE_KERNEL
double Extent(const double* const* rows, std::size_t count, const double* origin,
              const double* axis) {
  Lanes low(0.0), high(0.0);  // the origin is among them
  const auto look = [&](const Lanes& x, const Lanes& y, const Lanes& z) {
    const Lanes along = Lanes(axis[0]) * (x - Lanes(origin[0])) +
                        Lanes(axis[1]) * (y - Lanes(origin[1])) +
                        Lanes(axis[2]) * (z - Lanes(origin[2]));
    low = Min(low, along);
    high = Max(high, along);
  };
  std::size_t i = 0;
  for (; i + kStep <= count; i += kStep)
    look(LoadLanes(rows[0] + i), LoadLanes(rows[1] + i), LoadLanes(rows[2] + i));
  for (; i < count; ++i) look(Lanes(rows[0][i]), Lanes(rows[1][i]), Lanes(rows[2][i]));
  return std::max({high[0], high[1], high[2], high[3]}) -
         std::min({low[0], low[1], low[2], low[3]});
}

}  // namespace

void ApexHistory::Add(std::int64_t time, const Eigen::Vector3d& position) {
  times_.push_back(time);
  for (int axis = 0; axis < 3; ++axis) positions_[axis].push_back(position[axis]);
  while (times_[first_] < time - window_) ++first_;
  // What has left is moved out once it is the greater part: a constant cost for each sample.
  if (first_ > times_.size() / 2) {
    const auto gone = static_cast<std::ptrdiff_t>(first_);
    times_.erase(times_.begin(), times_.begin() + gone);
    for (auto& row : positions_) row.erase(row.begin(), row.begin() + gone);
    first_ = 0;
  }
}

void ApexHistory::Clear() {
  times_.clear();
  for (auto& row : positions_) row.clear();
  first_ = 0;
}

double ApexHistory::PeakToPeak() const {
  const std::size_t count = times_.size() - first_;
  if (count < 2) return 0;
  const double* const rows[3] = {&positions_[0][first_], &positions_[1][first_],
                                 &positions_[2][first_]};
  // Relative to a sample, the moments about the mean follow from one walk without cancellation.
  const double origin[3] = {positions_[0].back(), positions_[1].back(), positions_[2].back()};
  double sums[9];
  AddUp(rows, count, origin, sums);
  Eigen::Matrix3d scatter;
  scatter << sums[3], sums[8], sums[7],  //
      sums[8], sums[4], sums[6],         //
      sums[7], sums[6], sums[5];
  const Eigen::Vector3d sum(sums);
  scatter -= sum * sum.transpose() / static_cast<double>(count);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter);
  const Eigen::Vector3d axis = eigen.eigenvectors().col(2);
  return Extent(rows, count, origin, axis.data());
}

}  // namespace cosserat_cable
