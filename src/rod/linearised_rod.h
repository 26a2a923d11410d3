// Small motion about an equilibrium: (lambda^2 M + K(lambda)) x = 0 for x exp(lambda t).
//
// K(lambda) = K_g + lambda D + sum_i k_i(lambda)/C_i K_i with the stiffness K_g of stresses and
// loads, the damping D of loads, and for each of the six section components the stiffness K_i that
// it has at rest and its dynamic modulus k_i. x: six unknowns per node, displacement in the world's
// axes [m] and rotation in the section's [rad]; at an end that a clamp holds in part, displacement
// in the clamp's axes and that of its psi (end_model.h). What is held has rows and columns of
// zeros.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "cosserat_cable/rod/load.h"
#include "cosserat_cable/rod/section_law.h"
#include "dynamic_modulus.h"
#include "end_part.h"
#include "step_workspace.h"
#include "symmetric_bands.h"

namespace cosserat_cable::rod {

struct LinearisedRod {
  enum Component { kShear1, kShear2, kStretch, kBend1, kBend2, kTwist, kComponents };

  /// At the iterate of `w`, which is an equilibrium under its static law and `load`. `held`: by
  /// unknown; `stiffening`: by element, what is in that law; `tangents`: by element, that of the
  /// section's other laws, none where it has none. Overwrites the law, the right-hand side and the
  /// system of `w`.
  LinearisedRod(const std::array<DynamicModulus, kComponents>& moduli,
                const std::vector<Quat<double>>& joints, const EndParts& ends,
                const std::vector<Stiffening<double>>& stiffening,
                const std::vector<SectionMatrix>& tangents, const std::vector<bool>& held,
                const Load* load, StepWorkspace<double>* w);

  int unknowns() const { return static_cast<int>(held.size()); }
  /// K(0).
  SymmetricBands Stiffness() const;

  /// Of a node, in the world's axes [m].
  Eigen::Vector3d Displacement(const Eigen::VectorXd& x, int node) const;
  /// Of a node, in its section's axes [rad].
  Eigen::Vector3d Rotation(const Eigen::VectorXd& x, int node) const;

  std::vector<bool> held;
  Eigen::VectorXd mass;  ///< M, diagonal [kg], [kg m^2]
  SymmetricBands geometric, load_damping;
  std::vector<SymmetricBands> material;  ///< K_i
  /// By component, what the section's other laws add to K(lambda), whatever lambda; none where it
  /// has none.
  std::vector<SymmetricBands> laws;
  std::array<DynamicModulus, kComponents> moduli;
  /// Displacement by the end nodes' first three unknowns, and rotation by the last three.
  Eigen::Matrix3d move_a, move_b, turn_a, turn_b;
};

}  // namespace cosserat_cable::rod
