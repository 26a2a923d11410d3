// What the live node learns of the ROS master while it runs: that it is gone, that another one has
// taken its place, and that the URDF there is no longer the one that is simulated.
#pragma once

#include <chrono>
#include <string>

namespace cosserat_cable {

class MasterWatch {
 public:
  /// `description`: of robot_description, where the vehicle was read from there; empty otherwise.
  explicit MasterWatch(std::string description);
  /// Asks the master once a second, and says what has changed.
  void Look();

 private:
  void Register() const;

  std::string description_, run_id_;
  bool is_gone_ = false;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace cosserat_cable
