#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "../../src/rod/element_tangent.h"
#include "tools/validation.h"

namespace cosserat_cable::rod {
namespace {

using V = Vec3<double>;

class ElementTest : public ::testing::Test {
 protected:
  V RandomVector(double size) {
    return {size * normal_(rng_), size * normal_(rng_), size * normal_(rng_)};
  }

  /// Two nodes turned against each other by about `turn` rad, with strains of a few per mille.
  void MakeNodes(double turn) {
    a_.q = Exp(RandomVector(1.0));
    const V theta = RandomVector(turn);
    b_.q = Normalized(a_.q * Exp(theta));
    a_.r = RandomVector(0.1);
    const Mat3<double> middle = ToMatrix(a_.q * Exp(0.5 * theta));
    b_.r = a_.r + middle * (V{0, 0, kH} + RandomVector(2e-3 * kH));
    a_.v = RandomVector(1.0);
    b_.v = a_.v + RandomVector(0.05);
    a_.omega = RandomVector(3.0);
    b_.omega = RandomVector(3.0);
  }

  struct Strained : ElementState<double> {
    V gamma, gamma_dot, kappa, kappa_dot;
  };

  Strained Evaluate(const Node<double>& a, const Node<double>& b) const {
    Strained e;
    EvaluateStrain<double>(a, b, law_.bowing, &e);
    EvaluateStress<double>(ScaledLaw<double>(law_), {}, &e);
    e.gamma = (1 / kH) * e.u;
    e.gamma_dot = (1 / kH) * e.u_rate;
    e.kappa = (1 / kH) * e.theta;
    e.kappa_dot = (1 / kH) * e.theta_rate;
    return e;
  }

  /// Forces and moments on both nodes, in the order r1, phi1, r2, phi2.
  std::array<double, 12> Forces(const Node<double>& a, const Node<double>& b) const {
    const ElementForces<double> k = rod::EvaluateForces<double>(Evaluate(a, b), law_.bowing);
    return {-k.f.x, -k.f.y, -k.f.z, k.g1.x, k.g1.y, k.g1.z,
            k.f.x,  k.f.y,  k.f.z,  k.g2.x, k.g2.y, k.g2.z};
  }

  /// Takes a node to where it is, and how it moves, after a rigid motion of everything.
  std::function<Node<double>(Node<double>)> RandomRigidMotion() {
    const Quat<double> turn = Exp(RandomVector(2.0));
    const Mat3<double> R = ToMatrix(turn);
    const V shift = RandomVector(1.0), v = RandomVector(2.0), w = RandomVector(20.0);
    return [=](Node<double> n) {
      n.q = turn * n.q;
      n.r = R * n.r;
      n.v = R * n.v + v + Cross(w, n.r);
      n.omega = n.omega + TransposeTimes(ToMatrix(n.q), w);
      n.r += shift;
      return n;
    };
  }

  static constexpr double kH = 5e-3;
  std::mt19937 rng_{7};
  std::normal_distribution<double> normal_;
  Node<double> a_{}, b_{};
  // Bowing by numbers of no meaning: what is tested holds for any.
  ElementLaw<double> law_{kH,
                          {667, 600, 2000},
                          {.008, .009, .006},
                          V{},
                          V{},
                          {0, 0, 1},
                          {0.3, 0.7, kH / 24, kH / 20, kH / 30},
                          {}};
};

Node<double> Moved(Node<double> n, int component, double by) {
  V d{};
  (&d.x)[component % 3] = by;
  if (component < 3)
    n.r += d;
  else
    n.q = n.q * Exp(d);
  return n;
}

template <class State>
double StrainEnergy(const State& e, const ElementLaw<double>& law) {
  const V g = e.gamma - law.gamma0;
  return 0.5 * law.h * (Dot(g, Scale(law.C_F, g)) + Dot(e.kappa, Scale(law.C_M, e.kappa)));
}

TEST_F(ElementTest, ForcesAreTheGradientOfTheEnergy) {
  // Central differences: truncation 1e-12 relative, rounding of the energy 1e-16/1e-6.
  constexpr double kRelative = 1e-6;
  for (double turn : {1e-4, 0.05, 0.3, 1.0}) {
    MakeNodes(turn);
    const auto forces = Forces(a_, b_);
    for (int k = 0; k < 12; ++k) {
      const double step = k % 6 < 3 ? 1e-6 * kH : 1e-6;
      const auto energy = [&](double by) {
        return k < 6 ? StrainEnergy(Evaluate(Moved(a_, k, by), b_), law_)
                     : StrainEnergy(Evaluate(a_, Moved(b_, k - 6, by)), law_);
      };
      const double scale = k % 6 < 3 ? 20.0 : 0.3;  // N and N m of this element
      EXPECT_NEAR(forces[k], (energy(step) - energy(-step)) / (2 * step), kRelative * scale)
          << "component " << k << " turn " << turn;
    }
  }
}

TEST_F(ElementTest, StrainRatesAreTheDerivativesOfTheStrains) {
  constexpr double kStep = 1e-6, kTolerance = 1e-6;  // [s]; truncation ~ (rate kStep)^2
  for (double turn : {1e-4, 0.05, 0.5}) {
    MakeNodes(turn);
    const auto at = [&](double t) {
      Node<double> a = a_, b = b_;
      a.r += t * a.v;
      b.r += t * b.v;
      a.q = a.q * Exp(t * a.omega);
      b.q = b.q * Exp(t * b.omega);
      return Evaluate(a, b);
    };
    const auto e = Evaluate(a_, b_), plus = at(kStep), minus = at(-kStep);
    const V gamma = (0.5 / kStep) * (plus.gamma - minus.gamma) - e.gamma_dot;
    const V kappa = (0.5 / kStep) * (plus.kappa - minus.kappa) - e.kappa_dot;
    EXPECT_LT(std::sqrt(Dot(gamma, gamma)), kTolerance * 10);    // of about 10 /s
    EXPECT_LT(std::sqrt(Dot(kappa, kappa)), kTolerance * 1000);  // of about 1000 /(m s)
  }
}

TEST_F(ElementTest, RigidMotionChangesNeitherStrainNorRate) {
  constexpr double kRelative = 1e-12;  // physics: objectivity, a few roundings
  MakeNodes(0.2);
  const auto before = Evaluate(a_, b_);
  const auto moved = RandomRigidMotion();
  const auto after = Evaluate(moved(a_), moved(b_));
  const auto near = [&](const V& x, const V& y, double scale) {
    const V d = x - y;
    EXPECT_LT(std::sqrt(Dot(d, d)), kRelative * scale);
  };
  // Differences of positions of size 1 m over 5 mm cost three digits.
  constexpr double kCancellation = 1e3;
  near(before.gamma, after.gamma, kCancellation);
  near(before.kappa, after.kappa, kCancellation * 100);
  near(before.gamma_dot, after.gamma_dot, kCancellation * 100);
  near(before.kappa_dot, after.kappa_dot, kCancellation * 1000);
}

TEST_F(ElementTest, RigidMotionChangesNeitherEnergyNorDissipation) {
  constexpr double kRelative = 1e-12;
  constexpr int kCases = 200;
  const V V_F{0.01, 0.01, 0.1}, V_M{1e-4, 1e-4, 5e-5};
  const auto power = [&](const Strained& e) {
    return kH *
           (Dot(e.gamma_dot, Scale(V_F, e.gamma_dot)) + Dot(e.kappa_dot, Scale(V_M, e.kappa_dot)));
  };
  // Sums over all cases: of the size, and of the size of the change.
  double energy = 0, energy_change = 0, dissipation = 0, dissipation_change = 0;
  for (int k = 0; k < kCases; ++k) {
    MakeNodes(0.2);
    const auto moved = RandomRigidMotion();
    const Strained before = Evaluate(a_, b_), after = Evaluate(moved(a_), moved(b_));
    energy += StrainEnergy(before, law_);
    energy_change += std::abs(StrainEnergy(after, law_) - StrainEnergy(before, law_));
    dissipation += power(before);
    dissipation_change += std::abs(power(after) - power(before));
  }
  const char* source = "objectivity";
  Validate({"Numerics", "rigid motion of strained elements: relative change of their energy",
            source, 0, energy_change / energy, kRelative, kCases});
  Validate({"Numerics", "rigid motion of strained elements: relative change of their dissipation",
            source, 0, dissipation_change / dissipation, kRelative, kCases});
}

TEST_F(ElementTest, TangentIsTheDerivativeOfTheForcesUpToTheSkewPart) {
  // Off-diagonal quarters and the symmetric part of the diagonal ones, relative to the largest
  // entry. What is left out is of third order in the turn of the element, and the turn times the
  // moment of the shear force over the element: here |n| h/2 = 8e-3 N m.
  for (double turn : {1e-3, 0.03, 0.1, 0.3}) {
    MakeNodes(turn);
    const double tolerance = 1e-6 + 0.2 * turn * turn * turn + 8e-3 * turn;
    const TangentLaw<double> moduli{law_.bowing, (1 / kH) * law_.C_F, (1 / kH) * law_.C_M};
    const auto k = EvaluateTangent<double>(Evaluate(a_, b_), moduli);
    double d[12][12];
    for (int j = 0; j < 12; ++j) {
      const double step = j % 6 < 3 ? 1e-6 * kH : 1e-6;
      const auto at = [&](double by) {
        return j < 6 ? Forces(Moved(a_, j, by), b_) : Forces(a_, Moved(b_, j - 6, by));
      };
      const auto plus = at(step), minus = at(-step);
      for (int i = 0; i < 12; ++i) d[i][j] = (plus[i] - minus[i]) / (2 * step);
    }
    const double rr = 2000 / kH, rt = 2000, tt = 4;  // sizes of the quarters
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        EXPECT_NEAR(k.rr[i][j], d[6 + i][6 + j], tolerance * rr);
        EXPECT_NEAR(-k.rr[i][j], d[6 + i][j], tolerance * rr);
        EXPECT_NEAR(k.r1[i][j], d[6 + i][3 + j], tolerance * rt);
        EXPECT_NEAR(k.r2[i][j], d[6 + i][9 + j], tolerance * rt);
        EXPECT_NEAR(k.t12[i][j], d[3 + i][9 + j], tolerance * tt) << turn;
        EXPECT_NEAR(k.t11[i][j], 0.5 * (d[3 + i][3 + j] + d[3 + j][3 + i]), tolerance * tt) << turn;
        EXPECT_NEAR(k.t22[i][j], 0.5 * (d[9 + i][9 + j] + d[9 + j][9 + i]), tolerance * tt) << turn;
      }
  }
}

}  // namespace
}  // namespace cosserat_cable::rod
