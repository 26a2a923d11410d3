// Experiments for tests, without files.
#pragma once

#include <cmath>

#include "cosserat_cable/measurement/experiment_simulation.h"

namespace cosserat_cable::testing {

constexpr double kPi = 3.14159265358979323846;

/// A cable of length 0.25 m, its first bending at 2.1 Hz.
inline Specimen CableSpecimen() {
  Specimen specimen;
  CableModel& m = specimen.cable;
  m.length = 0.25;
  m.diameter = 0.006;
  m.mass_per_length = 0.05;
  m.EI1 = m.EI2 = 0.0027;
  m.GJ = 0.002;
  m.EA = 16 * m.EI1 / (m.diameter * m.diameter);
  m.GA1 = m.GA2 = m.EA / 3;
  m.eta_EI1 = m.eta_EI2 = 6e-6;
  m.eta_GJ = 4e-6;
  m.eta_EA = 4 * m.length / kPi * std::sqrt(m.mass_per_length * m.EA);
  m.eta_GA1 = m.eta_GA2 = 2 * std::sqrt(m.rhoI() * m.GA1);
  return specimen;
}

/// A channel at s [m].
inline Channel ChannelAt(double s, Quantity quantity, int axis = 0) {
  Channel channel;
  channel.column = ToString(quantity);
  channel.s = s;
  channel.quantity = quantity;
  channel.axis = axis;
  return channel;
}

inline void SampleEvenly(double duration, int count, Experiment* experiment) {
  for (int i = 0; i < count; ++i) experiment->record.t.push_back(duration * i / (count - 1));
}

/// The cable along x from the origin, without gravity, its end pulled by `deflection` [m] along z
/// and let go.
inline Experiment RingDown(double deflection, double duration, int count) {
  Experiment experiment;
  experiment.name = "ringdown";
  experiment.gravity_W.setZero();
  experiment.a.pose.q = Eigen::AngleAxisd(kPi / 2, Eigen::Vector3d::UnitY());
  experiment.b.kind = EndCondition::Kind::kFree;
  experiment.start.kind = StartCondition::Kind::kHeld;
  const double L = CableSpecimen().cable.length;
  experiment.start.held.s = L;
  // Where the end of a bent cantilever is: 3 w^2/(5 L) short of L.
  experiment.start.held.position_W = {L - 0.6 * deflection * deflection / L, 0, deflection};
  experiment.channels = {ChannelAt(L, Quantity::kPosition, 2)};
  SampleEvenly(duration, count, &experiment);
  return experiment;
}

/// A guided disc of this inertia [kg m^2] on the cable, twisted by `angle` [rad] and let go.
inline Experiment Torsion(double inertia, double angle, double duration, int count) {
  Experiment experiment;
  experiment.name = "torsion";
  experiment.b.kind = EndCondition::Kind::kDisc;
  experiment.b.disc = {inertia, 0.05, true};
  experiment.a.pose.q = Eigen::Quaterniond(0, 1, 0, 0);  // hanging
  experiment.start.kind = StartCondition::Kind::kTwisted;
  experiment.start.twisted = angle;
  experiment.channels = {ChannelAt(CableSpecimen().cable.length, Quantity::kAngle)};
  SampleEvenly(duration, count, &experiment);
  return experiment;
}

}  // namespace cosserat_cable::testing
