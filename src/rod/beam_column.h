// An element under tension: what a beam-column's stability functions make of its bending stiffness
// and of the stretch that its bending takes up (bowing).
//
// Between its nodes a taut element bends where its ends turn, over sqrt(EI/T), and is straight in
// between; under T h^2/EI >> 1 that is much less than h. The potential of its bending about one
// axis under a tension T, the energy of the tension's way included, is exactly
//
//     V = D(T) theta^2/(2h) + k(T) h sigma^2/2        z = sqrt(T/EI) h/2,  y = z^2,
//     D = EI f,           f(y) = z coth z             = 1 + y/3 - y^2/45 + ...
//     k = 12 EI/h^2 g,    g(y) = y/(3(f - 1))         = 1 + y/15 - ...
//
// (Livesley and Chandler 1956), where its ends are turned against each other by theta and both
// against the chord by sigma. By the envelope theorem dV/dT is the way of the tension: of the
// element's stretch, bending takes up
//
//     D'(T)/(2h^2) theta^2 + (k'(T)/2) sigma^2        (the bowing functions of Oran 1973)
//
// and V - T dV/dT is what is stored in bending, with the stiffnesses D - T D' and k - T k'. At T =
// 0 these are EI and 12 EI/h^2, theta^2/24 and sigma^2/10: of a parabola and of a cubic. With them
// alone a clamp of a string would reach 0.12 h into it, instead of sqrt(EI/T).
//
// The functions are evaluated at a tension that was known before the step, or round of statics. As
// the potential is stationary at its own tension, forces and energies are in error by the square of
// the difference. That tension follows the element's own. It must not do so at once: what bending
// takes up falls with the tension, by c = -d(way)/dT, so that a tension which is too high in one
// step makes one that is too low in the next, by c times the stiffness of what holds the chord.
// That is inertia, of a short step, and stretching at most: K, of the element. Where c K > 1, which
// a flexible cable of few elements has at rest, the tension would swing to and fro and grow. By
// 1/(1 + c K) of the way in a step (Newton's, of an element whose nodes are held) it never does,
// for any step and any number of elements: those of a chain share its chord by their compliances.
#pragma once

#include "cosserat_cable/math/lanes.h"

namespace cosserat_cable::rod {

/// Along, or about, a1 and a2.
template <class T>
struct PerAxis {
  T x, y;
};

/// h Gamma_3 = along_normal chord_3 + along_chord |chord| + bend_1 theta_1^2 + bend_2 theta_2^2.
/// All but the first are negative of an element that is seen from its other end.
template <class T>
struct Bowing {
  T along_normal, along_chord;
  T twist;           ///< h/24 [m]: of theta_3 theta, which is across
  T bend_x, bend_y;  ///< [m]
};

template <class To, class From>
Bowing<To> Converted(const Bowing<From>& b) {
  return {Converted<To>(b.along_normal), Converted<To>(b.along_chord), Converted<To>(b.twist),
          Converted<To>(b.bend_x), Converted<To>(b.bend_y)};
}

/// Bending about one axis and the shear that goes with it, as a tension finds them.
template <class T>
struct BeamColumnAxis {
  T slenderness;  ///< h^2/(4 EI) [1/N]: y by T
  T C_M, V_M;     ///< EI [N m^2], eta_EI [N m^2 s]
  T C_F, V_F;     ///< beta^2 12 EI/h^2 [N], beta^2 12 eta_EI/h^2 [N s]
};
template <class T>
struct BeamColumn {
  BeamColumnAxis<T> x, y;  ///< bending about a1 with shear along a2, and about a2 with a1
  T bend;                  ///< h [m], and
  T shear;                 ///< beta_1 beta_2; signs as in Bowing
};

/// What a tension adds to an element's law: nothing to one that is slack.
template <class T>
struct AxisStiffening {
  T C_M, V_M, C_F, V_F;
};
template <class T>
struct Stiffening {
  AxisStiffening<T> x, y;         ///< as in BeamColumn
  T bend_x, bend_y, along_chord;  ///< of Bowing
};

/// Of y. Below the first, the functions are those without tension to 2e-7; beyond the second they
/// go on along their tangents: a layer that is thinner than h/200 is not told from that, and nodes
/// do not get free to turn.
inline constexpr double kSlackBelow = 2.5e-3, kTautAbove = 1e4;

/// f and g with their slopes; less f and g, what is (f - 1) - y f', which is y^2/45 where y is
/// small, and the same of g.
template <class T>
struct StabilityFunctions {
  explicit StabilityFunctions(const T& y) {
    // (sinh z)/z; where nine terms are too few, f is next to z.
    T sinh = T(1.0 / 355687428096000);
    for (double term : {1.0 / 1307674368000, 1.0 / 6227020800, 1.0 / 39916800, 1.0 / 362880,
                        1.0 / 5040, 1.0 / 120, 1.0 / 6, 1.0})
      sinh = sinh * y + T(term);
    const T S = T(1.0) / (sinh * sinh), f = Sqrt(y + S), bent = f - T(1.0), over = T(1.0) / bent;
    f_slope = T(0.5) * (f - S) / y;
    f_stored = bent - y * f_slope;
    g_slope = T(1.0 / 3) * f_stored * over * over;
    g_stored = (T(1.0 / 3) * y * over - T(1.0)) - y * g_slope;
  }
  T f_slope, f_stored, g_slope, g_stored;
};

/// Of an element under the tension that its nodes feel [N].
template <class T>
Stiffening<T> EvaluateStiffening(const BeamColumn<T>& column, const T& tension) {
  const auto functions = [&](const BeamColumnAxis<T>& axis) {
    return StabilityFunctions<T>(
        Min(Max(tension * axis.slenderness, T(kSlackBelow)), T(kTautAbove)));
  };
  const StabilityFunctions<T> x = functions(column.x), y = functions(column.y);
  // Of a flat element the stretch goes with the lesser of two slopes; what the other one is more,
  // is stiffness.
  const T slope = Min(x.g_slope, y.g_slope);
  const T slenderer = Max(column.x.slenderness, column.y.slenderness);
  const auto axis = [&](const BeamColumnAxis<T>& of, const StabilityFunctions<T>& at) {
    const T y = tension * of.slenderness;
    const T bending = WhereAtLeast(y, kSlackBelow, at.f_stored);
    const T shear = WhereAtLeast(y, kSlackBelow, at.g_stored) +
                    WhereAtLeast(tension * slenderer, kSlackBelow, y * (at.g_slope - slope));
    return AxisStiffening<T>{bending * of.C_M, bending * of.V_M, shear * of.C_F, shear * of.V_F};
  };
  const auto bend = [&](const BeamColumnAxis<T>& of, const StabilityFunctions<T>& at) {
    const T less = T(0.125) * (at.f_slope - T(1.0 / 3));
    return WhereAtLeast(tension * of.slenderness, kSlackBelow, less) * column.bend;
  };
  const T along = T(3.0) * (slope - T(1.0 / 15));
  return {axis(column.x, x), axis(column.y, y), bend(column.x, x), bend(column.y, y),
          WhereAtLeast(tension * slenderer, kSlackBelow, along) * column.shear};
}

/// No less than -f'' and -g'' of y >= 0, and by a third more at most.
template <class T>
T BoundOfCurvature(const T& y, double at_zero, double decay) {
  constexpr double kAbove = 1.3;
  const T one_over = T(1.0) / (T(1.0) + T(decay) * y);
  return T(kAbove * at_zero) * one_over * Sqrt(one_over);
}

/// How much less stretch an element's bending takes up per tension, at least at `tension` >= 0
/// [m/N]: of one that is turned by `theta`, and whose chord is longer by `aside` than its part
/// along the normal.
template <class T>
T WayPerTension(const BeamColumn<T>& column, const T& tension, const PerAxis<T>& theta,
                const T& aside) {
  const auto bend = [&](const BeamColumnAxis<T>& axis, const T& angle) {
    return axis.slenderness * angle * angle *
           BoundOfCurvature(tension * axis.slenderness, 2.0 / 45, 0.3);
  };
  const T slenderer = Max(column.x.slenderness, column.y.slenderness);
  return T(0.125) * Abs(column.bend) * (bend(column.x, theta.x) + bend(column.y, theta.y)) +
         T(3.0) * Abs(column.shear) * aside * slenderer *
             BoundOfCurvature(tension * slenderer, 2.0 / 525, 0.12);
}

/// The tension that the next step's law is evaluated at, [N], at least 0: from that of the last one
/// towards the one found. `stiffness`: of the element against stretching, over a step [N/m].
template <class T>
T Followed(const T& last, const T& found, const T& way_per_tension, const T& stiffness) {
  return last + (Max(found, T(0.0)) - last) / (T(1.0) + way_per_tension * stiffness);
}

/// `sense`: 1, or -1 of an element that is seen from its other end.
template <class T>
Bowing<T> Bowed(const Bowing<T>& slack, const Stiffening<T>& by, const T& sense) {
  return {slack.along_normal - sense * by.along_chord, slack.along_chord + by.along_chord,
          slack.twist, slack.bend_x + by.bend_x, slack.bend_y + by.bend_y};
}

}  // namespace cosserat_cable::rod
