// Rods and excitations that the literature has numbers for: what the tests hold to them, and what
// the figures of docs/validation.md show.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "rod/rod_cases.h"

namespace cosserat_cable::rod {

/// An inextensible, unshearable rod of length 1 without weight, as the elastica is.
inline RodModel InextensibleRod(double EI, int elements) {
  RodModel model = RoundCable(1.0, 0.01, 0.1, EI, 0.75 * EI, 0, 0, elements);
  model.section.C_F.setConstant(1e6);
  model.gravity.setZero();
  return model;
}

/// An eighth of a circle of radius 100 in the x-y plane, clamped at the origin along y, bending
/// towards x (Bathe and Bolourchi 1979).
inline Rod FortyFiveDegreeBend(int elements) {
  constexpr double kRadius = 100, kAngle = M_PI / 4;
  RodModel model;
  model.length = kRadius * kAngle;
  model.elements = elements;
  model.section.C_F = {5e6, 5e6, 1e7};
  model.section.C_M = {1e7 / 12, 1e7 / 12, 8.333e5};
  model.section.V_F.setZero();
  model.section.V_M.setZero();
  model.section.rhoA = 1;
  model.section.rhoJ.setOnes();
  model.section.kappa0 = {0, 1 / kRadius, 0};
  model.gravity.setZero();
  model.b = EndModel::Free();
  std::vector<Pose> nodes;
  for (int i = 0; i <= elements; ++i) {
    const double phi = kAngle * i / elements;
    Eigen::Matrix3d R;
    R.col(2) = Eigen::Vector3d(std::sin(phi), std::cos(phi), 0);
    R.col(0) = Eigen::Vector3d(std::cos(phi), -std::sin(phi), 0);
    R.col(1) = R.col(2).cross(R.col(0));
    nodes.push_back({Eigen::Vector3d(kRadius * (1 - std::cos(phi)), kRadius * std::sin(phi), 0),
                     Eigen::Quaterniond(R)});
  }
  Rod rod(model);
  rod.SetConfiguration(nodes);
  return rod;
}

/// A rubber rod of length 1 along x, pinned at the origin, at rest (Lang, Linn and Arnold 2011).
inline Rod RubberRodPendulum(int elements) {
  constexpr double kRadius = 5e-3, kE = 5e6, kG = kE / 3, kRho = 1100;
  const double A = M_PI * kRadius * kRadius, I = A * kRadius * kRadius / 4;
  RodModel model;
  model.length = 1;
  model.elements = elements;
  model.section.C_F = {kG * A, kG * A, kE * A};
  model.section.C_M = {kE * I, kE * I, 2 * kG * I};
  model.section.V_F.setZero();
  model.section.V_M.setZero();
  model.section.rhoA = kRho * A;
  model.section.rhoJ = {kRho * I, kRho * I, 2 * kRho * I};
  model.a = EndModel::Pinned();
  model.b = EndModel::Free();
  Rod rod(model);
  rod.SetConfiguration(
      StraightShape(Facing(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()), 1.0, elements));
  return rod;
}

/// The source paper's excitation: an arch of 200 mm between parallel clamps 100 mm apart, on a body
/// that is swept from 10 to 38 Hz in 7 s with A = 1.5 mm.
struct Sweep {
  double EI, rhoA, eta_EI;
  Eigen::Vector3d axis;
  int elements = 40;
  double dt = 1e-3;

  static constexpr double kAmplitude = 1.5e-3, kStart = 10, kRate = 2;

  /// Calls `observe(t, apex along the axis in the world frame [m])` after each step until `end`
  /// [s].
  template <class Observer>
  void Run(double end, Observer observe) const {
    const RodModel model =
        RoundCable(0.2, 0.008, rhoA, EI, 0.75 * EI, eta_EI, eta_EI / 2, elements);
    const Pose a = Facing(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ());
    const Pose b{{0.1, 0, 0},
                 Eigen::Quaterniond(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitY()))};
    Rod rod(model);
    rod.SetConfiguration(BowedShape(a, b, 0.2, elements, model.gravity));
    if (!rod.Equilibrate().converged) throw std::runtime_error("no equilibrium");
    Motion start;
    start.v = kAmplitude * 2 * M_PI * kStart * axis;
    start.a = kAmplitude * 4 * M_PI * kRate * axis;
    rod.AddRigidMotion(start);
    for (int k = 1; k * dt <= end + 0.5 * dt; ++k) {
      const double t = k * dt, phase = 2 * M_PI * (kStart + kRate * t) * t;
      const auto clamp = [&](Pose X) {
        X.p += kAmplitude * std::sin(phase) * axis;
        return X;
      };
      if (!rod.Step(dt, clamp(a), clamp(b)).converged) throw std::runtime_error("no convergence");
      observe(t, rod.pose(elements / 2).p.dot(axis));
    }
  }

  double ApexAt(double time) const {
    double last = 0;
    Run(time, [&](double, double x) { last = x; });
    return last;
  }

  /// From one extreme of the apex to the next: the time between them [s], half the way [m].
  struct Swing {
    double t, size;
  };
  std::vector<Swing> Swings(double end) const {
    std::vector<Swing> swings;
    double before = 0, last = 0, extreme = 0, when = 0;
    Run(end, [&](double t, double x) {
      if ((last - before) * (x - last) < 0) {
        // Vertex of the parabola through three samples.
        const double curvature = before - 2 * last + x, slope = 0.5 * (x - before);
        const double vertex = last - 0.5 * slope * slope / curvature;
        const double at = t - dt - slope / curvature * dt;
        if (when > 0) swings.push_back({0.5 * (at + when), 0.5 * std::abs(vertex - extreme)});
        extreme = vertex;
        when = at;
      }
      before = last;
      last = x;
    });
    return swings;
  }

  /// Half the peak-to-peak of the apex within a period around each time [m].
  std::vector<double> ApexAmplitudes(const std::vector<double>& times) const {
    std::vector<double> low(times.size(), 1e9), high(times.size(), -1e9), amplitudes;
    Run(*std::max_element(times.begin(), times.end()) + 0.03, [&](double t, double x) {
      for (std::size_t i = 0; i < times.size(); ++i)
        if (std::abs(t - times[i]) < 0.03) {
          low[i] = std::min(low[i], x);
          high[i] = std::max(high[i], x);
        }
    });
    for (std::size_t i = 0; i < times.size(); ++i) amplitudes.push_back(0.5 * (high[i] - low[i]));
    return amplitudes;
  }
};

}  // namespace cosserat_cable::rod
