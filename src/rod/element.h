// The two-node element of the geometrically exact (Simo-Reissner) rod.
//
// Strains live at the element's geodesic midpoint. With the relative rotation vector
// theta = log(R1^T R2), midpoint rotation Rm = R1 exp(theta/2) and u = Rm^T (r2 - r1):
//
//     Gamma = u/h            K = theta/h
//
// so both are invariant under superposed rigid motions. Rotations vary as R <- R exp([phi]x), phi
// in the section's own frame. Exactly (every matrix below is a function of [theta]x, so they
// commute):
//
//     delta theta = J2 phi2 - J1 phi1    J2 = I + [theta]x/2 + c [theta]x^2,  J1 = J2^T
//     phi_m       = P1 phi1 + P2 phi2    P2 = (I + tau [theta]x)/2,           P1 = P2^T
//     h delta Gamma = Rm^T (dr2 - dr1) + u x phi_m
//
// with x = tan(|theta|/4), A = atan(x)/x: tau = 1/(4A), c = (1 - (|theta|/2)
// cot(|theta|/2))/|theta|^2 = (1 - A(1-x^2))/(16 A^2 x^2). Strain rates are the same expressions
// with velocities in place of variations, hence objective. No trigonometry is needed: x = vec(q)/(1
// + q_w) of q = q1* q2.
#pragma once

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
  explicit ScaledLaw(const ElementLaw<T>& law) {
    one_over_h = T(1) / law.h;
    C_F = one_over_h * law.C_F;
    C_M = one_over_h * law.C_M;
    V_F = one_over_h * law.V_F;
    V_M = one_over_h * law.V_M;
    unstrained_F = -Scale(law.C_F, law.gamma0);
  }
  T one_over_h;
  Vec3<T> C_F, C_M, V_F, V_M;
  Vec3<T> unstrained_F;  ///< -C_F Gamma0
};

template <class T>
struct ElementState {
  Mat3<T> Rm;
  Vec3<T> u;      ///< Rm^T (r2 - r1) = h Gamma [m]
  Vec3<T> theta;  ///< h K [rad]
  T tau, c;
  Vec3<T> u_rate, theta_rate;  ///< h dGamma/dt [m/s], h dK/dt [rad/s]
  Vec3<T> n, m;                ///< force [N] and moment [N m] in the midpoint's frame
};

template <class To, class From>
ElementState<To> Converted(const ElementState<From>& e) {
  return {Converted<To>(e.Rm),         Converted<To>(e.u), Converted<To>(e.theta),
          Converted<To>(e.tau),        Converted<To>(e.c), Converted<To>(e.u_rate),
          Converted<To>(e.theta_rate), Converted<To>(e.n), Converted<To>(e.m)};
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
                    const ArcTangentSeries<T>& series, ElementState<T>* e) {
  e->theta = series.angle * turn.x;
  e->tau = series.tau;
  e->c = series.c;
  e->u = TransposeTimes(e->Rm, b.r - a.r);
  const Vec3<T> domega = b.omega - a.omega, somega = T(0.5) * (b.omega + a.omega);
  const Vec3<T> tx = Cross(e->theta, domega);
  const Vec3<T> omega_m = somega + (T(0.5) * e->tau) * tx;
  e->u_rate = TransposeTimes(e->Rm, b.v - a.v) + Cross(e->u, omega_m);
  e->theta_rate = domega + Cross(e->theta, somega) + e->c * Cross(e->theta, tx);
}

/// Strains and their rates.
template <class T>
void EvaluateStrain(const Node<T>& a, const Node<T>& b, ElementState<T>* e) {
  const RelativeTurn<T> turn = EvaluateTurn(a.q, b.q, &e->Rm);
  EvaluateStrain(a, b, turn, EvaluateArcTangent(turn.x2), e);
}

/// Force and moment of the section law at strains that EvaluateStrain has set.
template <class T>
void EvaluateStress(const ScaledLaw<T>& law, const ElementOffset<T>& offset, ElementState<T>* e) {
  e->n = (offset.F + law.unstrained_F) + Scale(law.C_F, e->u) + Scale(law.V_F, e->u_rate);
  e->m = offset.M + Scale(law.C_M, e->theta) + Scale(law.V_M, e->theta_rate);
}

/// The same where all that the internal variables make is shear.
template <class T>
void EvaluateStress(const ScaledLaw<T>& law, const ShearOffset<T>& offset, const Vec3<T>& unbend,
                    ElementState<T>* e) {
  e->n = law.unstrained_F + Scale(law.C_F, e->u) + Scale(law.V_F, e->u_rate);
  e->n.x += offset.x;
  e->n.y += offset.y;
  e->m = unbend + Scale(law.C_M, e->theta) + Scale(law.V_M, e->theta_rate);
}

/// Generalised forces on the two nodes: what the element adds to M dv/dt + ... = 0.
template <class T>
struct ElementForces {
  Vec3<T> f;       ///< on r2 [N], world; -f on r1
  Vec3<T> g1, g2;  ///< moments on phi1, phi2 [N m], each in its node's frame
};

template <class T>
ElementForces<T> EvaluateForces(const ElementState<T>& e) {
  const Vec3<T> half_p = T(0.5) * Cross(e.n, e.u);
  const Vec3<T> txm = Cross(e.theta, e.m);
  // theta x m has the same sign on both nodes, tau theta x p does not.
  const Vec3<T> same = half_p - T(0.5) * txm;
  const Vec3<T> opposite = e.m + e.c * Cross(e.theta, txm) - e.tau * Cross(e.theta, half_p);
  ElementForces<T> out;
  out.f = e.Rm * e.n;
  out.g2 = same + opposite;
  out.g1 = same - opposite;
  return out;
}

/// Strain-like moduli of the tangent (C, or C + V d(rate)/d(strain) in a time step), and what the
/// tangents of all elements of a rod need of them.
template <class T>
struct TangentLaw {
  TangentLaw(const T& h, const Vec3<T>& C_F, const Vec3<T>& C_M) {
    const T one_over_h = T(1) / h;
    cf = one_over_h * C_F;
    cm = one_over_h * C_M;
    sum = {T(0.5) * (cm.y + cm.z), T(0.5) * (cm.z + cm.x), T(0.5) * (cm.x + cm.y)};
    difference = {T(0.5) * (cm.z - cm.y), T(0.5) * (cm.x - cm.z), T(0.5) * (cm.y - cm.x)};
    even = T(1.0 / 6) * cm;
    odd = T(0.25) * cm;
    near = T(1.0 / 6) * sum - odd;
    far = T(1.0 / 6) * sum + odd;
  }
  Vec3<T> cf, cm;           ///< [N/m], [N m]
  Vec3<T> sum, difference;  ///< of the other two axes' moduli of bending or twisting, halved
  Vec3<T> even, odd;        ///< factors of [theta]^2 in J_i^T cm J_j, on its diagonal
  Vec3<T> near, far;        ///< the same beside it, for i = j and for i != j
};

/// Symmetric 12x12 tangent of one element in its blocks. Signs: rows r2; r1 has the opposite ones.
template <class T>
struct ElementTangent {
  Mat3<T> rr;             ///< d f/d r2
  Mat3<T> r1, r2;         ///< d f/d phi1, d f/d phi2
  Mat3<T> t11, t12, t22;  ///< d g_i/d phi_j
};

/// Exact to second order in theta. The skew part of the diagonal blocks, which vanishes in balance,
/// and the change of strain rates with the configuration are left out, so that the system stays
/// symmetric. Newton then contracts by about 1e-3 per iteration instead of quadratically; residuals
/// are exact.
template <class T>
ElementTangent<T> EvaluateTangent(const ElementState<T>& e, const TangentLaw<T>& law) {
  ElementTangent<T> k;
  const Vec3<T>&cf = law.cf, &cm = law.cm, &t = e.theta;
  const Mat3<T> Rm_cf = ScaleColumns(e.Rm, cf);
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
    for (int j = 0; j <= i; ++j)
      k.rr[i][j] = k.rr[j][i] =
          Rm_cf[i][0] * e.Rm[j][0] + Rm_cf[i][1] * e.Rm[j][1] + Rm_cf[i][2] * e.Rm[j][2];

  // d f/d phi_m = Rm Y, Y = cf [u] - [n]; each node gets half of it, turned to it by tau theta.
  const Vec3<T> u = T(0.5) * e.u, n = T(0.5) * e.n, turn = e.tau * t;
  const T Y01 = n.z - cf.x * u.z, Y02 = cf.x * u.y - n.y;
  const T Y10 = cf.y * u.z - n.z, Y12 = n.x - cf.y * u.x;
  const T Y20 = n.y - cf.z * u.y, Y21 = cf.z * u.x - n.x;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    const T* R = e.Rm[i];
    const Vec3<T> even{R[1] * Y10 + R[2] * Y20, R[0] * Y01 + R[2] * Y21, R[0] * Y02 + R[1] * Y12};
    const Vec3<T> odd = Cross(even, turn);
    k.r1[i][0] = even.x - odd.x;
    k.r1[i][1] = even.y - odd.y;
    k.r1[i][2] = even.z - odd.z;
    k.r2[i][0] = even.x + odd.x;
    k.r2[i][1] = even.y + odd.y;
    k.r2[i][2] = even.z + odd.z;
  }

  // phi_i phi_j of the force: P_i^T M P_j with M = -sym([u] Y), P = (I -+ tau [theta])/2; the
  // quarter is in u and n.
  Mat3<T> M;
  const Vec3<T> quarter_u = T(0.5) * u;
  M[0][0] = u.z * Y10 - u.y * Y20;
  M[1][1] = u.x * Y21 - u.z * Y01;
  M[2][2] = u.y * Y02 - u.x * Y12;
  M[0][1] = M[1][0] = quarter_u.x * Y20 - quarter_u.y * Y21;
  M[0][2] = M[2][0] = quarter_u.z * Y12 - quarter_u.x * Y10;
  M[1][2] = M[2][1] = quarter_u.y * Y01 - quarter_u.z * Y02;
  const Mat3<T> Mt = TimesCross(M, turn);  // M tau[theta]; its transpose is -(tau[theta] M)
  const Mat3<T> tMt = CrossTimes(turn, Mt);

  // J_i^T cm J_j with J = I +- [theta]/2 + [theta]^2/12, and the geometric stiffness of the moment:
  // Q/2 on the diagonal, [m]x/2 + Q beside it, with Q = (theta m^T + m theta^T)/6 - (theta.m)/3 I.
  // That matters: spinning a bent cable about its own axis is resisted by torsion over the whole
  // length only.
  const Vec3<T> squares = Scale(t, t), tm = T(1.0 / 6) * Scale(t, e.m);
  const Vec3<T> sixth = T(1.0 / 6) * t;
  const Vec3<T> first = Scale(law.difference, t);
  const Vec3<T> skew = T(0.5) * e.m - Scale(law.sum, t);
  const auto diagonal = [&](int i, const T& cm_i, const T& even_i, const T& square_j,
                            const T& square_k, const T& odd_j, const T& odd_k, const T& half_Q) {
    const T even = cm_i - even_i * (square_j + square_k);
    const T odd = odd_k * square_j + odd_j * square_k;
    const T same = (M[i][i] - tMt[i][i]) + (even + odd) - half_Q, opposite = T(2) * Mt[i][i];
    k.t11[i][i] = same - opposite;
    k.t22[i][i] = same + opposite;
    k.t12[i][i] = (M[i][i] + tMt[i][i]) - (even - odd) - T(2) * half_Q;
  };
  diagonal(0, cm.x, law.even.x, squares.y, squares.z, law.odd.y, law.odd.z, tm.y + tm.z);
  diagonal(1, cm.y, law.even.y, squares.z, squares.x, law.odd.z, law.odd.x, tm.z + tm.x);
  diagonal(2, cm.z, law.even.z, squares.x, squares.y, law.odd.x, law.odd.y, tm.x + tm.y);
  const auto beside = [&](int i, int j, const T& product, const T& near, const T& far, const T& Q,
                          const T& first_ij, const T& skew_ij) {
    const T same = (M[i][j] - tMt[i][j]) + near * product + T(0.5) * Q;
    const T opposite = Mt[i][j] + Mt[j][i] + first_ij;
    k.t11[i][j] = k.t11[j][i] = same - opposite;
    k.t22[i][j] = k.t22[j][i] = same + opposite;
    const T even = (M[i][j] + tMt[i][j]) - far * product + Q, odd = (Mt[i][j] - Mt[j][i]) + skew_ij;
    k.t12[i][j] = even + odd;
    k.t12[j][i] = even - odd;
  };
  beside(0, 1, t.x * t.y, law.near.z, law.far.z, sixth.x * e.m.y + sixth.y * e.m.x, first.z,
         -skew.z);
  beside(0, 2, t.x * t.z, law.near.y, law.far.y, sixth.x * e.m.z + sixth.z * e.m.x, first.y,
         skew.y);
  beside(1, 2, t.y * t.z, law.near.x, law.far.x, sixth.y * e.m.z + sixth.z * e.m.y, first.x,
         -skew.x);
  return k;
}

}  // namespace cosserat_cable::rod
