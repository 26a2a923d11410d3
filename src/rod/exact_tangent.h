// How an element's strains and forces change as its nodes move, by differences: exact however far
// the element is turned or pressed, and some hundred times as dear as EvaluateTangent.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "element_joint.h"
#include "step_workspace.h"

namespace cosserat_cable::rod {

/// By the displacements (world) and rotations (section frame) of both nodes: a column each.
using Matrix12 = Eigen::Matrix<double, 12, 12>;
using Matrix6By12 = Eigen::Matrix<double, 6, 12>;

/// An element between its nodes.
struct PlacedElement {
  const Node<double>&a, &b;
  ElementJoint<double> joint;
  Bowing<double> bowing;
  double h;  ///< [m]
};

/// Element `e` of the iterate at rest as `w.chain` saw it; `joints`: by node, none of a rod
/// without.
PlacedElement PlaceElement(const StepWorkspace<double>& w, const std::vector<Quat<double>>& joints,
                           int e);

/// Of the strains, times the element's length.
Matrix6By12 StrainDerivatives(const PlacedElement& element);

/// Of the forces, at constant force and moment of the section. Symmetric: the skew part adds up to
/// the moments that a node lacks to balance.
Matrix12 GeometricStiffness(const PlacedElement& element, const ElementStress& stress);

/// As AssembleTangent without rates, exact. `stiffening`: by element.
void AssembleExactTangent(const std::vector<Quat<double>>& joints,
                          const std::vector<Stiffening<double>>& stiffening,
                          StepWorkspace<double>* w);

}  // namespace cosserat_cable::rod
