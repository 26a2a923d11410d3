#pragma once

#include "effect.h"

namespace cosserat_cable::generator {

/// What adds C K - m to the sections' moments: constant coupling and constant moment.
class LinearSection : public Effect {
 public:
  LinearSection(const Eigen::Matrix3d& C, const Eigen::Vector3d& m) : C_(C), m_(m) {}
  bool bends() const override { return true; }
  void addMoments(const SectionState& at, Points* M) const override {
    *M += (C_ * at.K).colwise() - m_;
  }

 private:
  Eigen::Matrix3d C_;
  Eigen::Vector3d m_;
};

}  // namespace cosserat_cable::generator
