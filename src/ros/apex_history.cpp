#include "cosserat_cable/ros/apex_history.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

namespace cosserat_cable {

void ApexHistory::Add(std::int64_t time, const Eigen::Vector3d& position) {
  samples_.push_back({time, position});
  while (samples_.front().time < time - window_) samples_.pop_front();
}

double ApexHistory::PeakToPeak() const {
  if (samples_.size() < 2) return 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Sample& sample : samples_) mean += sample.position;
  mean /= static_cast<double>(samples_.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Sample& sample : samples_) {
    const Eigen::Vector3d d = sample.position - mean;
    scatter += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter);
  const Eigen::Vector3d axis = eigen.eigenvectors().col(2);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Sample& sample : samples_) {
    const double along = axis.dot(sample.position - mean);
    low = std::min(low, along);
    high = std::max(high, along);
  }
  return high - low;
}

}  // namespace cosserat_cable
