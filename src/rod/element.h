// The two-node element of the geometrically exact (Simo-Reissner) rod.
//
// Strains live at the element's geodesic midpoint. With the relative rotation vector
// theta = log(R1^T R2), midpoint rotation Rm = R1 exp(theta/2) and chord = Rm^T (r2 - r1):
//
//     w = chord + a        a = h/24 (theta.theta e3 - theta_3 theta)        K = theta/h
//     h Gamma_1 = w_1      h Gamma_2 = w_2
//     h Gamma_3 = (1 - mu) chord_3 + mu |chord| + a_3
//
// so all are invariant under superposed rigid motions. By a an arc is longer than its chord: of a
// curvature that is constant along the element the part (K h)^2/24. Without it, an element that is
// bent would be taken for pressed, and the chain would need three times the elements.
//
// What an element seems to be sheared is for the part beta the S-shaped rest of its bending
// (shear_series.h). That leaves the centreline along the sections' normals, so that its length goes
// with the chord's, and makes it longer by a tenth of the angle's square: of beta = 1, mu = 6/5. If
// its stretch were that of the chord's part along a3, sections could turn away from a tension for
// 12 EI/h^2, and no element could carry more than that. Both are "bowing" in the theory of
// beam-columns; how it and the bending stiffness depend on the tension is in beam_column.h. The
// chord's length takes no part in how the nodes turn.
//
// e3 is Gamma_0 = (0, 0, 1) here, to which strains add what is small of fourth order. Rotations
// vary as R <- R exp([phi]x), phi in the section's own frame. Exactly (every matrix below is a
// function of [theta]x, so they commute):
//
//     delta theta = J2 phi2 - J1 phi1    J2 = I + [theta]x/2 + c [theta]x^2,  J1 = J2^T
//     phi_m       = P1 phi1 + P2 phi2    P2 = (I + tau [theta]x)/2,           P1 = P2^T
//     delta chord = Rm^T (dr2 - dr1) + chord x phi_m
//     delta a     = D delta theta        D = da/dtheta
//
// with x = tan(|theta|/4), A = atan(x)/x: tau = 1/(4A), c = (1 - (|theta|/2)
// cot(|theta|/2))/|theta|^2 = (1 - A(1-x^2))/(16 A^2 x^2). Strain rates are the same expressions
// with velocities in place of variations, hence objective. No trigonometry is needed: x = vec(q)/(1
// + q_w) of q = q1* q2.
#pragma once

#include "beam_column.h"
#include "rotation_kernel.h"

namespace cosserat_cable::rod {

/// Section law as the time step sees it: F = offset + C (Gamma - Gamma0) + V dGamma/dt, M = offset
/// + C K + V dK/dt. Internal variables, where a law has them, and the unstressed curvature are
/// condensed into an offset per element; C and V hold for a whole rod and step.
template <class T>
struct ElementLaw {
  T h;               ///< length [m]
  Vec3<T> C_F, C_M;  ///< [N], [N m^2]
  Vec3<T> V_F, V_M;  ///< [N s], [N m^2 s]
  Vec3<T> gamma0;    ///< unstressed strain [1]
  Bowing<T> bowing;  ///< without tension
  BeamColumn<T> column;
};

template <class T>
struct ElementOffset {
  Vec3<T> F, M;  ///< [N], [N m]
};

/// The part of the offset that shear's internal variables make, along a1 and a2 [N].
template <class T>
struct ShearOffset {
  T x, y;
};

template <class T>
struct Node {
  Vec3<T> r;      ///< position [m], world
  Quat<T> q;      ///< section frame to world
  Vec3<T> v;      ///< velocity [m/s], world
  Vec3<T> omega;  ///< angular velocity [rad/s], section frame
};

/// ElementLaw per increment of what EvaluateStrain gives, and with the unstressed strain folded in:
/// what is the same for all elements of a rod.
template <class T>
struct ScaledLaw {
  ScaledLaw() = default;
  explicit ScaledLaw(const ElementLaw<T>& law) {
    one_over_h = T(1) / law.h;
    C_F = one_over_h * law.C_F;
    C_M = one_over_h * law.C_M;
    V_F = one_over_h * law.V_F;
    V_M = one_over_h * law.V_M;
    unstrained_F = -Scale(law.C_F, law.gamma0);
    bowing = law.bowing;
    shear_V = {T(0.0), T(0.0)};
  }
  /// Of an element that a tension stiffens; `sense` as in Bowed.
  ScaledLaw(const ScaledLaw& slack, const Stiffening<T>& by, const T& sense) : ScaledLaw(slack) {
    C_F.x += one_over_h * by.y.C_F;  // shear along a1 goes with bending about a2
    C_F.y += one_over_h * by.x.C_F;
    C_M.x += one_over_h * by.x.C_M;
    C_M.y += one_over_h * by.y.C_M;
    shear_V = {one_over_h * by.y.V_F, one_over_h * by.x.V_F};
    V_F.x += shear_V.x;
    V_F.y += shear_V.y;
    V_M.x += one_over_h * by.x.V_M;
    V_M.y += one_over_h * by.y.V_M;
    bowing = Bowed(bowing, by, sense);
  }

  T one_over_h;
  Vec3<T> C_F, C_M, V_F, V_M;
  Vec3<T> unstrained_F;  ///< -C_F Gamma0
  Bowing<T> bowing;
  PerAxis<T> shear_V;  ///< what of V_F a tension makes, along a1 and a2 [N s/m]
};

template <class T>
struct ElementState {
  Mat3<T> Rm;
  Vec3<T> chord;     ///< Rm^T (r2 - r1) [m]
  T one_over_chord;  ///< [1/m]
  Vec3<T> u;         ///< h Gamma [m]
  Vec3<T> theta;     ///< h K [rad]
  T tau, c;
  Vec3<T> u_rate, theta_rate;  ///< h dGamma/dt [m/s], h dK/dt [rad/s]
  Vec3<T> n, m;                ///< of the section: force [N] and moment [N m], midpoint's frame
  Vec3<T> m_theta;             ///< what works on theta [N m]
};

template <class To, class From>
ElementState<To> Converted(const ElementState<From>& e) {
  return {Converted<To>(e.Rm), Converted<To>(e.chord),  Converted<To>(e.one_over_chord),
          Converted<To>(e.u),  Converted<To>(e.theta),  Converted<To>(e.tau),
          Converted<To>(e.c),  Converted<To>(e.u_rate), Converted<To>(e.theta_rate),
          Converted<To>(e.n),  Converted<To>(e.m),      Converted<To>(e.m_theta)};
}

/// Modified Rodrigues vector x of q1* q2 and the midpoint's frame.
template <class T>
struct RelativeTurn {
  Vec3<T> x;
  T x2;
};

template <class T>
RelativeTurn<T> EvaluateTurn(const Quat<T>& a, const Quat<T>& b, Mat3<T>* Rm) {
  const Quat<T> q = Conjugate(a) * b;
  const T k = T(1) / (T(1) + q.w);
  // The midpoint's quaternion is along s = q1 + q2, and k = 2/|s|^2.
  const Quat<T> s = {a.w + b.w, a.x + b.x, a.y + b.y, a.z + b.z};
  const T x = k * s.x, y = k * s.y, z = k * s.z;
  const T xx = x * s.x, yy = y * s.y, zz = z * s.z;
  const T wx = x * s.w, wy = y * s.w, wz = z * s.w;
  *Rm = {{{T(1) - yy - zz, x * s.y - wz, x * s.z + wy},
          {x * s.y + wz, T(1) - xx - zz, y * s.z - wx},
          {x * s.z - wy, y * s.z + wx, T(1) - xx - yy}}};
  RelativeTurn<T> turn;
  turn.x = k * q.vec();
  turn.x2 = Dot(turn.x, turn.x);
  return turn;
}

/// Strains and their rates, from the turn and its series.
template <class T>
void EvaluateStrain(const Node<T>& a, const Node<T>& b, const RelativeTurn<T>& turn,
                    const ArcTangentSeries<T>& series, const Bowing<T>& bowing,
                    ElementState<T>* e) {
  e->theta = series.angle * turn.x;
  e->tau = series.tau;
  e->c = series.c;
  e->chord = TransposeTimes(e->Rm, b.r - a.r);
  const Vec3<T> domega = b.omega - a.omega, somega = T(0.5) * (b.omega + a.omega);
  const Vec3<T> tx = Cross(e->theta, domega);
  const Vec3<T> omega_m = somega + (T(0.5) * e->tau) * tx;
  e->theta_rate = domega + Cross(e->theta, somega) + e->c * Cross(e->theta, tx);
  const Vec3<T>&theta = e->theta, &rate = e->theta_rate;
  const T shortest(1e-30);  // squared; no nodes are that near
  const T square = Max(Dot(e->chord, e->chord), shortest);
  e->one_over_chord = InverseSqrt(square);
  const T length = square * e->one_over_chord;
  const T twist = bowing.twist * theta.z, twist_rate = bowing.twist * rate.z;
  e->u.x = e->chord.x - twist * theta.x;
  e->u.y = e->chord.y - twist * theta.y;
  const T bend_x = bowing.bend_x * theta.x, bend_y = bowing.bend_y * theta.y;
  e->u.z = (bowing.along_normal * e->chord.z + bowing.along_chord * length) +
           (bend_x * theta.x + bend_y * theta.y);
  const Vec3<T> moved = TransposeTimes(e->Rm, b.v - a.v);
  const T by_chord = bowing.along_chord * e->one_over_chord;
  e->u_rate = moved + Cross(e->chord, omega_m);
  e->u_rate.x -= twist_rate * theta.x + twist * rate.x;
  e->u_rate.y -= twist_rate * theta.y + twist * rate.y;
  e->u_rate.z = (bowing.along_normal * e->u_rate.z + by_chord * Dot(e->chord, moved)) +
                T(2.0) * (bend_x * rate.x + bend_y * rate.y);
}

/// Strains and their rates.
template <class T>
void EvaluateStrain(const Node<T>& a, const Node<T>& b, const Bowing<T>& bowing,
                    ElementState<T>* e) {
  const RelativeTurn<T> turn = EvaluateTurn(a.q, b.q, &e->Rm);
  EvaluateStrain(a, b, turn, EvaluateArcTangent(turn.x2), bowing, e);
}

/// From force and moment of the section in `e->n` and `e->m` to what works on theta: D^T n in
/// addition.
template <class T>
void BowStress(const Bowing<T>& bowing, ElementState<T>* e) {
  const Vec3<T>&n = e->n, &theta = e->theta;
  const T twice = n.z + n.z, twist = bowing.twist * theta.z;
  e->m_theta = {e->m.x + (twice * bowing.bend_x * theta.x - n.x * twist),
                e->m.y + (twice * bowing.bend_y * theta.y - n.y * twist),
                e->m.z - bowing.twist * (n.x * theta.x + n.y * theta.y)};
}

/// Of the force, what turns with the midpoint's frame; the rest turns with the chord.
template <class T>
Vec3<T> ForceInFrame(const ElementState<T>& e, const Bowing<T>& bowing) {
  return {e.n.x, e.n.y, bowing.along_normal * e.n.z};
}

/// Force and moment of the section law at strains that EvaluateStrain has set; BowStress completes.
template <class T>
void EvaluateSection(const ScaledLaw<T>& law, const Vec3<T>& offset_F, const Vec3<T>& offset_M,
                     ElementState<T>* e) {
  e->n = offset_F + Scale(law.C_F, e->u) + Scale(law.V_F, e->u_rate);
  e->m = offset_M + Scale(law.C_M, e->theta) + Scale(law.V_M, e->theta_rate);
}

/// The same where all that the internal variables make is shear.
template <class T>
void EvaluateSection(const ScaledLaw<T>& law, const ShearOffset<T>& offset, const Vec3<T>& unbend,
                     ElementState<T>* e) {
  EvaluateSection(law, law.unstrained_F, unbend, e);
  e->n.x += offset.x;
  e->n.y += offset.y;
}

template <class T>
void EvaluateStress(const ScaledLaw<T>& law, const ElementOffset<T>& offset, ElementState<T>* e) {
  EvaluateSection(law, offset.F + law.unstrained_F, offset.M, e);
  BowStress(law.bowing, e);
}

/// Generalised forces on the two nodes: what the element adds to M dv/dt + ... = 0.
template <class T>
struct ElementForces {
  Vec3<T> f;       ///< on r2 [N], world; -f on r1
  Vec3<T> g1, g2;  ///< moments on phi1, phi2 [N m], each in its node's frame
};

template <class T>
ElementForces<T> EvaluateForces(const ElementState<T>& e, const Bowing<T>& bowing) {
  const Vec3<T> p = ForceInFrame(e, bowing);
  const Vec3<T> half_p = T(0.5) * Cross(p, e.chord);
  const Vec3<T> txm = Cross(e.theta, e.m_theta);
  // theta x m has the same sign on both nodes, tau theta x p does not.
  const Vec3<T> same = half_p - T(0.5) * txm;
  const Vec3<T> opposite = e.m_theta + e.c * Cross(e.theta, txm) - e.tau * Cross(e.theta, half_p);
  ElementForces<T> out;
  out.f = e.Rm * (p + (bowing.along_chord * e.one_over_chord * e.n.z) * e.chord);
  out.g2 = same + opposite;
  out.g1 = same - opposite;
  return out;
}

}  // namespace cosserat_cable::rod
