#include "cosserat_cable/contact/contact_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace cosserat_cable {
namespace {

const ContactLaw kLaw{2.0e4, 1.0e-4, 0.5};
const double kBand = kLaw.smoothing;

std::vector<double> Penetrations() {
  return {-kBand,       -0.49 * kBand, -0.3 * kBand, 0,   0.2 * kBand,
          0.49 * kBand, 0.7 * kBand,   1e-3,         5e-3};
}

TEST(ContactLaw, DerivativesMatchFiniteDifferences) {
  // Steps of 1e-4 of the band: truncation of the piecewise-quadratic vanishes but for H, rounding
  // is 1e-16 / 1e-8.
  constexpr double kRelative = 1e-6;
  for (double delta : Penetrations()) {
    for (double rate : {-20.0, -2.0, -0.1, 0.0, 0.3, 2.0, 10.0}) {
      const ContactLaw::Force f = kLaw.Evaluate(delta, rate);
      const double h = 1e-4 * kBand, r = 1e-4;
      const double by_delta =
          (kLaw.Evaluate(delta + h, rate).value - kLaw.Evaluate(delta - h, rate).value) / (2 * h);
      const double by_rate =
          (kLaw.Evaluate(delta, rate + r).value - kLaw.Evaluate(delta, rate - r).value) / (2 * r);
      EXPECT_NEAR(f.by_penetration, by_delta, kRelative * (1 + std::abs(by_delta)));
      EXPECT_NEAR(f.by_rate, by_rate, kRelative * (1 + std::abs(by_rate)));
      const double by_energy = (kLaw.Energy(delta + h) - kLaw.Energy(delta - h)) / (2 * h);
      const double elastic = kLaw.Evaluate(delta, 0).value;
      EXPECT_NEAR(by_energy, elastic, kRelative * (1 + elastic));
    }
  }
}

TEST(ContactLaw, LinearBeyondTheBandAndNothingBeforeIt) {
  constexpr double kRounding = 1e-12;
  EXPECT_EQ(kLaw.Evaluate(-kBand / 2, 1.0).value, 0);
  EXPECT_EQ(kLaw.Evaluate(-1, 1.0).value, 0);
  EXPECT_EQ(kLaw.Evaluate(-std::numeric_limits<double>::infinity(), 1.0).value, 0);
  EXPECT_EQ(kLaw.Energy(-1), 0);
  EXPECT_NEAR(kLaw.Evaluate(1e-3, 0).value, 20.0, kRounding);
  EXPECT_NEAR(kLaw.Evaluate(1e-3, 0).by_penetration, 2e4, kRounding);
}

TEST(ContactLaw, ValueAndSlopeAreContinuousAtTheBandsEnds) {
  for (double end : {-kBand / 2, kBand / 2}) {
    const double hair = 1e-9 * kBand;
    const ContactLaw::Force before = kLaw.Evaluate(end - hair, 0.7);
    const ContactLaw::Force after = kLaw.Evaluate(end + hair, 0.7);
    const double kJump = 4 * hair * kLaw.stiffness;  // what the slope alone accounts for
    EXPECT_NEAR(before.value, after.value, kJump);
    // The slope changes by k H / band over the band, so by 2e-9 of it over two hairs.
    EXPECT_NEAR(before.by_penetration, after.by_penetration, 1e-8 * kLaw.stiffness);
    EXPECT_NEAR(kLaw.Energy(end - hair), kLaw.Energy(end + hair), kJump * kBand);
  }
}

TEST(ContactLaw, DampingIsHuntCrossleyAtSmallRates) {
  const double elastic = kLaw.Evaluate(1e-3, 0).value;
  for (double rate : {-0.01, 0.01}) {
    const double u = kLaw.damping * rate;
    // The factor's second-order term, u^2 / 2, is the whole difference.
    EXPECT_NEAR(kLaw.Evaluate(1e-3, rate).value, elastic * (1 + u), elastic * 0.51 * u * u);
  }
  EXPECT_DOUBLE_EQ(kLaw.Evaluate(1e-3, 0).by_rate, elastic * kLaw.damping);
}

TEST(ContactLaw, NeverPullsNeverKinksAndRisesWithTheRate) {
  double last = 0;
  for (double rate = -1e6; rate < 1e6;
       rate = rate < 0 ? (rate > -1e-3 ? 1e-3 : rate / 1.1) : rate * 1.1) {
    const ContactLaw::Force f = kLaw.Evaluate(1e-3, rate);
    ASSERT_GT(f.value, last) << rate;
    ASSERT_GT(f.by_rate, 0) << rate;
    last = f.value;
  }
}

TEST(ContactLaw, DampingOnlyTakesEnergy) {
  for (double rate : {-5.0, -1.0, -0.01, 0.01, 1.0, 5.0}) {
    const double damping_force = kLaw.Evaluate(1e-3, rate).value - kLaw.Evaluate(1e-3, 0).value;
    EXPECT_GT(damping_force * rate, 0);
  }
}

TEST(ContactLaw, NoBandAtAllIsAPlainPenalty) {
  const ContactLaw sharp{1e4, 0, 0};
  EXPECT_EQ(sharp.Evaluate(0, 0).value, 0);
  EXPECT_DOUBLE_EQ(sharp.Evaluate(1e-3, 0).value, 10);
  EXPECT_DOUBLE_EQ(sharp.Energy(1e-3), 5e-3);
}

}  // namespace
}  // namespace cosserat_cable
