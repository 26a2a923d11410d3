#include "cosserat_cable/ros/apex_history.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

namespace cosserat_cable {

void ApexHistory::Add(std::int64_t time, const Eigen::Vector3d& position) {
  samples_.push_back({time, position});
  while (samples_[first_].time < time - window_) ++first_;
  // What has left is moved out once it is the greater part: a constant cost for each sample.
  if (first_ > samples_.size() / 2) {
    samples_.erase(samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(first_));
    first_ = 0;
  }
}

void ApexHistory::Clear() {
  samples_.clear();
  first_ = 0;
}

double ApexHistory::PeakToPeak() const {
  const std::size_t count = samples_.size() - first_;
  if (count < 2) return 0;
  // Relative to a sample, the moments about the mean follow from one walk without cancellation.
  const Eigen::Vector3d origin = samples_.back().position;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  Eigen::Vector3d products = Eigen::Vector3d::Zero();  // yz, zx, xy
  for (std::size_t i = first_; i < samples_.size(); ++i) {
    const Eigen::Vector3d d = samples_[i].position - origin;
    sum += d;
    squares += d.cwiseProduct(d);
    products += Eigen::Vector3d(d.y() * d.z(), d.z() * d.x(), d.x() * d.y());
  }
  Eigen::Matrix3d scatter;
  scatter << squares.x(), products.z(), products.y(),  //
      products.z(), squares.y(), products.x(),         //
      products.y(), products.x(), squares.z();
  scatter -= sum * sum.transpose() / static_cast<double>(count);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter);
  const Eigen::Vector3d axis = eigen.eigenvectors().col(2);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t i = first_; i < samples_.size(); ++i) {
    const double along = axis.dot(samples_[i].position - origin);
    low = std::min(low, along);
    high = std::max(high, along);
  }
  return high - low;
}

}  // namespace cosserat_cable
