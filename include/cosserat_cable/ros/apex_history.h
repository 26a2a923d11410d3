// How far a cable's apex has swung lately.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace cosserat_cable {

/// The apex's positions over a sliding window. One is added at every simulation step, not only
/// where telemetry is sent: at 200 Hz the peaks of a 40 Hz motion would be missed by a tenth.
class ApexHistory {
 public:
  explicit ApexHistory(std::int64_t window) : window_(window) {}  ///< [ns]

  void Add(std::int64_t time, const Eigen::Vector3d& position);
  void Clear();

  /// Extent of the positions along their direction of largest variance [m]; 0 for fewer than two.
  double PeakToPeak() const;

 private:
  std::int64_t window_;
  std::vector<std::int64_t> times_;
  std::array<std::vector<double>, 3> positions_;  // by coordinate
  std::size_t first_ = 0;                         // of the window
};

}  // namespace cosserat_cable
