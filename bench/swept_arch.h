// The case of the comparison: an arch of cable between parallel clamps that are swept in its plane,
// from 10 to 38 Hz in 7 s with an amplitude of 1.5 mm, under gravity.
#pragma once

#include <cmath>
#include <stdexcept>

#include "rod/rod_cases.h"

namespace cosserat_cable::bench {

struct SweptArch {
  double EI = 0.012;     // N m^2
  double rhoA = 0.09;    // kg/m
  double eta_EI = 2e-4;  // N m^2 s

  static constexpr double kLength = 0.2, kDiameter = 0.008, kSpan = 0.1;  // m
  static constexpr double kAmplitude = 1.5e-3;                            // m, along x
  static constexpr double kStart = 10, kRate = 2;                         // Hz, Hz/s
  static constexpr double kDuration = 7;                                  // s

  static double Phase(double t) { return 2 * M_PI * (kStart + kRate * t) * t; }  // rad
  static double Shift(double t) { return kAmplitude * std::sin(Phase(t)); }      // m
  static double StartVelocity() { return kAmplitude * 2 * M_PI * kStart; }       // m/s
  static double StartAcceleration() { return kAmplitude * 4 * M_PI * kRate; }    // m/s^2

  static Pose ClampA(double shift) { return {{shift, 0, 0}, Eigen::Quaterniond::Identity()}; }
  static Pose ClampB(double shift) {
    return {{kSpan + shift, 0, 0},
            Eigen::Quaterniond(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitY()))};
  }

  double GJ() const { return 0.75 * EI; }         // N m^2
  double eta_GJ() const { return 0.5 * eta_EI; }  // N m^2 s

  /// Stretch and shear a hundred times stiffer than a round cable's, with critical damping: the
  /// equations that a chain of rigid pieces solves as well.
  rod::RodModel Model(int elements) const {
    constexpr double kStiffer = 100;
    rod::RodModel model =
        rod::RoundCable(kLength, kDiameter, rhoA, EI, GJ(), eta_EI, eta_GJ(), elements);
    model.section.C_F *= kStiffer;
    model.section.V_F *= std::sqrt(kStiffer);
    return model;
  }
};

/// A rod of the arch's length at rest between the clamps.
inline rod::Rod Settled(const rod::RodModel& model) {
  rod::Rod rod(model);
  rod.SetConfiguration(rod::BowedShape(SweptArch::ClampA(0), SweptArch::ClampB(0), model.length,
                                       model.elements, model.gravity));
  if (!rod.Equilibrate().converged) throw std::runtime_error("the arch found no rest");
  return rod;
}

}  // namespace cosserat_cable::bench
