#pragma once

#include <cmath>
#include <memory>
#include <string>

#include "effects/kinds.h"
#include "oscillation.h"
#include "rigs.h"
#include "statics.h"

namespace cosserat_cable::generator {

/// A slender cable that swings at 9 Hz, for tests of effects.
inline CableData effectCable() {
  CableData c;
  c.length = 0.3;
  c.diameter = 2e-3;
  c.rhoA = 0.05;
  c.EI = 0.101;
  c.GJ = 0.08;
  c.eta_EI = 0.0;
  c.eta_GJ = 0.0;
  return c;
}

/// An effect with these values, in a record of `duration` of that cable.
inline std::shared_ptr<Effect> effectOf(const EffectKind& kind, const EffectValues& values,
                                        double duration = 1.0, bool disc = false) {
  EffectSite site;
  site.cable = effectCable();
  site.duration = duration;
  site.disc = disc;
  return kind.make(values, site);
}

/// The rod of that cable without gravity and without the losses of stretch and shear.
inline RodDynamics weightlessRod(const CableData& cable = effectCable()) {
  Rod rod = makeRod(cable);
  rod.V_F.setZero();
  RodDynamics dynamics(rod, Resolution());
  dynamics.gravity.setZero();
  return dynamics;
}

/// A torsional pendulum of that cable without gravity, let go at `angle`; with so much eta_GJ that
/// the cable's own torsional waves are soon gone.
inline Experiment pendulum(double angle, double duration, double dt) {
  Experiment e;
  e.name = "torsion";
  e.cable = effectCable();
  e.cable.eta_GJ = 4e-6;
  e.gravity.setZero();
  Disc disc;
  disc.inertia = 2e-5;
  disc.mass = 0.02;
  e.disc = disc;
  e.guided = true;
  e.twisted = angle;
  e.channels = {{"angle", e.cable.length, Channel::Quantity::kAngle, 2}};
  e.times = Eigen::VectorXd::LinSpaced(std::lround(duration / dt) + 1, 0.0, duration);
  return e;
}

/// Inertia of the pendulum's disc with the cable's share.
inline double pendulumInertia(const Experiment& e) {
  return e.disc->inertia + makeRod(e.cable).rhoJ[2] * e.cable.length / 3.0;
}

/// Decay [1/s] of the pendulum by eta_GJ.
inline double pendulumDecay(const Experiment& e) {
  return e.cable.eta_GJ / (2.0 * e.cable.length * pendulumInertia(e));
}

/// A small ring-down of that cable without gravity, along x.
inline Experiment smallRingdown(double amplitude, double duration, double dt) {
  Experiment e;
  e.name = "ringdown";
  e.cable = effectCable();
  e.cable.eta_EI = 1e-6;  // the first mode loses 0.2 % a cycle, and the fourth is gone soon
  e.gravity.setZero();
  e.held = pulledEnd(e, Eigen::Vector3d::UnitX(), amplitude * e.cable.length);
  e.channels = {{"tip_x", e.cable.length, Channel::Quantity::kPosition, 0}};
  e.times = Eigen::VectorXd::LinSpaced(std::lround(duration / dt) + 1, 0.0, duration);
  return e;
}

}  // namespace cosserat_cable::generator
