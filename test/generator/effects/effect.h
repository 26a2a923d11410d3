#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "../frame_motion.h"
#include "../rod.h"
#include "../rod_shape.h"

namespace cosserat_cable::generator {

/// Curvatures of the sections at the rod's nodes, section components.
struct SectionState {
  double t = 0.0;
  bool settled = false;  ///< quasi-static: whatever relaxes has relaxed
  const Points& K;       ///< [1/m]
  const Points& Kd;      ///< [1/(m s)]
};

/// Stations along the axis at which loads act, world axes.
struct StationState {
  double t = 0.0;
  const Eigen::VectorXd& s;  ///< [m]
  const Points& position;    ///< [m]
  const Points& velocity;    ///< [m/s]
  const Points& tangent;     ///< r', not normalised
  const FrameMotion& clamp;  ///< of end a
  bool settled = false;      ///< quasi-static
};

/// How far a clamp's section is turned against the clamp: rotation vector in the clamp's frame.
struct ClampTurn {
  Eigen::Vector3d angle = Eigen::Vector3d::Zero();  ///< [rad]
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();   ///< [rad/s]
};

/// A cause that the plain rod lacks: what it adds to the equations of motion, to the clamp's motion
/// or to the record. A law with memory answers from the state of the last commit(); it must depend
/// on that state and on what it is given only, so that a step can be tried again.
class Effect {
 public:
  virtual ~Effect() = default;

  // ---- Equations of motion ----
  /// Whether addMoments does anything.
  virtual bool bends() const { return false; }
  /// Adds moments [N m] in section components at the nodes. A node's depends on that node only.
  virtual void addMoments(const SectionState&, Points* /*M*/) const {}

  /// How many stations addForces asks for at least, evenly spread; 0: it does nothing.
  virtual int stations() const { return 0; }
  /// Adds forces per length [N/m], world axes.
  virtual void addForces(const StationState&, Points* /*force*/) const {}

  /// Whether the clamp at end a (0) or b (1) gives way in bending, in torsion.
  virtual bool bendsClamp(int /*end*/) const { return false; }
  virtual bool twistsClamp(int /*end*/) const { return false; }
  /// Adds the moment [N m] with which the clamp resists its turn, clamp components.
  virtual void addClampMoment(int /*end*/, const ClampTurn&, Eigen::Vector3d* /*moment*/) const {}

  /// The end of a step becomes history; `turns` of ends a and b.
  virtual void commit(const SectionState&, const ClampTurn* /*turns*/) {}
  virtual void commitLoads(const StationState&) {}
  /// Whether Newton's method meets kinks.
  virtual bool abrupt() const { return false; }
  /// Twist of the unstressed rod [rad/m]: angles count from it.
  virtual double unstressedTwist() const { return 0.0; }
  /// Changes the rod before it is made.
  virtual void equip(CableData*) const {}
  /// A dashpot [N m s] about the axis between a disc at end b and the world.
  virtual double discDashpot() const { return 0.0; }

  // ---- Faults of the record ----
  /// What the clamp does where its motion file says `told`; the record lasts until `end` [s].
  virtual FrameCurve clampMotion(int /*end_of_rod*/, const FrameCurve& told, double /*end*/,
                                 bool /*moves*/) const {
    return told;
  }
  /// Time of the motion at the record's time.
  virtual double motionTime(double t) const { return t; }
  /// Whether sense() does anything.
  virtual bool senses() const { return false; }
  /// Changes samples at even spacing dt [s]; three columns (x, y, z) per vector, one per scalar.
  virtual void sense(double /*dt*/, Eigen::Ref<Eigen::MatrixXd> /*samples*/) const {}
};

/// Numbers of an effect by their path below its name, as in a cable's file.
using EffectValues = std::map<std::string, double>;

/// What the default size of an effect is measured by.
struct EffectScale {
  CableData cable;
  double shortest = 0.0;   ///< specimen of the set [m]
  double frequency = 0.0;  ///< of the first bending mode [rad/s]
  double torsion = 0.0;    ///< of the disc [rad/s]
  double amplitude = 0.1;  ///< of the larger ring-down, in lengths
  /// A plane that is hit by the larger ring-down only: direction of its normal from a1 in clamp
  /// a's frame [rad], how far behind the axis it is [m].
  double azimuth = 0.0, obstacle = 0.05;

  /// Curvature at the clamp of the larger ring-down [1/m].
  double curvature() const { return 3.0 * amplitude / cable.length; }
};

/// What an effect has to know of the experiment that it works in.
struct EffectSite {
  CableData cable;
  double duration = 0.0;  ///< of the record [s]
  bool disc = false;
};

/// One of the causes that can be switched on.
struct EffectKind {
  const char* name;  ///< as the library has it
  const char* path;  ///< of its entry in a file: extensions.NAME, faults.NAME
  /// Values of this size; at 0 the plain rod, at 1 strong but possible.
  EffectValues (*defaults)(const EffectScale& scale, double size);
  std::unique_ptr<Effect> (*make)(const EffectValues& values, const EffectSite& site);
};

/// An effect with its numbers.
struct EffectChoice {
  const EffectKind* kind = nullptr;
  double size = 1.0;
  EffectValues values;
};

/// The value at a path, 0 where there is none.
inline double valueOf(const EffectValues& values, const std::string& path) {
  const auto found = values.find(path);
  return found == values.end() ? 0.0 : found->second;
}

/// Stiffness of a clamp that gives way by `softness` as much as the rod itself; rigid (1e9 times)
/// where that is 0, so that a size of zero is the plain rod.
inline double clampStiffness(double own, double softness) {
  return own / std::max(std::abs(softness), 1e-7);
}

}  // namespace cosserat_cable::generator
