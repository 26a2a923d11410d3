// Dry friction of a clamp in bending or in torsion, or of the bearing of a disc.
#pragma once

#include <cmath>

#include "cosserat_cable/rod/end_law.h"

namespace cosserat_cable::rod {

/// A Jenkins element about the two axes across the clamp's a3, or about a3: a spring `stuck` in
/// series with a slider that gives way at `slip_moment`, whatever the direction. With the slip p as
/// internal variable,
///
///     M = stuck (psi - p)    |M| <= slip_moment    dp along M where |M| = slip_moment
///
/// integrated by radial return (Simo and Hughes, Computational Inelasticity, 1998, ch. 3), which is
/// exact where the way is straight. A cycle between -A and A that slips loses
/// 4 slip_moment (A - slip_moment/stuck). An end at rest has been turned once, straight from psi =
/// 0, as a section's friction has been bent once.
class ClampFriction final : public EndLaw {
 public:
  enum class About { kBending, kTorsion };

  /// @pre both are positive: `stuck` [N m/rad], `slip_moment` [N m]
  ClampFriction(double stuck, double slip_moment, About about = About::kBending)
      : stuck_(stuck), slip_moment_(slip_moment), about_(about) {}

  std::unique_ptr<EndLaw> Clone() const override;
  void ExchangeState(StateArchive* state) override { state->Exchange(&slip_); }
  Resistance Resist(const Eigen::Vector3d& psi, const Eigen::Vector3d& rate) const override;
  double Potential(const Eigen::Vector3d& psi) const override;
  double Commit(const Eigen::Vector3d& psi) override;
  Resistance ResistAtRest(const Eigen::Vector3d& psi) const override {
    return New().Resist(psi, Eigen::Vector3d::Zero());
  }
  double PotentialAtRest(const Eigen::Vector3d& psi) const override { return New().Potential(psi); }
  void Rest(const Eigen::Vector3d& psi) override {
    slip_.setZero();
    Commit(psi);
  }
  bool InTorsionOnly() const override { return about_ == About::kTorsion; }
  double Energy(const Eigen::Vector3d& psi) const override;

 private:
  /// The same, never turned.
  ClampFriction New() const { return ClampFriction(stuck_, slip_moment_, about_); }
  /// One about the axes in which it acts, else zero.
  Eigen::Vector3d Axes() const {
    return about_ == About::kBending ? Eigen::Vector3d(1, 1, 0) : Eigen::Vector3d(0, 0, 1);
  }
  /// Of the spring if nothing slipped. A disc may turn round and round: its psi jumps by 2 pi where
  /// the spring does not.
  Eigen::Vector3d Trial(const Eigen::Vector3d& psi) const {
    if (about_ == About::kBending) return stuck_ * (psi - slip_).cwiseProduct(Axes());
    return {0, 0, stuck_ * std::remainder(psi.z() - slip_.z(), 2 * M_PI)};
  }

  double stuck_, slip_moment_;
  About about_;
  Eigen::Vector3d slip_ = Eigen::Vector3d::Zero();  // p [rad]
};

}  // namespace cosserat_cable::rod
