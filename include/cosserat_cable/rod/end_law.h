// What a clamp that gives way does to the end of a rod beside springs and dashpots: friction, play.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "cosserat_cable/math/state_archive.h"

namespace cosserat_cable::rod {

/// A moment against the rotation of the end's section in its clamp, as a function of the rotation
/// vector psi = log(R_C^T R) [rad] in the clamp's axes, its rate [rad/s], and internal variables of
/// its own. Several may act at one end: their moments add to each other and to EndModel's springs
/// and dashpots. Axes that the clamp holds have psi = 0 there; what a law has about them is without
/// effect.
///
/// The internal variables are those at the start of the step until Commit: the functions of psi
/// give what they come to when a step ends there, so that Newton's iteration may ask anywhere.
class EndLaw {
 public:
  struct Resistance {
    /// -moment acts on the section, conjugate to psi: its virtual work is -moment . delta psi
    /// [N m].
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    /// Its derivatives by psi [N m/rad] and by the rate [N m s/rad]: symmetric, not negative.
    Eigen::Matrix3d by_psi = Eigen::Matrix3d::Zero(), by_rate = Eigen::Matrix3d::Zero();

    Resistance& operator+=(const Resistance& other) {
      moment += other.moment;
      by_psi += other.by_psi;
      by_rate += other.by_rate;
      return *this;
    }
  };

  virtual ~EndLaw() = default;
  virtual std::unique_ptr<EndLaw> Clone() const = 0;
  /// Of all internal variables, where it has any.
  virtual void ExchangeState(StateArchive* /*state*/) {}

  /// Where a step ends at `psi`, turning with `rate`.
  virtual Resistance Resist(const Eigen::Vector3d& psi, const Eigen::Vector3d& rate) const = 0;
  /// Whose derivative is Resist(psi, 0).moment [J]: of a law with internal variables the
  /// incremental one, energy and dissipation together.
  virtual double Potential(const Eigen::Vector3d& psi) const = 0;
  /// The step ends here. Returns what the internal variables have turned into heat in it [J].
  virtual double Commit(const Eigen::Vector3d& psi) = 0;

  /// Of an end that has come to `psi` once, straight from zero. Those without internal variables do
  /// the same as ever.
  virtual Resistance ResistAtRest(const Eigen::Vector3d& psi) const {
    return Resist(psi, Eigen::Vector3d::Zero());
  }
  virtual double PotentialAtRest(const Eigen::Vector3d& psi) const { return Potential(psi); }
  /// Takes that state.
  virtual void Rest(const Eigen::Vector3d& psi) = 0;

  /// Whether it acts about the clamp's a3 alone: such a law stays where a disc takes the clamp's
  /// place.
  virtual bool InTorsionOnly() const { return false; }

  /// Stored, at the psi of the last Commit or Rest [J].
  virtual double Energy(const Eigen::Vector3d& psi) const = 0;
  /// Of what depends on the rate [W].
  virtual double DissipationRate(const Eigen::Vector3d& psi, const Eigen::Vector3d& rate) const {
    (void)psi, (void)rate;
    return 0;
  }
};

}  // namespace cosserat_cable::rod
