// A law beside the Kelvin-Voigt elements of a section, with internal variables of its own.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "cosserat_cable/math/state_archive.h"

namespace cosserat_cable::rod {

/// Strains of an element and their rates, along or about the section's axes: force strain Gamma [1]
/// and curvature K [1/m], less the unstressed ones.
struct ElementStrain {
  Eigen::Vector3d gamma, gamma_dot;
  Eigen::Vector3d kappa, kappa_dot;
};

/// A value per component: along the section's axes for forces F, about them for moments M.
struct SectionValue {
  Eigen::Vector3d F = Eigen::Vector3d::Zero();
  Eigen::Vector3d M = Eigen::Vector3d::Zero();

  SectionValue& operator+=(const SectionValue& other) {
    F += other.F;
    M += other.M;
    return *this;
  }
};

/// Over one step the stress that a branch adds is linear in the strain at the step's end:
///
///     stress = Offset(element) + StepStiffness() strain
///
/// which a law with internal variables gets by integrating them over the step for a strain that
/// goes straight from its old to its new value. That is second order, and the tangent is exact.
class SectionBranch {
 public:
  virtual ~SectionBranch() = default;
  virtual std::unique_ptr<SectionBranch> Clone() const = 0;
  /// Of all internal variables; of what BeginStep sets, nothing.
  virtual void ExchangeState(StateArchive* state) = 0;

  /// Makes room for the internal variables.
  virtual void SetElements(int elements) = 0;
  /// Prepares a step of `dt` [s].
  virtual void BeginStep(double dt) = 0;
  virtual SectionValue StepStiffness() const = 0;      ///< [N], [N m^2]
  virtual SectionValue Offset(int element) const = 0;  ///< [N], [N m]
  /// The step begun ends with this strain.
  virtual void Commit(int element, const ElementStrain& strain) = 0;
  /// Takes the state after a long rest under this strain.
  virtual void Rest(int element, const ElementStrain& strain) = 0;

  /// Stiffness after a long rest [N], [N m^2].
  virtual SectionValue StaticStiffness() const = 0;
  /// Energy stored per length [J/m], and power dissipated per length [W/m], in the present state.
  virtual double Energy(int element) const = 0;
  virtual double DissipationRate(int element) const = 0;

  /// What the branch adds to the dynamic modulus of small strains that vary as exp(lambda t),
  /// beside the static stiffness: the sum of stiffness * lambda/(lambda + rate).
  struct Relaxation {
    SectionValue stiffness;  ///< [N], [N m^2]
    double rate;             ///< [1/s]
  };
  virtual std::vector<Relaxation> Relaxations() const = 0;
};

}  // namespace cosserat_cable::rod
