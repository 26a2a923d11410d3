#include "cosserat_cable/math/pose_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "math/motion_reference.h"

namespace cosserat_cable {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

struct Sample {
  double time;
  Pose X;
};

Pose At(const Vector3d& p) { return {p, Quaterniond::Identity()}; }

/// Samples of `pose_at` every 1/rate from `begin`, stamps jittered by up to `jitter` periods.
template <class PoseAt>
std::vector<Sample> Sampled(const PoseAt& pose_at, double rate, double begin, int count,
                            double jitter = 0) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> spread(-jitter, jitter);
  std::vector<Sample> samples;
  for (int i = 0; i < count; ++i) {
    const double time = begin + (i + (jitter > 0 ? spread(random) : 0)) / rate;
    samples.push_back({time, pose_at(time)});
  }
  return samples;
}

PoseCurve CurveThrough(const std::vector<Sample>& samples, double max_gap = 0.25) {
  PoseCurve curve(max_gap);
  for (const Sample& sample : samples) curve.Append(sample.time, sample.X);
  curve.Finish();
  return curve;
}

// ---- Accuracy ---------------------------------------------------------------------------------

constexpr double kAmplitude = 2e-3;  // [m]
constexpr double kRate = 100;        // [Hz]

/// Largest error of position, as a part of the amplitude, away from the ends.
double SineError(double frequency, double jitter) {
  const double w = 2 * M_PI * frequency;
  const auto pose_at = [w](double t) { return At({kAmplitude * std::sin(w * t), 0, 0}); };
  const PoseCurve curve = CurveThrough(Sampled(pose_at, kRate, 0, 200, jitter));
  double worst = 0;
  for (double t = 0.3; t < 1.7; t += 0.00037) {
    worst = std::max(worst, (curve.Evaluate(t).X.p - pose_at(t).p).norm());
  }
  return worst / kAmplitude;
}

TEST(PoseCurve, FollowsASineOfThreeSamplesAPeriod) {
  EXPECT_LT(SineError(30, 0), 0.0008);    // twice what a degree 9 spline on these windows leaves
  EXPECT_LT(SineError(30, 0.1), 0.004);   // the requirement on the clamp motion
  EXPECT_LT(SineError(20, 0.1), 0.0004);  // below 5 samples a period it falls with the tenth power
  EXPECT_LT(SineError(10, 0.3), 0.0002);
}

TEST(PoseCurve, FollowsTheSinesAcceleration) {
  // Straight lines between the samples have no acceleration but impulses at the knots: the velocity
  // jumps by up to A rate 4 sin^2(w / (2 rate)) = 0.52 m/s, where the true motion's acceleration,
  // at most 71 m/s^2, changes it by 0.71 m/s over a whole period.
  constexpr double kPart = 0.01;
  const double w = 2 * M_PI * 30;
  const auto pose_at = [w](double t) { return At({kAmplitude * std::sin(w * t), 0, 0}); };
  const PoseCurve curve = CurveThrough(Sampled(pose_at, kRate, 0, 200));
  double largest_jump = 0;
  for (int i = 30; i < 170; ++i) {
    const double t = i / kRate;
    EXPECT_NEAR(curve.Evaluate(t).a.x(), -kAmplitude * w * w * std::sin(w * t),
                kPart * kAmplitude * w * w);
    const double x[] = {pose_at(t - 1 / kRate).p.x(), pose_at(t).p.x(),
                        pose_at(t + 1 / kRate).p.x()};
    largest_jump = std::max(largest_jump, std::abs(x[2] - 2 * x[1] + x[0]) * kRate);
  }
  EXPECT_GT(largest_jump, 0.45);  // [m/s]; no sample meets the sine's very top
}

TEST(PoseCurve, IsExactForCubics) {
  constexpr double kTolerance = 1e-9;
  const auto pose_at = [](double t) {
    return At({0.3 + 0.2 * t - 0.4 * t * t + 0.1 * t * t * t, 12 * t, -1 + 2 * t * t * t});
  };
  for (const double jitter : {0.0, 0.3}) {
    const PoseCurve curve = CurveThrough(Sampled(pose_at, kRate, 0, 60, jitter));
    for (double t = curve.begin_time(); t <= curve.end_time(); t += 0.00037) {
      const Motion motion = curve.Evaluate(t);
      EXPECT_LT((motion.X.p - pose_at(t).p).norm(), kTolerance) << t;
      EXPECT_NEAR(motion.v.y(), 12, kTolerance) << t;
      // Divided by the period twice.
      EXPECT_NEAR(motion.a.z(), 12 * t, kTolerance * kRate * kRate) << t;
    }
  }
}

TEST(PoseCurve, KeepsItsDigitsFarFromTheOriginAndAtUnixTime) {
  // Stamps of today are multiples of 2.4e-7 s as doubles, positions of a map of 1e-10 m.
  constexpr double kNow = 1.7e9, kTolerance = 1e-6;  // [m]: 2.4e-7 s at 1 m/s, and a margin
  const auto pose_at = [](double t) { return At({500000, 5000000, std::sin(t - kNow)}); };
  const PoseCurve curve = CurveThrough(Sampled(pose_at, 500, kNow, 100));
  for (double t = kNow + 0.05; t < kNow + 0.15; t += 0.0007) {
    const Motion motion = curve.Evaluate(t);
    EXPECT_LT((motion.X.p - pose_at(t).p).norm(), kTolerance);
    EXPECT_NEAR(motion.a.z(), -std::sin(t - kNow), 1e-2);
  }
}

// ---- Rotation ---------------------------------------------------------------------------------

TEST(PoseCurve, FollowsARotationAboutAFixedAxis) {
  constexpr double kTolerance = 1e-8;  // [rad]: 2 Hz at 50 samples a period
  const Vector3d axis = Vector3d(1, 2, -2) / 3;
  const double w = 2 * M_PI * 2;
  const auto pose_at = [&](double t) {
    return Pose{Vector3d::Zero(), AxisTurn(axis, 0.5 * std::sin(w * t))};
  };
  const PoseCurve curve = CurveThrough(Sampled(pose_at, kRate, 0, 100));
  for (double t = 0.2; t < 0.8; t += 0.0007) {
    const Motion motion = curve.Evaluate(t);
    EXPECT_LT(motion.X.q.angularDistance(pose_at(t).q), kTolerance);
    EXPECT_LT((motion.omega - axis * 0.5 * w * std::cos(w * t)).norm(), kTolerance * kRate);
    EXPECT_LT((motion.alpha + axis * 0.5 * w * w * std::sin(w * t)).norm(),
              10 * kTolerance * kRate * kRate);
  }
}

TEST(PoseCurve, FollowsASpinningWheelExactly) {
  constexpr double kTolerance = 1e-11;  // [rad]
  const double spin = 200;              // [rad/s]: 2 rad a sample, 6 turns in a window
  const auto pose_at = [&](double t) {
    return Pose{Vector3d::Zero(), AxisTurn({0, 1, 0}, spin * t)};
  };
  const PoseCurve curve = CurveThrough(Sampled(pose_at, kRate, 0, 60, 0.1));
  for (double t = 0.01; t < 0.58; t += 0.0007) {
    const Motion motion = curve.Evaluate(t);
    EXPECT_LT(motion.X.q.angularDistance(pose_at(t).q), kTolerance);
    EXPECT_LT((motion.omega - Vector3d(0, spin, 0)).norm(), kTolerance * kRate);
    EXPECT_LT(motion.alpha.norm(), 10 * kTolerance * kRate * kRate);
  }
}

TEST(PoseCurve, FollowsConing) {
  // R = R_z(a t) R_x(tilt) R_z(b t): in body axes the precession about z turns with the spin,
  // omega = b e_z + a R^T e_z, alpha = -omega x a R^T e_z. A steering wheel of a rolling car.
  constexpr double kTolerance = 1e-7;  // [rad]: 0.5 rad a sample
  const double a = 3, b = 46, tilt = 0.4;
  const auto rotation = [&](double t) {
    return AxisTurn({0, 0, 1}, a * t) * AxisTurn({1, 0, 0}, tilt) * AxisTurn({0, 0, 1}, b * t);
  };
  const auto pose_at = [&](double t) { return Pose{Vector3d::Zero(), rotation(t)}; };
  const PoseCurve curve = CurveThrough(Sampled(pose_at, kRate, 0, 100));
  for (double t = 0.2; t < 0.8; t += 0.0007) {
    const Motion motion = curve.Evaluate(t);
    const Vector3d precession = a * (rotation(t).conjugate() * Vector3d::UnitZ());
    const Vector3d omega = precession + b * Vector3d::UnitZ();
    EXPECT_LT(motion.X.q.angularDistance(pose_at(t).q), kTolerance);
    EXPECT_LT((motion.omega - omega).norm(), 10 * kTolerance * kRate);
    EXPECT_LT((motion.alpha + omega.cross(precession)).norm(), 100 * kTolerance * kRate * kRate);
  }
}

// ---- Smoothness -------------------------------------------------------------------------------

/// A tumbling body, with neither symmetry nor a fixed axis.
Pose Tumbling(double t) {
  return {{0.1 * std::sin(30 * t), 0.2 * std::cos(11 * t), 3 * t + 0.05 * std::sin(50 * t)},
          AxisTurn({1, 0.3, 0}, 2 * std::sin(9 * t)) * AxisTurn({0, 1, -0.5}, 4 * t) *
              AxisTurn({0, 0, 1}, 0.5 * std::sin(23 * t))};
}

void ExpectNear(const Motion& motion, const Motion& reference, double tolerance) {
  EXPECT_LT((motion.X.p - reference.X.p).norm(), tolerance);
  EXPECT_LT((motion.X.q.coeffs() - reference.X.q.coeffs()).norm(), tolerance);
  EXPECT_LT((motion.v - reference.v).norm(), tolerance);
  EXPECT_LT((motion.a - reference.a).norm(), tolerance);
  EXPECT_LT((motion.omega - reference.omega).norm(), tolerance);
  EXPECT_LT((motion.alpha - reference.alpha).norm(), tolerance);
}

TEST(PoseCurve, RatesAreTheDerivativesOfThePose) {
  constexpr double kStep = 1e-5;       // [s]
  constexpr double kTolerance = 2e-4;  // step^2 times fourth derivatives below 1e6; rounding 1e-16
                                       // times 3 m over step^2 = 3e-6
  for (const double jitter : {0.0, 0.3}) {
    const PoseCurve curve = CurveThrough(Sampled(Tumbling, kRate, 0, 60, jitter));
    const auto pose_at = [&curve](double t) { return curve.Evaluate(t).X; };
    for (double t = 0.05; t < 0.55; t += 0.0037) {
      ExpectNear(curve.Evaluate(t), DifferencedMotion(pose_at, t, kStep), kTolerance);
    }
  }
}

TEST(PoseCurve, IsTwiceContinuouslyDifferentiableAtKnots) {
  constexpr double kAside = 1e-10;  // [s]
  constexpr double kTolerance =
      5e-4;  // third derivatives, below 2e6 beside the gap, times twice that
  std::vector<Sample> samples = Sampled(Tumbling, kRate, 0, 60, 0.3);
  samples.erase(samples.begin() + 20);                                     // a lost sample,
  samples.erase(samples.begin() + 30, samples.begin() + 34);               // a hole,
  for (std::size_t i = 45; i < samples.size(); ++i) samples[i].time += 1;  // and a gap
  const PoseCurve curve = CurveThrough(samples);
  ASSERT_EQ(curve.gap_count(), 1u);
  for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
    const double t = samples[i].time;
    ExpectNear(curve.Evaluate(t - kAside), curve.Evaluate(t + kAside), kTolerance);
    EXPECT_LT((curve.Evaluate(t).X.p - samples[i].X.p).norm(), 1e-15);
    EXPECT_LT(curve.Evaluate(t).X.q.angularDistance(samples[i].X.q), 1e-15);
  }
}

// ---- Ends, gaps and holes ---------------------------------------------------------------------

TEST(PoseCurve, HoldsItsEnds) {
  const std::vector<Sample> samples = Sampled(Tumbling, kRate, 5, 40);
  const PoseCurve curve = CurveThrough(samples);
  EXPECT_EQ(curve.begin_time(), samples.front().time);
  EXPECT_EQ(curve.end_time(), samples.back().time);
  EXPECT_EQ(curve.ready_until(), samples.back().time);
  for (const double t : {-100.0, 4.999}) {
    ExpectNear(curve.Evaluate(t), Motion::Resting(samples.front().X), 1e-15);
  }
  for (const double t : {5.391, 100.0}) {
    ExpectNear(curve.Evaluate(t), Motion::Resting(samples.back().X), 1e-15);
  }
}

TEST(PoseCurve, HoldsAndBlendsAcrossGaps) {
  constexpr double kMaxGap = 0.2;
  std::vector<Sample> samples = Sampled(Tumbling, kRate, 0, 80);
  samples.erase(samples.begin() + 30, samples.begin() + 61);  // 0.29 s to 0.61 s
  const PoseCurve curve = CurveThrough(samples, kMaxGap);
  const Pose before = samples[29].X, after = samples[30].X;
  EXPECT_EQ(curve.gap_count(), 1u);
  EXPECT_FALSE(curve.InGap(0.285));
  EXPECT_TRUE(curve.InGap(0.3));
  EXPECT_TRUE(curve.InGap(0.6));
  EXPECT_FALSE(curve.InGap(0.615));
  EXPECT_FALSE(curve.InGap(-1));
  EXPECT_FALSE(curve.InGap(2));
  for (const double t : {0.29, 0.3, 0.4099}) {
    ExpectNear(curve.Evaluate(t), Motion::Resting(before), 1e-14);
  }
  ExpectNear(curve.Evaluate(0.61), Motion::Resting(after), 1e-12);
  // Rest to rest: half-way at half time, at 15/8 of the mean velocity.
  const Motion middle = curve.Evaluate(0.51);
  EXPECT_LT((middle.X.p - 0.5 * (before.p + after.p)).norm(), 1e-12);
  EXPECT_LT((middle.v - 15.0 / 8 * (after.p - before.p) / kMaxGap).norm(), 1e-9);
  EXPECT_NEAR(middle.X.q.angularDistance(before.q), middle.X.q.angularDistance(after.q), 1e-12);
}

TEST(PoseCurve, AGapIsFinalOnceItHasEnded) {
  PoseCurve curve;
  curve.Append(0, At({0, 0, 0}));
  curve.Append(0.01, At({0, 0, 0.1}));
  EXPECT_EQ(curve.ready_until(), -std::numeric_limits<double>::infinity());
  curve.Append(1, At({0, 0, 1}));
  EXPECT_EQ(curve.ready_until(), 1);
  EXPECT_EQ(curve.gap_count(), 1u);
}

TEST(PoseCurve, DoesNotRunAwayInAHole) {
  // 500 Hz, rounded to 0.1 mm, 100 samples lost: accelerations at the sides of the hole are all
  // rounding, hundreds of m/s^2, and over 0.2 s would carry the curve a metre away.
  constexpr double kExcursion = 0.02;  // [m] beyond the motion's own 20 mm
  const auto pose_at = [](double t) {
    return At({std::round(0.02 * std::sin(10 * t) / 1e-4) * 1e-4, 0, 0});
  };
  for (int start = 200; start < 400; start += 13) {
    std::vector<Sample> samples = Sampled(pose_at, 500, 0, 700);
    samples.erase(samples.begin() + start, samples.begin() + start + 100);
    const PoseCurve curve = CurveThrough(samples);
    EXPECT_EQ(curve.gap_count(), 0u);
    for (double t = 0; t < 1.39; t += 0.001) {
      EXPECT_LT(std::abs(curve.Evaluate(t).X.p.x()), 0.02 + kExcursion) << t << " " << start;
    }
  }
}

TEST(PoseCurve, SingleSamplesAmongHolesAreFinite) {
  PoseCurve curve;
  for (int i = 0; i < 40; ++i) {
    const double t = 0.01 * i + (i > 10 ? 0.1 : 0) + (i > 11 ? 0.1 : 0) + (i > 13 ? 0.1 : 0);
    ASSERT_TRUE(curve.Append(t, Tumbling(t)));
  }
  curve.Finish();
  EXPECT_EQ(curve.gap_count(), 0u);
  for (double t = 0; t < curve.end_time(); t += 0.001) {
    const Motion motion = curve.Evaluate(t);
    EXPECT_LT((motion.X.p - Tumbling(t).p).norm(), 0.5);  // finite, and not far
    EXPECT_TRUE(motion.alpha.allFinite());
  }
}

TEST(PoseCurve, FewSamples) {
  PoseCurve curve;
  EXPECT_TRUE(curve.empty());
  EXPECT_EQ(curve.ready_until(), -std::numeric_limits<double>::infinity());
  EXPECT_FALSE(curve.InGap(0));
  curve.DropBefore(1);
  curve.Append(1, At({1, 0, 0}));
  ExpectNear(curve.Evaluate(1), Motion::Resting(At({1, 0, 0})), 1e-15);
  curve.Append(1.1, At({2, 0, 0}));
  // Two samples: a straight line.
  EXPECT_NEAR(curve.Evaluate(1.05).v.x(), 10, 1e-12);
  EXPECT_NEAR(curve.Evaluate(1.05).a.x(), 0, 1e-10);
}

// ---- Bad samples ------------------------------------------------------------------------------

TEST(PoseCurve, IgnoresAndCountsWhatIsNoSample) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  PoseCurve curve;
  EXPECT_TRUE(curve.Append(1, At({0, 0, 0})));
  EXPECT_FALSE(curve.Append(kNan, At({0, 0, 0})));
  EXPECT_FALSE(curve.Append(kInf, At({0, 0, 0})));
  EXPECT_FALSE(curve.Append(2, At({0, kNan, 0})));
  EXPECT_FALSE(curve.Append(2, At({0, 0, kInf})));
  EXPECT_FALSE(curve.Append(2, {Vector3d::Zero(), Quaterniond(kNan, 0, 0, 0)}));
  EXPECT_FALSE(curve.Append(2, {Vector3d::Zero(), Quaterniond(0, 0, 0, 0)}));
  EXPECT_FALSE(curve.Append(1, At({0, 0, 0})));
  EXPECT_FALSE(curve.Append(1 + 1e-7, At({0, 0, 0})));
  EXPECT_FALSE(curve.Append(0.5, At({0, 0, 0})));
  EXPECT_EQ(curve.ignored_count(), 9u);
  curve.Finish();
  EXPECT_FALSE(curve.Append(1.01, At({0, 0, 0})));
  EXPECT_EQ(curve.end_time(), 1);
}

TEST(PoseCurve, IgnoresNearDuplicateStamps) {
  // Twin stamps 0.2 ms apart at 100 Hz, whose values differ by 0.1 mm of rounding: a slope of
  // 0.5 m/s if believed. The twins come first, in the middle, or with every sample.
  constexpr double kTwin = 2e-4, kNoise = 1e-4;
  constexpr double kLargest = 30;  // [m/s^2]: 0.1 mm steps at 100 Hz weigh 4.6 * 1e4 / s^2 or so,
                                   // one-sided windows 15 * 1e4 / s^2
  for (const int twin : {0, 1, 30, -1}) {
    PoseCurve curve;
    std::size_t twins = 0;
    for (int i = 0; i < 60; ++i) {
      curve.Append(0.01 * i, At({0, 0, 0}));
      if (i != twin && twin >= 0) continue;
      curve.Append(0.01 * i + kTwin, At({kNoise, 0, 0}));
      ++twins;
    }
    curve.Finish();
    EXPECT_EQ(curve.ignored_count(), twins);
    for (double t = 0; t < 0.59; t += 0.0003) {
      EXPECT_LT(std::abs(curve.Evaluate(t).a.x()), kLargest) << twin;
      EXPECT_LT(std::abs(curve.Evaluate(t).X.p.x()), 2 * kNoise) << twin;
    }
  }
}

TEST(PoseCurve, GetsOverAFasterRate) {
  // 50 Hz, then 500 Hz: at first the new samples look like duplicates.
  constexpr std::size_t kIgnored = 40;
  PoseCurve curve;
  for (int i = 0; i < 50; ++i) curve.Append(0.02 * i, At({0, 0, 0}));
  for (int i = 1; i < 500; ++i) curve.Append(0.98 + 0.002 * i, At({0, 0, 0}));
  EXPECT_LT(curve.ignored_count(), kIgnored);
}

TEST(PoseCurve, RoundingNoiseIsBounded) {
  // Uniform rounding of step q has sd q/sqrt(12) and reaches q/2; interpolation's second difference
  // weighs it by about 4.6 (rms), and no alignment of the 21 signs by more than 15.
  constexpr double kStep = 1e-4, kWorst = 15;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> rounding(-0.5 * kStep, 0.5 * kStep);
  PoseCurve curve;
  for (int i = 0; i < 2000; ++i) curve.Append(i / kRate, At({rounding(random), 0, 0}));
  curve.Finish();
  for (double t = 0.2; t < 19.8; t += 0.01) {
    EXPECT_LT(std::abs(curve.Evaluate(t).a.x()), kWorst * 0.5 * kStep * kRate * kRate);
    EXPECT_LT(std::abs(curve.Evaluate(t + 0.005).X.p.x()), kStep);
  }
}

// ---- Streaming --------------------------------------------------------------------------------

bool SameBits(const Motion& a, const Motion& b) {
  return std::memcmp(a.X.p.data(), b.X.p.data(), sizeof(Vector3d)) == 0 &&
         std::memcmp(a.X.q.coeffs().data(), b.X.q.coeffs().data(), 4 * sizeof(double)) == 0 &&
         std::memcmp(a.v.data(), b.v.data(), sizeof(Vector3d)) == 0 &&
         std::memcmp(a.omega.data(), b.omega.data(), sizeof(Vector3d)) == 0 &&
         std::memcmp(a.a.data(), b.a.data(), sizeof(Vector3d)) == 0 &&
         std::memcmp(a.alpha.data(), b.alpha.data(), sizeof(Vector3d)) == 0;
}

/// Jitter, twins, a lost sample, holes, gaps of which one begins after two samples.
std::vector<Sample> RoughSamples() {
  std::vector<Sample> samples = Sampled(Tumbling, kRate, 0, 300, 0.3);
  for (const int i : {290, 150, 60, 4}) {
    Sample twin = samples[i];
    twin.time += 2e-4;
    samples.insert(samples.begin() + i + 1, twin);
  }
  samples.erase(samples.begin() + 100);
  samples.erase(samples.begin() + 120, samples.begin() + 126);
  samples.erase(samples.begin() + 180, samples.begin() + 220);
  samples.insert(samples.begin(), {{-5, Tumbling(1)}, {-4.99, Tumbling(2)}, {-2, Tumbling(3)}});
  return samples;
}

TEST(PoseCurve, StreamedIsBatchBitForBit) {
  const std::vector<Sample> samples = RoughSamples();
  const PoseCurve batch = CurveThrough(samples);
  EXPECT_EQ(batch.gap_count(), 3u);
  EXPECT_GT(batch.ignored_count(), 0u);

  PoseCurve streamed, trimmed;
  double t = -6;
  int compared = 0;
  const auto compare_until_ready = [&]() {
    ASSERT_EQ(streamed.ready_until(), trimmed.ready_until());
    for (; t <= streamed.ready_until(); t += 0.0013) {
      const Motion reference = batch.Evaluate(t);
      ASSERT_TRUE(SameBits(streamed.Evaluate(t), reference)) << t;
      ASSERT_TRUE(SameBits(trimmed.Evaluate(t), reference)) << t;
      ASSERT_EQ(trimmed.InGap(t), batch.InGap(t)) << t;
      ++compared;
    }
    trimmed.DropBefore(t);
  };
  for (const Sample& sample : samples) {
    streamed.Append(sample.time, sample.X);
    trimmed.Append(sample.time, sample.X);
    compare_until_ready();
  }
  streamed.Finish();
  trimmed.Finish();
  compare_until_ready();
  EXPECT_GT(compared, 6000);
  EXPECT_EQ(streamed.ready_until(), batch.end_time());
  EXPECT_EQ(streamed.ignored_count(), batch.ignored_count());
  EXPECT_EQ(trimmed.gap_count(), batch.gap_count());
  // What was dropped is gone: a window and the interval at hand are left.
  EXPECT_GT(trimmed.begin_time(), samples.back().time - 0.2);
}

TEST(PoseCurve, LatencyIsOneWindow) {
  PoseCurve curve;
  for (int i = 0; i < 50; ++i) {
    curve.Append(i, At({i * 1.0, 0, 0}));
  }
  PoseCurve slow(2.0);
  for (int i = 0; i < 50; ++i) slow.Append(i, At({0, 0, 0}));
  EXPECT_EQ(slow.ready_until(), 49 - PoseCurve::kWindow);
  EXPECT_EQ(curve.gap_count(), 49u);  // a period longer than max_gap is nothing but gaps
}

}  // namespace
}  // namespace cosserat_cable
