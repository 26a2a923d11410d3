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

template <class T>
struct Node {
  Vec3<T> r;      ///< position [m], world
  Quat<T> q;      ///< section frame to world
  Vec3<T> v;      ///< velocity [m/s], world
  Vec3<T> omega;  ///< angular velocity [rad/s], section frame
};

template <class T>
struct ElementState {
  Mat3<T> Rm;
  Vec3<T> u;      ///< Rm^T (r2 - r1) [m]
  Vec3<T> theta;  ///< [rad]
  T tau, c;
  Vec3<T> gamma, gamma_dot;  ///< strain [1] and rate [1/s]
  Vec3<T> kappa, kappa_dot;  ///< [1/m], [1/(m s)]
  Vec3<T> n, m;              ///< force [N] and moment [N m] in the midpoint's frame
};

/// Strains and their rates.
template <class T>
void EvaluateStrain(const Node<T>& a, const Node<T>& b, const T& h, ElementState<T>* e) {
  using std::sqrt;
  const Quat<T> q = Conjugate(a.q) * b.q;
  const T one_over = T(1) / (T(1) + q.w);
  const Vec3<T> x = one_over * q.vec();
  const auto series = EvaluateArcTangent(Dot(x, x));
  e->theta = (T(4) * series.A) * x;
  e->tau = T(0.25) / series.A;
  e->c = series.B * e->tau * e->tau;
  const Quat<T> sum = {a.q.w + b.q.w, a.q.x + b.q.x, a.q.y + b.q.y, a.q.z + b.q.z};
  e->Rm = ToMatrix(Normalized(sum));
  e->u = TransposeTimes(e->Rm, b.r - a.r);
  const T inv_h = T(1) / h;
  e->gamma = inv_h * e->u;
  e->kappa = inv_h * e->theta;
  const Vec3<T> domega = b.omega - a.omega, somega = b.omega + a.omega;
  const Vec3<T> tx = Cross(e->theta, domega);
  const Vec3<T> omega_m = T(0.5) * (somega + e->tau * tx);
  e->gamma_dot = inv_h * (TransposeTimes(e->Rm, b.v - a.v) + Cross(e->u, omega_m));
  e->kappa_dot = inv_h * (domega + T(0.5) * Cross(e->theta, somega) + e->c * Cross(e->theta, tx));
}

/// Force and moment of the section law at strains that EvaluateStrain has set.
template <class T>
void EvaluateStress(const ElementLaw<T>& law, const ElementOffset<T>& offset, ElementState<T>* e) {
  e->n = offset.F + Scale(law.C_F, e->gamma - law.gamma0) + Scale(law.V_F, e->gamma_dot);
  e->m = offset.M + Scale(law.C_M, e->kappa) + Scale(law.V_M, e->kappa_dot);
}

/// Generalised forces on the two nodes: what the element adds to M dv/dt + ... = 0.
template <class T>
struct ElementForces {
  Vec3<T> f;       ///< on r2 [N], world; -f on r1
  Vec3<T> g1, g2;  ///< moments on phi1, phi2 [N m], each in its node's frame
};

template <class T>
ElementForces<T> EvaluateForces(const ElementState<T>& e) {
  const Vec3<T> p = Cross(e.n, e.u);
  const Vec3<T> txp = e.tau * Cross(e.theta, p);
  const Vec3<T> txm = Cross(e.theta, e.m);
  const Vec3<T> even = e.m + e.c * Cross(e.theta, txm);
  const Vec3<T> half_p = T(0.5) * p;
  const Vec3<T> odd = T(0.5) * (txp + txm);
  ElementForces<T> out;
  out.f = e.Rm * e.n;
  out.g2 = half_p + even - odd;
  // tau theta x p changes sign between the nodes, theta x m does not.
  out.g1 = half_p - even - T(0.5) * (txm - txp);
  return out;
}

/// Symmetric 12x12 tangent of one element in its blocks. Signs: rows r2; r1 has the opposite ones.
template <class T>
struct ElementTangent {
  Mat3<T> rr;             ///< d f/d r2
  Mat3<T> r1, r2;         ///< d f/d phi1, d f/d phi2
  Mat3<T> t11, t12, t22;  ///< d g_i/d phi_j
};

/// Tangent for strain-like moduli `C_F`, `C_M` (C, or C + V d(rate)/d(strain) in a time step).
///
/// The geometric part is exact to second order in theta; the skew part of the diagonal blocks,
/// which vanishes in balance, and the change of strain rates with the configuration are left out,
/// so that the system stays symmetric. Newton then contracts by about 1e-3 per iteration instead of
/// quadratically; residuals are exact.
template <class T>
ElementTangent<T> EvaluateTangent(const ElementState<T>& e, const T& h, const Vec3<T>& C_F,
                                  const Vec3<T>& C_M) {
  const T inv_h = T(1) / h;
  const Vec3<T> cf = inv_h * C_F, cm = inv_h * C_M;
  const Mat3<T> Rm_cf = ScaleColumns(e.Rm, cf);
  ElementTangent<T> k;
  k.rr = Rm_cf * Transpose(e.Rm);

  const Mat3<T> X = TimesCross(Rm_cf, e.u) - TimesCross(e.Rm, e.n);
  const Mat3<T> X_odd = (T(0.5) * e.tau) * TimesCross(X, e.theta);
  const Mat3<T> X_even = T(0.5) * X;
  k.r1 = X_even - X_odd;
  k.r2 = X_even + X_odd;

  // phi_m phi_m: -[u] cf [u] + sym([n][u]),  [n][u] = u n^T - (n.u) I
  Mat3<T> M;
  const T nu = Dot(e.n, e.u);
  const T uu[3] = {e.u.x * e.u.x, e.u.y * e.u.y, e.u.z * e.u.z};
  M[0][0] = cf.y * uu[2] + cf.z * uu[1] + e.n.x * e.u.x - nu;
  M[1][1] = cf.z * uu[0] + cf.x * uu[2] + e.n.y * e.u.y - nu;
  M[2][2] = cf.x * uu[1] + cf.y * uu[0] + e.n.z * e.u.z - nu;
  M[0][1] = M[1][0] = -cf.z * e.u.x * e.u.y + T(0.5) * (e.n.x * e.u.y + e.n.y * e.u.x);
  M[0][2] = M[2][0] = -cf.y * e.u.x * e.u.z + T(0.5) * (e.n.x * e.u.z + e.n.z * e.u.x);
  M[1][2] = M[2][1] = -cf.x * e.u.y * e.u.z + T(0.5) * (e.n.y * e.u.z + e.n.z * e.u.y);

  // P_i^T M P_j with P = (I -+ tau [theta])/2
  const Mat3<T> Mt = e.tau * TimesCross(M, e.theta);    // M tau[theta]
  const Mat3<T> tMt = e.tau * CrossTimes(e.theta, Mt);  // tau[theta] M tau[theta]
  const Mat3<T> tM = Transpose(Mt);                     // -(tau[theta] M), M symmetric

  // J_i^T cm J_j with J2 = I + E + O, J1 = I + E - O, O = [theta]/2, E = c [theta]^2
  Mat3<T> even = e.c * (Outer(e.theta, e.theta));
  const T diagonal = T(1) - e.c * Dot(e.theta, e.theta);
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) even[i][i] += diagonal;
  const Mat3<T> odd = T(0.5) * CrossMatrix(e.theta);
  const Mat3<T> cE = ScaleRows(cm, even), cO = ScaleRows(cm, odd);
  const Mat3<T> EE = even * cE, EO = even * cO, OO = odd * cO;  // odd^T = -odd
  // J2^T c J2 = (E - O) c (E + O),  J1^T c J1 = (E + O) c (E - O),  J1^T c J2 = (E + O) c (E + O)
  // with OcE = -(EcO)^T.

  // Geometric stiffness of the moment, to second order: Q/2 on the diagonal, [m]x/2 + Q beside it,
  // with Q = (theta m^T + m theta^T)/6 - (theta.m)/3 I. It matters: spinning a bent cable about its
  // own axis is resisted by torsion over the whole length only.
  const T tm = T(1.0 / 3) * Dot(e.theta, e.m);
  const Vec3<T> sixth = T(1.0 / 6) * e.theta;
  Mat3<T> Q;
  Q[0][0] = T(2) * sixth.x * e.m.x - tm;
  Q[1][1] = T(2) * sixth.y * e.m.y - tm;
  Q[2][2] = T(2) * sixth.z * e.m.z - tm;
  Q[0][1] = Q[1][0] = sixth.x * e.m.y + sixth.y * e.m.x;
  Q[0][2] = Q[2][0] = sixth.x * e.m.z + sixth.z * e.m.x;
  Q[1][2] = Q[2][1] = sixth.y * e.m.z + sixth.z * e.m.y;
  const Mat3<T> half_m = T(0.5) * CrossMatrix(e.m);

#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j) {
      const T quarter_M = T(0.25) * (M[i][j] - tMt[i][j]);
      const T quarter_odd = T(0.25) * (Mt[i][j] + tM[i][j]);
      const T second = EE[i][j] - OO[i][j] + T(0.5) * Q[i][j];
      const T first = EO[i][j] + EO[j][i];
      k.t11[i][j] = quarter_M - quarter_odd + second - first;
      k.t22[i][j] = quarter_M + quarter_odd + second + first;
      k.t12[i][j] = T(0.25) * (M[i][j] + tMt[i][j] + Mt[i][j] - tM[i][j]) -
                    (EE[i][j] + OO[i][j] + EO[i][j] - EO[j][i]) + Q[i][j] + half_m[i][j];
    }
  return k;
}

}  // namespace cosserat_cable::rod
