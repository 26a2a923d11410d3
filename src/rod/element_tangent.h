// The element's tangent: how its forces change as its nodes move.
//
// In w = h Gamma, of which the energy is a function, the nodes' displacements and rotations make
//
//     delta w     = Rm^T (dr2 - dr1) + S (phi1 + phi2) + E (phi2 - phi1)
//     delta theta = J2 phi2 - J1 phi1
//     S = ([chord]x + D [theta]x)/2      E = tau/2 [chord]x [theta]x + D (I + c [theta]x^2)
//
// (symbols as in element.h), so that with s = phi1 + phi2 and d = phi2 - phi1 the tangent is a
// quadratic form in s and d: ss in s, dd in d and sd between them.
#pragma once

#include "element.h"

namespace cosserat_cable::rod {

/// Strain-like moduli of the tangent (C, or C + V d(rate)/d(strain) in a time step), and what the
/// tangents of all elements of a rod need of them.
template <class T>
struct TangentLaw {
  TangentLaw(const T& h, const Vec3<T>& gamma0, const Vec3<T>& C_F, const Vec3<T>& C_M) {
    const T one_over_h = T(1) / h;
    arc = ArcFactor(h, gamma0);
    cf = one_over_h * C_F;
    cm = one_over_h * C_M;
    sum = {T(0.5) * (cm.y + cm.z), T(0.5) * (cm.z + cm.x), T(0.5) * (cm.x + cm.y)};
    difference = {T(0.5) * (cm.z - cm.y), T(0.5) * (cm.x - cm.z), T(0.5) * (cm.y - cm.x)};
    even = T(1.0 / 6) * cm;
    odd = T(0.25) * cm;
    near = T(1.0 / 6) * sum - odd;
    far = T(1.0 / 6) * sum + odd;
  }
  T arc;                    ///< ArcFactor [m]
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

/// S and E.
template <class T>
struct StrainTangent {
  StrainTangent(const ElementState<T>& e, const T& arc) {
    const Vec3<T>& t = e.theta;
    const Vec3<T> half = T(0.5) * e.chord, across = e.tau * half, arc_t = arc * t;
    const T xx = arc_t.x * t.x, yy = arc_t.y * t.y, zz = arc_t.z * t.z;
    const T xy = arc_t.x * t.y, xz = arc_t.x * t.z, yz = arc_t.y * t.z;
    S = {{{T(0.5) * xy, T(0.5) * (zz - xx) - half.z, half.y - T(0.5) * yz},
          {half.z + T(0.5) * (yy - zz), T(-0.5) * xy, T(0.5) * xz - half.x},
          {yz - half.y, half.x - xz, T(0)}}};
    // [x][y] = y x^T - x.y I; D [theta]^2 = 2 a theta^T - theta.theta D.
    const T c2 = e.c + e.c, keep = T(1) - e.c * Dot(t, t);
    const Vec3<T> c2_a{-(c2 * xz), -(c2 * yz), c2 * (xx + yy)}, D = keep * arc_t;
    const T diagonal = Dot(across, t);
    E = Outer(t, across) + Outer(c2_a, t);
    E[0][0] -= diagonal + D.z;
    E[0][2] -= D.x;
    E[1][1] -= diagonal + D.z;
    E[1][2] -= D.y;
    E[2][0] += D.x + D.x;
    E[2][1] += D.y + D.y;
    E[2][2] -= diagonal;
  }
  Mat3<T> S, E;
};

/// Exact in how strains follow the nodes, however stiff the section is in stretch and shear; to
/// second order in theta in what the moment adds. The skew part of the diagonal blocks, which
/// vanishes in balance, and the change of strain rates with the configuration are left out, so that
/// the system stays symmetric. Newton then contracts by about 1e-3 per iteration instead of
/// quadratically; residuals are exact.
template <class T>
ElementTangent<T> EvaluateTangent(const ElementState<T>& e, const TangentLaw<T>& law) {
  ElementTangent<T> k;
  const Vec3<T>&cf = law.cf, &cm = law.cm, &t = e.theta, &m = e.m_theta;
  const Mat3<T> Rm_cf = ScaleColumns(e.Rm, cf);
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
    for (int j = 0; j <= i; ++j)
      k.rr[i][j] = k.rr[j][i] =
          Rm_cf[i][0] * e.Rm[j][0] + Rm_cf[i][1] * e.Rm[j][1] + Rm_cf[i][2] * e.Rm[j][2];

  // d f = Rm (cf delta w - n x phi_m).
  const StrainTangent<T> strain(e, law.arc);
  const Mat3<T> cf_S = ScaleRows(cf, strain.S), cf_E = ScaleRows(cf, strain.E);
  const Vec3<T> n = T(0.5) * e.n, turn = e.tau * t, n_across = e.tau * n;
  Mat3<T> in_s = cf_S, in_d = cf_E - Outer(t, n_across);
  in_s[0][1] += n.z;
  in_s[0][2] -= n.y;
  in_s[1][0] -= n.z;
  in_s[1][2] += n.x;
  in_s[2][0] += n.y;
  in_s[2][1] -= n.x;
  const T n_t = Dot(n_across, t);
  in_d[0][0] += n_t;
  in_d[1][1] += n_t;
  in_d[2][2] += n_t;
  in_s = e.Rm * in_s;
  in_d = e.Rm * in_d;
  k.r1 = in_s - in_d;
  k.r2 = in_s + in_d;

  // n at the chord's turning, phi_m^T sym([chord][n]) phi_m = (s + turn x d)^T G (s + turn x d).
  const Vec3<T> chord = T(0.5) * e.chord, quarter = T(0.5) * chord;
  const T chord_n = Dot(chord, n);
  Mat3<T> G;
  G[0][0] = chord.x * n.x - chord_n;
  G[1][1] = chord.y * n.y - chord_n;
  G[2][2] = chord.z * n.z - chord_n;
  G[0][1] = G[1][0] = quarter.x * n.y + quarter.y * n.x;
  G[0][2] = G[2][0] = quarter.x * n.z + quarter.z * n.x;
  G[1][2] = G[2][1] = quarter.y * n.z + quarter.z * n.y;
  const Mat3<T> G_turn = TimesCross(G, turn);
  const Mat3<T> turn_G_turn = CrossTimes(turn, G_turn);
  const auto with_cf = [](const Mat3<T>& a, int i, const Mat3<T>& cf_b, int j) {
    return a[0][i] * cf_b[0][j] + a[1][i] * cf_b[1][j] + a[2][i] * cf_b[2][j];
  };
  const auto ss = [&](int i, int j) { return G[i][j] + with_cf(strain.S, i, cf_S, j); };
  const auto sd = [&](int i, int j) { return G_turn[i][j] + with_cf(strain.S, i, cf_E, j); };
  // `n_a`: of the second derivative of n.a by theta.
  const auto dd = [&](int i, int j, const T& n_a) {
    return (n_a - turn_G_turn[i][j]) + with_cf(strain.E, i, cf_E, j);
  };
  const Vec3<T> arc_n = (law.arc + law.arc) * n;

  // J_i^T cm J_j with J = I +- [theta]/2 + [theta]^2/12, and the geometric stiffness of the moment:
  // Q/2 on the diagonal, [m]x/2 + Q beside it, with Q = (theta m^T + m theta^T)/6 - (theta.m)/3 I.
  // That matters: spinning a bent cable about its own axis is resisted by torsion over the whole
  // length only.
  const Vec3<T> squares = Scale(t, t), tm = T(1.0 / 6) * Scale(t, m), sixth = T(1.0 / 6) * t;
  const Vec3<T> first = Scale(law.difference, t);
  const Vec3<T> skew = T(0.5) * m - Scale(law.sum, t);
  const auto diagonal = [&](int i, const T& cm_i, const T& even_i, const T& square_j,
                            const T& square_k, const T& odd_j, const T& odd_k, const T& half_Q,
                            const T& n_a) {
    const T even = cm_i - even_i * (square_j + square_k);
    const T odd = odd_k * square_j + odd_j * square_k;
    const T in_ss = ss(i, i), in_dd = dd(i, i, n_a);
    const T same = (in_ss + in_dd) + (even + odd) - half_Q, opposite = T(2) * sd(i, i);
    k.t11[i][i] = same - opposite;
    k.t22[i][i] = same + opposite;
    k.t12[i][i] = (in_ss - in_dd) - (even - odd) - T(2) * half_Q;
  };
  diagonal(0, cm.x, law.even.x, squares.y, squares.z, law.odd.y, law.odd.z, tm.y + tm.z,
           arc_n.z + arc_n.z);
  diagonal(1, cm.y, law.even.y, squares.z, squares.x, law.odd.z, law.odd.x, tm.z + tm.x,
           arc_n.z + arc_n.z);
  diagonal(2, cm.z, law.even.z, squares.x, squares.y, law.odd.x, law.odd.y, tm.x + tm.y, T(0));
  const auto beside = [&](int i, int j, const T& product, const T& near, const T& far, const T& Q,
                          const T& first_ij, const T& skew_ij, const T& n_a) {
    const T in_ss = ss(i, j), in_dd = dd(i, j, n_a), in_sd = sd(i, j), in_ds = sd(j, i);
    const T same = (in_ss + in_dd) + near * product + T(0.5) * Q;
    const T opposite = in_sd + in_ds + first_ij;
    k.t11[i][j] = k.t11[j][i] = same - opposite;
    k.t22[i][j] = k.t22[j][i] = same + opposite;
    const T even = (in_ss - in_dd) - far * product + Q, odd = (in_sd - in_ds) + skew_ij;
    k.t12[i][j] = even + odd;
    k.t12[j][i] = even - odd;
  };
  beside(0, 1, t.x * t.y, law.near.z, law.far.z, sixth.x * m.y + sixth.y * m.x, first.z, -skew.z,
         T(0));
  beside(0, 2, t.x * t.z, law.near.y, law.far.y, sixth.x * m.z + sixth.z * m.x, first.y, skew.y,
         -arc_n.x);
  beside(1, 2, t.y * t.z, law.near.x, law.far.x, sixth.y * m.z + sixth.z * m.y, first.x, -skew.x,
         -arc_n.y);
  return k;
}

}  // namespace cosserat_cable::rod
