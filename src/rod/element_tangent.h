// The element's tangent: how its forces change as its nodes move.
//
// The energy is a function of w_1, w_2, h Gamma_3 and theta. The nodes' displacements and rotations
// change a component of the first three, which follows the chord along v + x with x parallel to it
// and theta by g, by
//
//     (v + x)^T Rm^T (dr2 - dr1) + S (phi1 + phi2) + E (phi2 - phi1)
//     S = (v x chord + g x theta)/2      E = (tau/2 v x chord + c g x theta) x theta + g
//     delta theta = J2 phi2 - J1 phi1
//
// (symbols as in element.h), so that with s = phi1 + phi2 and d = phi2 - phi1 the tangent is a
// quadratic form in s and d: ss in s, dd in d and sd between them.
#pragma once

#include "element.h"

namespace cosserat_cable::rod {

/// Strain-like moduli of the tangent (C, or C + V d(rate)/d(strain) in a time step).
template <class T>
struct TangentLaw {
  Bowing<T> bowing;
  Vec3<T> cf, cm;  ///< by the element's length [N/m], [N m]
};

/// A pressure of 6 EI/h^2 and more, which no element bears, is one of Newton's on its way, or
/// passes in a blink: it takes no more than this part of a modulus.
inline constexpr double kLeast = 0.5;

/// Symmetric 12x12 tangent of one element in its blocks. Signs: rows r2; r1 has the opposite ones.
template <class T>
struct ElementTangent {
  Mat3<T> rr;             ///< d f/d r2
  Mat3<T> r1, r2;         ///< d f/d phi1, d f/d phi2
  Mat3<T> t11, t12, t22;  ///< d g_i/d phi_j
};

/// How w_1, w_2 and h Gamma_3 follow the nodes, a row each: `R` their displacements in the world's
/// axes, S and E their rotations.
template <class T>
struct StrainTangent {
  StrainTangent(const ElementState<T>& e, const Bowing<T>& bowing) {
    const Vec3<T>& t = e.theta;
    const Vec3<T> half = T(0.5) * e.chord, across = e.tau * half, twist = bowing.twist * t;
    // Rows of w_1 and w_2, written out: v is a unit vector. [x][y] = y x^T - x.y I and
    // D [theta]^2 = 2 a theta^T - theta.theta D.
    const T xx = twist.x * t.x, yy = twist.y * t.y, zz = twist.z * t.z, xy = T(0.5) * twist.x * t.y;
    const T xz = twist.x * t.z, yz = twist.y * t.z;
    S[0][0] = xy;
    S[0][1] = T(0.5) * (zz - xx) - half.z;
    S[0][2] = half.y - T(0.5) * yz;
    S[1][0] = half.z + T(0.5) * (yy - zz);
    S[1][1] = -xy;
    S[1][2] = T(0.5) * xz - half.x;
    const T c2 = e.c + e.c, keep = T(1) - e.c * Dot(t, t);
    const T by_x = -(c2 * xz), by_y = -(c2 * yz);
    const T diagonal = Dot(across, t) + keep * twist.z;
    E[0][0] = t.x * across.x + by_x * t.x - diagonal;
    E[0][1] = t.x * across.y + by_x * t.y;
    E[0][2] = t.x * across.z + by_x * t.z - keep * twist.x;
    E[1][0] = t.y * across.x + by_y * t.x;
    E[1][1] = t.y * across.y + by_y * t.y - diagonal;
    E[1][2] = t.y * across.z + by_y * t.z - keep * twist.y;

    const T v = bowing.along_normal, g_x = T(2) * bowing.bend_x * t.x,
            g_y = T(2) * bowing.bend_y * t.y;
    const Vec3<T> by_chord = {-(v * half.y), v * half.x, T(0)};
    const Vec3<T> by_theta = {g_y * t.z, -(g_x * t.z), g_x * t.y - g_y * t.x};
    S[2][0] = by_chord.x + T(0.5) * by_theta.x;
    S[2][1] = by_chord.y + T(0.5) * by_theta.y;
    S[2][2] = T(0.5) * by_theta.z;
    const T b_x = e.tau * by_chord.x + e.c * by_theta.x,
            b_y = e.tau * by_chord.y + e.c * by_theta.y;
    const T b_z = e.c * by_theta.z;
    E[2][0] = (b_y * t.z - b_z * t.y) + g_x;
    E[2][1] = (b_z * t.x - b_x * t.z) + g_y;
    E[2][2] = b_x * t.y - b_y * t.x;
    const T along = bowing.along_chord;
    const Vec3<T> unit_chord = e.one_over_chord * e.chord;
    stretch = {along * unit_chord.x, along * unit_chord.y, along * unit_chord.z + v};
    unit = e.Rm * unit_chord;
    R = {{{e.Rm[0][0], e.Rm[1][0], e.Rm[2][0]},
          {e.Rm[0][1], e.Rm[1][1], e.Rm[2][1]},
          {along * unit.x + v * e.Rm[0][2], along * unit.y + v * e.Rm[1][2],
           along * unit.z + v * e.Rm[2][2]}}};
  }
  /// What works on w_1, w_2, h Gamma_3 by rows, as it works on the chord.
  Mat3<T> OnChord(const Mat3<T>& a) const {
    Mat3<T> c;
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j) {
      c[0][j] = a[0][j] + stretch.x * a[2][j];
      c[1][j] = a[1][j] + stretch.y * a[2][j];
      c[2][j] = stretch.z * a[2][j];
    }
    return c;
  }

  Vec3<T> stretch;  // v + x of h Gamma_3
  Vec3<T> unit;     // along the chord, in the world's axes
  Mat3<T> R, S, E;
};

/// The modulus in theta, on its diagonal, of bending and of the force's way by it; and what
/// J_i^T cm J_j needs of that.
template <class T>
struct BendingModulus {
  BendingModulus(const ElementState<T>& e, const TangentLaw<T>& law) : cm(law.cm) {
    const T twice = e.n.z + e.n.z;
    cm.x = Max(cm.x + twice * law.bowing.bend_x, kLeast * cm.x);
    cm.y = Max(cm.y + twice * law.bowing.bend_y, kLeast * cm.y);
    const Vec3<T> half = T(0.5) * cm;
    sum = {half.y + half.z, half.z + half.x, half.x + half.y};
    difference = {half.z - half.y, half.x - half.z, half.y - half.x};
    even = T(1.0 / 6) * cm;
    odd = T(0.5) * half;
    near = T(1.0 / 6) * sum - odd;
    far = T(1.0 / 6) * sum + odd;
  }
  Vec3<T> cm;
  Vec3<T> sum, difference;  ///< of the other two axes' moduli, halved
  Vec3<T> even, odd;        ///< factors of [theta]^2, on its diagonal
  Vec3<T> near, far;        ///< the same beside it, for i = j and for i != j
};

/// Exact in how strains follow the nodes, however stiff the section is in stretch and shear; to
/// second order in theta in what the moment adds. The skew part of the diagonal blocks, which
/// vanishes in balance, and the change of strain rates with the configuration are left out, so that
/// the system stays symmetric. Newton then contracts by about 1e-3 per iteration instead of
/// quadratically; residuals are exact.
template <class T>
ElementTangent<T> EvaluateTangent(const ElementState<T>& e, const TangentLaw<T>& law) {
  ElementTangent<T> k;
  const Vec3<T>&t = e.theta, &m = e.m_theta;
  const StrainTangent<T> strain(e, law.bowing);
  // As the chord turns in space, its own part of the force turns with it.
  const T string =
      Max(law.bowing.along_chord * e.one_over_chord * e.n.z, T(-kLeast) * Min(law.cf.x, law.cf.y));
  const Vec3<T>& unit = strain.unit;
  const Mat3<T> cf_R = ScaleRows(law.cf, strain.R);
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
    for (int j = 0; j <= i; ++j) {
      const T along = (&unit.x)[i] * (&unit.x)[j];
      k.rr[i][j] = k.rr[j][i] = (cf_R[0][i] * strain.R[0][j] + cf_R[1][i] * strain.R[1][j] +
                                 cf_R[2][i] * strain.R[2][j]) +
                                string * (i == j ? T(1) - along : -along);
    }

  // d f = R^T cf delta(w_1, w_2, h Gamma_3) - Rm (p x phi_m) and the chord's.
  const Mat3<T> cf_S = ScaleRows(law.cf, strain.S), cf_E = ScaleRows(law.cf, strain.E);
  const Vec3<T> n = T(0.5) * ForceInFrame(e, law.bowing), turn = e.tau * t, n_across = e.tau * n;
  const Mat3<T> turns_s = {{{T(0), n.z, -n.y}, {-n.z, T(0), n.x}, {n.y, -n.x, T(0)}}};
  Mat3<T> turns_d = -Outer(t, n_across);
  const T n_t = Dot(n_across, t);
  turns_d[0][0] += n_t;
  turns_d[1][1] += n_t;
  turns_d[2][2] += n_t;
  const Mat3<T> in_s = e.Rm * (strain.OnChord(cf_S) + turns_s);
  const Mat3<T> in_d = e.Rm * (strain.OnChord(cf_E) + turns_d);
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
  // `theta_n`: of the second derivative of n.a by theta beside its diagonal, to first order.
  const auto sd = [&](int i, int j, const T& theta_n) {
    return (G_turn[i][j] + theta_n) + with_cf(strain.S, i, cf_E, j);
  };
  // `n_a`: that derivative itself.
  const auto dd = [&](int i, int j, const T& n_a) {
    return (n_a - turn_G_turn[i][j]) + with_cf(strain.E, i, cf_E, j);
  };
  const T across_x = (law.bowing.twist + law.bowing.twist) * n.x;
  const T across_y = (law.bowing.twist + law.bowing.twist) * n.y;
  const Vec3<T> half_t = T(0.5) * t;

  // J_i^T cm J_j with J = I +- [theta]/2 + [theta]^2/12, and the geometric stiffness of the moment:
  // Q/2 on the diagonal, [m]x/2 + Q beside it, with Q = (theta m^T + m theta^T)/6 - (theta.m)/3 I.
  // That matters: spinning a bent cable about its own axis is resisted by torsion over the whole
  // length only.
  const Vec3<T> squares = Scale(t, t), tm = T(1.0 / 6) * Scale(t, m), sixth = T(1.0 / 6) * t;
  const BendingModulus<T> bending(e, law);
  const Vec3<T>& cm = bending.cm;
  const Vec3<T> first = Scale(bending.difference, t);
  const Vec3<T> skew = T(0.5) * m - Scale(bending.sum, t);
  const auto diagonal = [&](int i, const T& cm_i, const T& even_i, const T& square_j,
                            const T& square_k, const T& odd_j, const T& odd_k, const T& half_Q,
                            const T& theta_n) {
    const T even = cm_i - even_i * (square_j + square_k);
    const T odd = odd_k * square_j + odd_j * square_k;
    const T in_ss = ss(i, i), in_dd = dd(i, i, T(0));
    const T same = (in_ss + in_dd) + (even + odd) - half_Q, opposite = T(2) * sd(i, i, theta_n);
    k.t11[i][i] = same - opposite;
    k.t22[i][i] = same + opposite;
    k.t12[i][i] = (in_ss - in_dd) - (even - odd) - T(2) * half_Q;
  };
  diagonal(0, cm.x, bending.even.x, squares.y, squares.z, bending.odd.y, bending.odd.z, tm.y + tm.z,
           half_t.y * across_x);
  diagonal(1, cm.y, bending.even.y, squares.z, squares.x, bending.odd.z, bending.odd.x, tm.z + tm.x,
           -(half_t.x * across_y));
  diagonal(2, cm.z, bending.even.z, squares.x, squares.y, bending.odd.x, bending.odd.y, tm.x + tm.y,
           half_t.x * across_y - half_t.y * across_x);
  const auto beside = [&](int i, int j, const T& product, const T& near, const T& far, const T& Q,
                          const T& first_ij, const T& skew_ij, const T& n_a, const T& theta_n_ij,
                          const T& theta_n_ji) {
    const T in_ss = ss(i, j), in_dd = dd(i, j, n_a);
    const T in_sd = sd(i, j, theta_n_ij), in_ds = sd(j, i, theta_n_ji);
    const T same = (in_ss + in_dd) + near * product + T(0.5) * Q;
    const T opposite = in_sd + in_ds + first_ij;
    k.t11[i][j] = k.t11[j][i] = same - opposite;
    k.t22[i][j] = k.t22[j][i] = same + opposite;
    const T even = (in_ss - in_dd) - far * product + Q, odd = (in_sd - in_ds) + skew_ij;
    k.t12[i][j] = even + odd;
    k.t12[j][i] = even - odd;
  };
  beside(0, 1, t.x * t.y, bending.near.z, bending.far.z, sixth.x * m.y + sixth.y * m.x, first.z,
         -skew.z, T(0), half_t.y * across_y, -(half_t.x * across_x));
  beside(0, 2, t.x * t.z, bending.near.y, bending.far.y, sixth.x * m.z + sixth.z * m.x, first.y,
         skew.y, -across_x, -(half_t.z * across_y), T(0));
  beside(1, 2, t.y * t.z, bending.near.x, bending.far.x, sixth.y * m.z + sixth.z * m.y, first.x,
         -skew.x, -across_y, half_t.z * across_x, T(0));
  return k;
}

}  // namespace cosserat_cable::rod
