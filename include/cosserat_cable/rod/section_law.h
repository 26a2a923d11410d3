// A law beside the Kelvin-Voigt elements of a section whose stress need not be linear in the
// strain.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "cosserat_cable/math/state_archive.h"
#include "cosserat_cable/rod/section_branch.h"

namespace cosserat_cable::rod {

/// Components: forces along a1, a2, a3 with the strains Gamma - Gamma0, then moments about them
/// with the curvatures K - K0.
using SectionVector = Eigen::Matrix<double, 6, 1>;
using SectionMatrix = Eigen::Matrix<double, 6, 6>;

struct SectionResponse {
  SectionVector stress = SectionVector::Zero();   ///< [N], [N m]
  SectionMatrix tangent = SectionMatrix::Zero();  ///< by the strains, symmetric [N], [N m], [N m^2]
};

/// Evaluated at each iterate of a step or of statics, element by element, from internal variables
/// that change only when a step is accepted: a step that failed leaves no trace. The stress is the
/// gradient of an incremental potential (Ortiz and Stainier 1999), so that the tangent is symmetric
/// and statics can minimise.
///
/// A law that is linear over a step is a SectionBranch, which costs less.
class SectionLaw {
 public:
  virtual ~SectionLaw() = default;
  virtual std::unique_ptr<SectionLaw> Clone() const = 0;
  /// Of all internal variables, where it has any; of what BeginStep sets, nothing.
  virtual void ExchangeState(StateArchive* /*state*/) {}

  /// Whether it acts on or follows the force strains; a law of the curvatures alone costs less.
  virtual bool answers_to_gamma() const { return false; }

  /// Makes room for the internal variables of so many elements, as of a rod that was never
  /// strained.
  virtual void Reset(int elements) = 0;
  /// Prepares a step of `dt` [s]; infinity: statics.
  virtual void BeginStep(double /*dt*/) {}
  /// Adds stress and tangent at a strain of the step's end. `rate_by_strain` [1/s]: how the rate
  /// follows the strain in the time scheme.
  virtual void Evaluate(int element, const ElementStrain& strain, double rate_by_strain,
                        SectionResponse* sum) const = 0;
  /// What Evaluate's stress is the gradient of, at rest [J/m].
  virtual double Potential(int element, const ElementStrain& strain) const = 0;
  /// The step begun ends with this strain. Returns what the law has dissipated in it, per length
  /// [J/m].
  virtual double Commit(int element, const ElementStrain& strain) = 0;
  /// Takes the state of a section that has come to this strain once, straight from the unstressed
  /// one.
  virtual void Rest(int element, const ElementStrain& strain) = 0;

  /// Stored per length in the present state, which has this strain [J/m].
  virtual double Energy(int element, const ElementStrain& strain) const = 0;
  /// Tangent for small vibrations about the present state, which has this strain.
  virtual SectionMatrix SmallTangent(int element, const ElementStrain& strain) const = 0;
};

}  // namespace cosserat_cable::rod
