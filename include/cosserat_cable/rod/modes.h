// Natural modes of a rod: frequencies, damping and shapes of small motion about its equilibrium.
#pragma once

#include <complex>
#include <vector>

#include "cosserat_cable/rod/rod.h"

namespace cosserat_cable::rod {

enum class ModeKind { kInPlane, kOutOfPlane, kTorsion, kAxial };

/// "in plane", "out of plane", "torsion" or "axial".
const char* ToString(ModeKind kind);

/// One mode. SI units; vectors in the world's axes.
///
/// Without damping it swings with the angular frequency w in the shape given. With damping it goes
/// as exp(lambda t): it oscillates where lambda is complex, and creeps back where it is real.
struct Mode {
  double w = 0;  ///< undamped angular frequency [rad/s]; 0 of a rigid or an unstable motion

  /// The root that carries most of the motion after a release from a pull [1/s]. Complex: the one
  /// with positive imaginary part. Real: the slow one, or the one that grows.
  std::complex<double> lambda;
  /// Complex lambda: its conjugate. Real lambda: the other root that carries most of the motion
  /// after a blow; not always real, for where the viscosity of bending forbids fast bending, shear
  /// swings. Modes that creep share their roots: where twist relaxes at another rate than bending,
  /// one shape comes back at several rates.
  std::complex<double> second;

  /// Damping ratio. Oscillating: -Re(lambda)/|lambda|. Creeping: 1 or, where it is more, the energy
  /// lost in a cycle with this shape at frequency w, by 4 pi times the largest elastic energy,
  /// which is w eta/(2 EI) for pure bending: how far above critical the mode is damped. 0 where w
  /// is 0.
  double zeta = 0;

  ModeKind kind = ModeKind::kInPlane;
  /// Shares of the kinetic energy in each direction, and of turning about the rod's axis; their sum
  /// is 1. The plane is the one that the rod comes nearest to lying in; of a straight rod, the one
  /// with gravity in it (with the first node's a1, where gravity points along the rod).
  double in_plane = 0, out_of_plane = 0, torsion = 0;
  /// Shares of the elastic energy; their sum is 1 (0 of a rigid motion).
  double bending = 0, twist = 0, stretch = 0, shear = 0;

  /// Shape without damping, a value per node: displacement [m] and rotation vector [rad]. The
  /// largest displacement is 1 m in length; of a mode of kind kTorsion, which may leave the
  /// centreline where it is, the largest rotation is 1 rad instead. The node where it is largest
  /// moves (turns) along the positive side of its largest component.
  std::vector<Eigen::Vector3d> displacement, rotation;

  bool oscillates() const { return lambda.imag() > 0; }
  bool unstable() const { return lambda.real() > 0; }
  double w_damped() const { return lambda.imag(); }  ///< [rad/s]
};

/// The modes with the `count` lowest undamped frequencies (fewer of a rod with fewer unknowns),
/// ascending, of the rod at its present configuration, which must be an equilibrium under `load`;
/// velocities are ignored, what the clamps hold stays. A mode's kind is kAxial where stretching
/// stores more than half of the elastic energy, else where most of the kinetic energy is.
///
/// The roots are those of the rod's own equations of small motion, (lambda^2 M + K(lambda)) x = 0
/// with the dynamic modulus of every section component: what a simulation with short steps shows.
/// @throws std::runtime_error where the iterations do not converge
std::vector<Mode> FindModes(const Rod& rod, int count, const Load* load = nullptr);

}  // namespace cosserat_cable::rod
