// Rods that several tests share.
#pragma once

#include <cmath>
#include <vector>

#include "cosserat_cable/math/rotation.h"
#include "cosserat_cable/rod/initial_shape.h"
#include "cosserat_cable/rod/rod.h"

namespace cosserat_cable::rod {

/// Constant forces on every node.
class NodeForces : public Load {
 public:
  explicit NodeForces(std::vector<Vec3<double>> forces) : forces_(std::move(forces)) {}
  void Evaluate(const Centreline& rod, LoadSink* sink) const override {
    for (int e = 0; e < rod.elements(); ++e) sink->AddForce(e, 1.0, forces_[e + 1], {}, {});
  }
  double Energy(const Centreline& rod) const override {
    double energy = 0;
    for (int i = 1; i <= rod.elements(); ++i) energy -= Dot(forces_[i], rod.position(i));
    return energy;
  }

 private:
  std::vector<Vec3<double>> forces_;
};

/// First bending mode of a clamped-free beam, at x = s/L; 2 at the tip.
inline double CantileverMode(double x) {
  constexpr double kMu = 1.8751040687;
  const double sigma = (std::cosh(kMu) + std::cos(kMu)) / (std::sinh(kMu) + std::sin(kMu));
  return std::cosh(kMu * x) - std::cos(kMu * x) - sigma * (std::sinh(kMu * x) - std::sin(kMu * x));
}

/// Round isotropic cable with the defaults of the measurement format: EA = 16 EI/d^2, GA = EA/3,
/// critical damping of stretching and shearing.
inline RodModel RoundCable(double length, double diameter, double rhoA, double EI, double GJ,
                           double eta_EI, double eta_GJ, int elements) {
  RodModel rod;
  rod.length = length;
  rod.elements = elements;
  const double EA = 16 * EI / (diameter * diameter), GA = EA / 3;
  const double rhoI = rhoA * diameter * diameter / 16;
  const double eta_GA = 2 * std::sqrt(rhoI * GA);
  rod.section.C_F = {GA, GA, EA};
  rod.section.C_M = {EI, EI, GJ};
  rod.section.V_F = {eta_GA, eta_GA, 4 * length / M_PI * std::sqrt(rhoA * EA)};
  rod.section.V_M = {eta_EI, eta_EI, eta_GJ};
  rod.section.rhoA = rhoA;
  rod.section.rhoJ = {rhoI, rhoI, 2 * rhoI};
  return rod;
}

inline Pose Facing(const Eigen::Vector3d& p, const Eigen::Vector3d& a3) {
  return {p, ShortestTurn(Eigen::Vector3d::UnitZ(), a3)};
}

}  // namespace cosserat_cable::rod
