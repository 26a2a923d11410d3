// Looks at the vehicle's root now and then, as samples come, and has it judged whether it stands.
#pragma once

#include <cstdint>
#include <string>

#include "cosserat_cable/ros/link_motion.h"
#include "cosserat_cable/vehicle/upright_judge.h"

namespace cosserat_cable {

class UprightWatch {
 public:
  /// `gravity_W`: who says that it points elsewhere than down z knows what is up; nothing is judged
  /// then.
  UprightWatch(const Eigen::Vector3d& gravity_W, const std::string& root);

  /// To be called after each message.
  void Look(const LinkMotion& links);
  Findings Report(const std::string& world) const { return judge_.Report(root_, world); }

 private:
  std::string root_, world_;
  UprightJudge nothing_seen_, judge_;
  std::int64_t looked_ = 0;  // stamp [ns]
};

}  // namespace cosserat_cable
