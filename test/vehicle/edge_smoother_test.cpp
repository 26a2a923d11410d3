#include "cosserat_cable/vehicle/edge_smoother.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace cosserat_cable {
namespace {

constexpr double kStart = 1000;   // [s]
constexpr double kMaxGap = 0.25;  // [s]

std::int64_t Stamp(double seconds) {
  return static_cast<std::int64_t>(std::llround((kStart + seconds) * 1e9));
}

struct Sample {
  double time;
  Pose X;
};

Pose At(double x, double yaw = 0) {
  Pose pose;
  pose.p.x() = x;
  pose.q = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
  return pose;
}

std::vector<Sample> Smoothed(double cutoff, const std::vector<Sample>& samples) {
  EdgeSmoother smoother(cutoff, kMaxGap);
  std::vector<Sample> out;
  const auto sink = [&](std::int64_t stamp, const Pose& X) {
    out.push_back({static_cast<double>(stamp - Stamp(0)) * 1e-9, X});
  };
  for (const Sample& sample : samples) smoother.Add(Stamp(sample.time), sample.X, sink);
  smoother.Finish(sink);
  return out;
}

// Samples at uneven times, of which the stamps are right.
std::vector<Sample> Uneven(double rate, double seconds, const std::function<Pose(double)>& pose) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uneven(-0.2, 0.2);
  std::vector<Sample> samples;
  for (int i = 1; i < rate * seconds; ++i) {
    const double t = (i + uneven(random)) / rate;
    samples.push_back({t, pose(t)});
  }
  return samples;
}

TEST(EdgeSmoother, QuadraticMotionPassesUnchanged) {
  constexpr double kRounding = 1e-9;
  const auto pose = [](double t) { return At(3 * t - 0.5 * t * t, 2 * t - 0.3 * t * t); };
  const auto out = Smoothed(5, Uneven(100, 4, pose));
  ASSERT_EQ(out.size(), 399u);
  for (const Sample& sample : out) {
    EXPECT_NEAR(sample.X.p.x(), pose(sample.time).p.x(), kRounding);
    EXPECT_LT(sample.X.q.angularDistance(pose(sample.time).q), 1e-7);
  }
}

TEST(EdgeSmoother, GainIsAsStatedAndThereIsNoDelay) {
  // (1 + u) exp(-u) with u = 1.078 (f / cutoff)^2.
  constexpr double kCutoff = 10;   // [Hz]
  constexpr double kDense = 0.01;  // of the gain, for the reach ends and samples are finite
  for (const auto& [frequency, gain] :
       std::vector<std::pair<double, double>>{{2, 0.9991}, {10, 0.7071}, {20, 0.0713}}) {
    const double omega = 2 * M_PI * frequency;
    const auto out =
        Smoothed(kCutoff, Uneven(400, 4, [&](double t) { return At(std::sin(omega * t)); }));
    double in_phase = 0, across = 0, count = 0;
    for (const Sample& sample : out) {
      if (sample.time < 1 || sample.time > 3) continue;
      in_phase += 2 * sample.X.p.x() * std::sin(omega * sample.time);
      across += 2 * sample.X.p.x() * std::cos(omega * sample.time);
      ++count;
    }
    EXPECT_NEAR(in_phase / count, gain, kDense) << frequency;
    EXPECT_NEAR(across / count, 0, kDense) << frequency;
  }
}

TEST(EdgeSmoother, NothingIsSmoothedAcrossAGap) {
  std::vector<Sample> samples;
  for (int i = 0; i < 200; ++i) samples.push_back({0.01 * i, At(0)});
  for (int i = 0; i < 200; ++i) samples.push_back({3 + 0.01 * i, At(1)});
  for (const Sample& sample : Smoothed(1, samples))
    EXPECT_NEAR(sample.X.p.x(), sample.time < 2.5 ? 0 : 1, 1e-9);
}

TEST(EdgeSmoother, LateStampsAreReplacedByASteadyClock) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> late(0, 0.002);
  std::vector<Sample> samples;
  for (int i = 0; i <= 1000; ++i) {
    if (i % 90 == 17) continue;  // lost
    samples.push_back({0.01 * i + late(random), At(0.1 * i, 0.01 * i)});
  }
  const auto out = Smoothed(20, samples);
  ASSERT_EQ(out.size(), samples.size());
  // 0.6 ms of scatter, evened out over some hundred samples; at 10 m/s and late by 1 ms on average.
  constexpr double kLeft = 3e-3;  // [m]
  for (const Sample& sample : out)
    EXPECT_NEAR(sample.X.p.x(), 10 * (sample.time - 0.001), kLeft) << sample.time;
  // From one to the next almost nothing is left.
  for (std::size_t i = 101; i + 100 < out.size(); ++i) {
    const double v0 = (out[i].X.p.x() - out[i - 1].X.p.x()) / (out[i].time - out[i - 1].time);
    const double v1 = (out[i + 1].X.p.x() - out[i].X.p.x()) / (out[i + 1].time - out[i].time);
    EXPECT_LT(std::abs(v1 - v0) / 0.01, 1.0) << i;  // [m/s^2]; as recorded: 140 rms
  }
}

TEST(EdgeSmoother, StampsThatAreRightStay) {
  const auto samples = Uneven(100, 4, [](double t) { return At(10 * t); });
  const auto out = Smoothed(10, samples);
  for (std::size_t i = 0; i < out.size(); ++i) EXPECT_NEAR(out[i].time, samples[i].time, 2e-9);
}

TEST(EdgeSmoother, SamplesComeAsLateAsItSays) {
  constexpr double kCutoff = 2;
  EdgeSmoother smoother(kCutoff, kMaxGap);
  double newest = 0, last = 0;
  for (int i = 0; i <= 500; ++i) {
    smoother.Add(Stamp(0.01 * i), At(0), [&](std::int64_t stamp, const Pose&) {
      last = static_cast<double>(stamp - Stamp(0)) * 1e-9;
    });
    newest = 0.01 * i;
  }
  EXPECT_LE(newest - last, EdgeSmoother::Latency(kCutoff) + 0.011);
  EXPECT_GT(last, 1);
}

}  // namespace
}  // namespace cosserat_cable
