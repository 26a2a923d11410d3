// A rigid joint between the pieces of a rod: at its node the section's frame turns at once, so that
// the elements before and after it see different frames there.
#pragma once

#include "element_tangent.h"

namespace cosserat_cable::rod {

/// How the frames that an element sees are turned from those of its nodes: R_seen = R_node turn.
template <class T>
struct ElementJoint {
  Quat<T> first, second;
};

template <class To, class From>
ElementJoint<To> Converted(const ElementJoint<From>& joint) {
  return {Converted<To>(joint.first), Converted<To>(joint.second)};
}

/// The node as the element sees it.
template <class T>
Node<T> SeenThrough(const Quat<T>& turn, const Node<T>& node) {
  return {node.r, node.q * turn, node.v, TransposeTimes(ToMatrix(turn), node.omega)};
}

/// What the element exerts on its nodes, in their own frames.
template <class T>
void TurnBack(const ElementJoint<T>& joint, ElementForces<T>* forces) {
  forces->g1 = ToMatrix(joint.first) * forces->g1;
  forces->g2 = ToMatrix(joint.second) * forces->g2;
}

/// Likewise its derivatives by their rotations, phi_seen = turn^T phi_node.
template <class T>
void TurnBack(const ElementJoint<T>& joint, ElementTangent<T>* k) {
  const Mat3<T> J1 = ToMatrix(joint.first), J2 = ToMatrix(joint.second);
  const Mat3<T> J1_T = Transpose(J1), J2_T = Transpose(J2);
  k->r1 = k->r1 * J1_T;
  k->r2 = k->r2 * J2_T;
  k->t11 = J1 * k->t11 * J1_T;
  k->t12 = J1 * k->t12 * J2_T;
  k->t22 = J2 * k->t22 * J2_T;
}

}  // namespace cosserat_cable::rod
