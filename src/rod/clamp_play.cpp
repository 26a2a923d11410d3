#include "cosserat_cable/rod/clamp_play.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

struct Rounded {
  double value, slope, integral;
};

/// f of the header, its derivative and its integral.
Rounded Beyond(double x, double gap) {
  const double w = ClampPlay::kRounding * gap, inside = x - gap + 0.5 * w;
  if (inside <= 0) return {0, 0, 0};
  if (inside >= w) {
    const double past = x - gap;
    return {past, 1, 0.5 * past * past + w * w / 24};
  }
  return {0.5 * inside * inside / w, inside / w, inside * inside * inside / (6 * w)};
}

}  // namespace

std::unique_ptr<EndLaw> ClampPlay::Clone() const { return std::make_unique<ClampPlay>(*this); }

EndLaw::Resistance ClampPlay::Resist(const Vector3d& psi, const Vector3d&) const {
  Resistance resistance;
  const double size = psi.head<2>().norm();
  const Rounded beyond = Beyond(size, gap_);
  if (beyond.slope == 0) return resistance;
  const Vector2d along = psi.head<2>() / size;
  const Matrix2d radial = along * along.transpose();
  resistance.moment.head<2>() = stiffness_ * beyond.value * along;
  resistance.by_psi.topLeftCorner<2, 2>() =
      stiffness_ * (beyond.slope * radial + beyond.value / size * (Matrix2d::Identity() - radial));
  return resistance;
}

double ClampPlay::Potential(const Vector3d& psi) const {
  return stiffness_ * Beyond(psi.head<2>().norm(), gap_).integral;
}

}  // namespace cosserat_cable::rod
