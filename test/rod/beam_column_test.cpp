// The functions of a taut element against the hyperbolic ones of the textbook.
#include "../../src/rod/beam_column.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace cosserat_cable::rod {
namespace {

constexpr double kH = 0.1, kEI = 0.02, kEta = 1e-4;

double F(double y) {
  const double z = std::sqrt(y);
  return z / std::tanh(z);
}
double G(double y) { return y / (3 * (F(y) - 1)); }

BeamColumnAxis<double> Axis(double EI) {
  return {kH * kH / (4 * EI), EI, EI / kEI * kEta, 12 * EI / (kH * kH),
          12 * EI / kEI * kEta / (kH * kH)};
}

/// What bends about one axis with theta^2/(2h), and shears with it by h (w/h)^2/2, in all: the
/// law's own, what the tension adds, and the tension times the stretch that is taken up.
struct Whole {
  double bending, shear;  // [N m^2], [N]
};
Whole AboutX(const BeamColumn<double>& column, double tension) {
  const Stiffening<double> by = EvaluateStiffening(column, tension);
  const Bowing<double> bowed = Bowed({-0.2, 1.2, kH / 24, kH / 24, kH / 24}, by, 1.0);
  return {column.x.C_M + by.x.C_M + tension * 2 * kH * bowed.bend_x,
          // Turned alike, the normal's part of the chord falls by (w/h)^2/2.
          column.x.C_F + by.x.C_F - tension * bowed.along_normal};
}

TEST(BeamColumnTest, StiffnessUnderTensionIsTheTextbooks) {
  constexpr double kWithin = 1e-6;  // of nine terms of sinh, and of the limits of y
  const BeamColumn<double> column = {Axis(kEI), Axis(kEI), kH, 1.0};
  for (double tension = 1e-3; tension < 1e4; tension *= 1.7) {
    const double y = tension * column.x.slenderness;
    if (y > kTautAbove) break;
    const Whole whole = AboutX(column, tension);
    EXPECT_NEAR(whole.bending, kEI * F(y), kWithin * kEI * F(y)) << y;
    const double k = 12 * kEI / (kH * kH) * G(y);
    EXPECT_NEAR(whole.shear, k, kWithin * k) << y;
  }
}

TEST(BeamColumnTest, OfAFlatElementEachDirectionHasItsOwnStiffness) {
  constexpr double kWithin = 1e-6;
  for (const double flat : {0.01, 30.0})
    for (double tension = 1e-2; tension < 1e4; tension *= 3) {
      const BeamColumn<double> column = {Axis(kEI), Axis(flat * kEI), kH, 1.0};
      const double y = tension * column.x.slenderness;
      const double k = 12 * kEI / (kH * kH) * G(y);
      EXPECT_NEAR(AboutX(column, tension).shear, k, kWithin * k) << flat << " " << y;
    }
}

TEST(BeamColumnTest, ThePotentialIsStationaryInTheTensionOfTheLaw) {
  // Stored energy and tension times way, with the law at another tension: least change at its own.
  const BeamColumn<double> column = {Axis(kEI), Axis(kEI), kH, 1.0};
  constexpr double kStep = 1e-3, kWithin = 1e-4;  // relative; what is left is of third order
  for (const double tension : {2.0, 30.0, 800.0}) {
    const auto potential = [&](double at) {
      const Stiffening<double> by = EvaluateStiffening(column, at);
      return Whole{by.x.C_M + tension * 2 * kH * by.bend_x, by.x.C_F + tension * by.along_chord};
    };
    const Whole up = potential(tension * (1 + kStep)), down = potential(tension * (1 - kStep));
    EXPECT_NEAR((up.bending - down.bending) / kStep, 0, kWithin * kEI * F(tension)) << tension;
    EXPECT_NEAR((up.shear - down.shear) / kStep, 0, kWithin * column.x.C_F * G(tension));
  }
}

TEST(BeamColumnTest, SlackAndPressedElementsAreLeftAlone) {
  const BeamColumn<double> column = {Axis(kEI), Axis(2 * kEI), kH, 1.0};
  for (const double tension : {-1e3, -1.0, 0.0, 0.9 * kSlackBelow / column.x.slenderness}) {
    const Stiffening<double> by = EvaluateStiffening(column, tension);
    for (const double more : {by.x.C_M, by.x.V_M, by.x.C_F, by.x.V_F, by.y.C_M, by.y.C_F, by.bend_x,
                              by.bend_y, by.along_chord})
      EXPECT_EQ(more, 0) << tension;
  }
}

TEST(BeamColumnTest, TheWayThatATensionTakesBackIsBounded) {
  const BeamColumn<double> column = {Axis(kEI), Axis(3 * kEI), kH, 1.0};
  constexpr double kStep = 1e-3;  // relative
  for (const PerAxis<double> theta : {PerAxis<double>{0.3, 0.0}, PerAxis<double>{0.1, 0.2}})
    for (double tension = 0.1; tension < 1e4; tension *= 3) {
      const auto way = [&](double at) {
        const Stiffening<double> by = EvaluateStiffening(column, at);
        return by.bend_x * theta.x * theta.x + by.bend_y * theta.y * theta.y;
      };
      const double falls =
          (way(tension * (1 - kStep)) - way(tension * (1 + kStep))) / (2 * kStep * tension);
      const double bound = WayPerTension(column, tension, theta, 0.0);
      EXPECT_GT(bound, 0.99 * falls) << tension;
      if (tension * column.x.slenderness < 0.5 * kTautAbove) {
        EXPECT_LT(bound, 1.5 * falls + 1e-15);
      }
    }
}

TEST(BeamColumnTest, ATensionIsFollowedWithoutSwinging) {
  // Held as stiffly as can be, what comes out falls by c K of what the law was evaluated at.
  for (const double gain : {0.1, 1.0, 30.0}) {
    double last = 5;
    for (int step = 0; step < 300; ++step) {
      const double next = Followed(last, 2 + gain * (2 - last), gain, 1.0);
      EXPECT_LE(std::abs(next - 2), std::abs(last - 2));
      last = next;
    }
    EXPECT_NEAR(last, 2, 1e-9);
  }
  EXPECT_EQ(Followed(0.0, -3.0, 0.0, 1.0), 0);
}

TEST(BeamColumnTest, NothingIsInfiniteHoweverTaut) {
  const BeamColumn<double> column = {Axis(1e-12), Axis(kEI), kH, 1.0};
  const Stiffening<double> by = EvaluateStiffening(column, 1e6);
  EXPECT_TRUE(std::isfinite(by.x.C_M + by.x.C_F + by.y.C_F + by.bend_x + by.along_chord));
  EXPECT_GT(by.x.C_M, 0);
}

}  // namespace
}  // namespace cosserat_cable::rod
