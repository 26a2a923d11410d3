#include "cosserat_cable/rod/clamp_friction.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Just slipped, it sticks again until it goes on, whatever rounding made of the slip.
constexpr double kOnSurface = 1 + 1e-9;

}  // namespace

std::unique_ptr<EndLaw> ClampFriction::Clone() const {
  return std::make_unique<ClampFriction>(*this);
}

EndLaw::Resistance ClampFriction::Resist(const Vector3d& psi, const Vector3d&) const {
  const Vector3d trial = Trial(psi);
  const double size = trial.norm();
  Resistance resistance;
  if (size <= kOnSurface * slip_moment_) {
    resistance.moment = trial;
    resistance.by_psi = stuck_ * Axes().asDiagonal();
    return resistance;
  }
  // Slipping, it turns with the way and grows no more.
  const Vector3d along = trial / size;
  resistance.moment = slip_moment_ * along;
  resistance.by_psi =
      stuck_ * slip_moment_ / size * (Matrix3d(Axes().asDiagonal()) - along * along.transpose());
  return resistance;
}

double ClampFriction::Potential(const Vector3d& psi) const {
  const double size = Trial(psi).norm();
  if (size <= slip_moment_) return 0.5 * size * size / stuck_;
  return slip_moment_ * (size - 0.5 * slip_moment_) / stuck_;
}

double ClampFriction::Commit(const Vector3d& psi) {
  const Vector3d trial = Trial(psi);
  const double size = trial.norm();
  if (size <= slip_moment_) return 0;
  const double slipped = (size - slip_moment_) / stuck_;
  slip_ += slipped / size * trial;
  return slip_moment_ * slipped;
}

double ClampFriction::Energy(const Vector3d& psi) const {
  return 0.5 * Trial(psi).squaredNorm() / stuck_;
}

}  // namespace cosserat_cable::rod
