#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>

#include "measurement_set.h"

namespace cosserat_cable::generator {

// What sample sets are put together from.

constexpr double kJitter = 0.2;  ///< of the sampling period

/// First bending mode [rad/s] of a clamped-free cable, straight, without gravity.
double bendingFrequency(const CableData& c);

/// A frame whose a3 points along `axis`, rolled at random.
Eigen::Matrix3d frameAlong(const Eigen::Vector3d& axis, Random* random);

/// A place [m] for clamp a.
Eigen::Vector3d anyPlace(Random* random);

/// Positions of the tip and of one point within, all axes.
void addPositions(double inner, Experiment* e);

/// @param tilt of the clamp's axis from straight down [rad].
/// @param amplitude of the tip, in lengths.
/// @param roll direction of the pull from a1 [rad]; at random where it is not a number.
Experiment ringdown(const std::string& name, const CableData& cable, double tilt, double amplitude,
                    double duration, Random* random, double roll = std::nan(""));

/// Adds a velocity along the world axis in which the end starts nearest to the clamp. Not an
/// acceleration: at the release it is a wave front, which no model of a rod resolves.
void addVelocity(Experiment* e);

Experiment torsion(const std::string& name, const CableData& cable, double length, const Disc& disc,
                   bool guided, double duration, Random* random);

/// A clamp that hangs down with a tilt, shaken across: at an angle `roll` from a1 [rad].
Experiment driven(const std::string& name, const CableData& cable, double tilt, double roll,
                  const std::vector<ExcitationLine>& lines, double duration, Random* random);

/// An arch that hangs between clamps half a length apart, both tangents vertical; a is swept in its
/// plane or across it, about the first mode of either. Its `times` are for the caller to fill.
Experiment arch(const std::string& name, const CableData& cable, bool across, double duration,
                Random* random);

/// Equilibria of a hanging cable under a force at its tip that goes to and fro twice along a1
/// (plane 0) or a2 (1), up to `largest` times EI/L^2.
Experiment slowBend(const std::string& name, const CableData& cable, int plane, double largest,
                    Random* random);

/// Mass of a disc of this inertia that stretches the cable by 1 % at most.
double discMass(double inertia, const CableData& cable, Random* random);

/// What the set says of EI and GJ: wrong by up to a quarter.
void guess(MeasurementSet* set, Random* random);

MeasurementSet newSet(const std::string& rig, std::uint64_t seed, double snr);

/// A cable that holds itself up well enough, and swings at 2 to 20 Hz.
CableData randomCable(Random* random);

/// A disc that turns at 3.5 to 6 Hz at mid length; sets the cable's [eta_GJ] for a damping ratio of
/// 0.01 to 0.1 there.
Disc randomDisc(CableData* cable, double mid_length, Random* random);

double ringdownTime(const CableData& cable);
double torsionTime(const CableData& cable, double length, const Disc& disc);

}  // namespace cosserat_cable::generator
