#include "pull.h"

#include <algorithm>
#include <cmath>

#include "cosserat_cable/math/small_eigen.h"
#include "cosserat_cable/rod/element_curve.h"

namespace cosserat_cable {
namespace {

// The spring's force takes the gap that is left into account, and the gap shrinks by the ratio of
// the rod's stiffness to the spring's with each round.
constexpr double kSpringRatio = 1e2;
constexpr int kMaxRounds = 30;
constexpr double kMaxStride = 0.05;  // of the length, between two equilibria on the way

struct Place {
  int element;
  double xi;
};

Place PlaceOf(double s, const rod::Rod& rod) {
  const double x = s / rod.model().length * rod.elements();
  const int element = std::clamp(static_cast<int>(x), 0, rod.elements() - 1);
  return {element, x - element};
}

/// Augmented Lagrangian of "this point is there": force + stiffness * gap.
class Spring : public rod::Load {
 public:
  Spring(const Place& place, double stiffness) : place_(place), stiffness_(stiffness) {}

  void Evaluate(const rod::Centreline& rod, rod::LoadSink* sink) const override {
    const Vec3<double> force = ToSmall(force_ + stiffness_ * Gap(rod));
    Mat3<double> by_position{};
    for (int k = 0; k < 3; ++k) by_position[k][k] = -stiffness_;
    sink->AddForce(place_.element, place_.xi, force, by_position, Mat3<double>{});
  }
  double Energy(const rod::Centreline& rod) const override {
    const Eigen::Vector3d gap = Gap(rod);
    return force_.dot(gap) + 0.5 * stiffness_ * gap.squaredNorm();
  }

  Eigen::Vector3d PointOfChord(const rod::Centreline& rod) const {
    return (1 - place_.xi) * ToEigen(rod.position(place_.element)) +
           place_.xi * ToEigen(rod.position(place_.element + 1));
  }
  Eigen::Vector3d Gap(const rod::Centreline& rod) const { return target - PointOfChord(rod); }
  /// The spring's force at this gap becomes the constant part.
  void TakeUp(const rod::Centreline& rod) { force_ += stiffness_ * Gap(rod); }

  Eigen::Vector3d target;

 private:
  Place place_;
  double stiffness_;
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
};

}  // namespace

Eigen::Vector3d PointOn(const rod::Rod& rod, double s) {
  const auto [e, u] = PlaceOf(s, rod);
  return rod::ElementCurve(rod, e).At(u).p;
}

bool PullTo(const PointAt& target, double closed, rod::Rod* rod) {
  const double length = rod->model().length;
  const double stretching = rod->model().section.C_F.z() / length;  // [N/m]
  Spring spring(PlaceOf(target.s, *rod), kSpringRatio * stretching);
  spring.target = target.position_W;
  const Eigen::Vector3d way = spring.Gap(*rod);
  const int strides = std::max(1, static_cast<int>(std::ceil(way.norm() / (kMaxStride * length))));
  // Strides and gaps are small: the detour by way of softer rods is for those that lose their way.
  const auto follow = [&] {
    return rod->EquilibrateNearby(&spring).converged || rod->Equilibrate(&spring).converged;
  };
  for (int k = 1; k < strides; ++k) {
    spring.target = target.position_W - way * (1.0 - static_cast<double>(k) / strides);
    if (!follow()) return false;
    spring.TakeUp(*rod);
  }
  spring.target = target.position_W;
  for (int round = 0; round < kMaxRounds; ++round) {
    if (!follow()) return false;
    const Eigen::Vector3d gap = target.position_W - PointOn(*rod, target.s);
    if (gap.norm() < closed * length) return true;
    spring.TakeUp(*rod);
    // The spring holds the chord's point, which lies beside the curve's.
    spring.target = target.position_W + spring.PointOfChord(*rod) - PointOn(*rod, target.s);
  }
  return false;
}

}  // namespace cosserat_cable
