// The level of a channel's noise from its record, whatever a fit makes of it.
#include "cosserat_cable/fit/noise_level.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "../measurement/rigs.h"

namespace cosserat_cable {
namespace {

constexpr double kNoise = 0.01;
constexpr int kSamples = 1000;
// Of 1000 sixth differences it is good to some 5 %; four times that.
constexpr double kOfRecord = 0.2;

Experiment OneChannel(int samples, double interval) {
  Experiment experiment;
  experiment.channels = {testing::ChannelAt(0.2, Quantity::kPosition)};
  for (int i = 0; i < samples; ++i) experiment.record.t.push_back(interval * i);
  experiment.record.values = Eigen::MatrixXd::Zero(samples, 1);
  return experiment;
}

Experiment Steps(int steps) {
  Experiment experiment = OneChannel(steps, 1);
  experiment.record.quasi_static = true;
  return experiment;
}

/// Noise of standard deviation kNoise; each sample keeps the part `rho` of the last one.
Eigen::VectorXd Noise(int samples, double rho, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Eigen::VectorXd noise(samples);
  double last = normal(random);
  for (int i = 0; i < samples; ++i) {
    noise[i] = kNoise * last;
    last = rho * last + std::sqrt(1 - rho * rho) * normal(random);
  }
  return noise;
}

/// A swing at 3 Hz that decays, of amplitude 1.
Eigen::VectorXd Swing(const Experiment& experiment) {
  Eigen::VectorXd y(static_cast<Eigen::Index>(experiment.record.t.size()));
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    const double t = experiment.record.t[static_cast<std::size_t>(i)];
    y[i] = std::exp(-0.3 * t) * std::cos(2 * testing::kPi * 3 * t);
  }
  return y;
}

NoiseLevel LevelOf(const Experiment& experiment,
                   const Eigen::VectorXd& simulated = Eigen::VectorXd()) {
  return cosserat_cable::LevelOf(experiment, 0,
                                 Eigen::VectorXd::Ones(experiment.record.values.rows()), simulated);
}

TEST(NoiseLevelTest, ASwingIsSeenThroughAtUnevenTimes) {
  Experiment experiment = OneChannel(kSamples, 5e-3);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> jitter(-1e-3, 1e-3);
  for (double& t : experiment.record.t) t += jitter(random);
  experiment.record.values.col(0) = Swing(experiment) + Noise(kSamples, 0, 2);
  const NoiseLevel level = LevelOf(experiment);
  EXPECT_EQ(level.source, NoiseLevel::Source::kRecord);
  EXPECT_NEAR(level.sd, kNoise, kOfRecord * kNoise);
}

TEST(NoiseLevelTest, AFitThatIsWrongDoesNotRaiseIt) {
  Experiment experiment = OneChannel(kSamples, 5e-3);
  const Eigen::VectorXd swing = Swing(experiment);
  experiment.record.values.col(0) = swing + Noise(kSamples, 0, 3);
  const NoiseLevel level = LevelOf(experiment, -0.5 * swing);
  EXPECT_NEAR(level.sd, kNoise, kOfRecord * kNoise);
  const double left = 1.5 * swing.norm() / std::sqrt(static_cast<double>(kSamples));
  EXPECT_TRUE(IsMisfit(left, kSamples, level));
  EXPECT_NEAR(TimesNoise(left, level), left / kNoise, kOfRecord * left / kNoise);
  EXPECT_FALSE(IsMisfit(kNoise, kSamples, level));
}

TEST(NoiseLevelTest, CorrelatedNoiseShowsWholeFromSamplesThatLieApart) {
  // Sixth differences of neighbours show 0.53 of it, of every fourth sample 0.94.
  constexpr double kOfColour = 0.25;
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    Experiment experiment = OneChannel(4 * kSamples, 1e-3);
    experiment.record.values.col(0) = Swing(experiment) + Noise(4 * kSamples, 0.6, seed);
    EXPECT_NEAR(LevelOf(experiment).sd, kNoise, kOfColour * kNoise) << seed;
  }
}

TEST(NoiseLevelTest, CorrelatedNoiseThatAFitLeavesIsNeverTakenForHalfOfIt) {
  // Of 400 samples that keep three quarters from each other, an estimate scatters by 15 %.
  constexpr double kLeast = 0.6, kMost = 1.6;
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    Experiment experiment = OneChannel(400, 5e-3);
    const Eigen::VectorXd swing = Swing(experiment);
    experiment.record.values.col(0) = swing + Noise(400, 0.74, seed);
    const NoiseLevel level = LevelOf(experiment, swing);
    EXPECT_GT(level.sd, kLeast * kNoise) << seed;
    EXPECT_LT(level.sd, kMost * kNoise) << seed;
  }
}

TEST(NoiseLevelTest, CorrelatedNoiseOfAShortRecordIsNotTakenForAThirdOfIt) {
  // Neighbours among 120 samples show 0.36 of it, and by chance a quarter. What a distance shows
  // counts only where the next one confirms it: the last one, of 8 samples, never does.
  constexpr double kLeast = 1.0 / 3;
  constexpr int kMostTooSmall = 2;
  int too_small = 0;
  for (std::uint32_t seed = 1; seed <= 200; ++seed) {
    Experiment experiment = OneChannel(120, 0.01);
    const Eigen::VectorXd swing = Swing(experiment);
    experiment.record.values.col(0) = swing + Noise(120, 0.75, seed);
    too_small += LevelOf(experiment, swing).sd < kLeast * kNoise;
  }
  EXPECT_LE(too_small, kMostTooSmall);
}

TEST(NoiseLevelTest, FewerThanFourSamplesAPeriodTellNothing) {
  Experiment experiment = OneChannel(kSamples, 1.0 / 11);
  experiment.record.values.col(0) = Swing(experiment) + Noise(kSamples, 0, 4);
  for (Eigen::Index i = 0; i < kSamples; ++i) {
    // A swing that does not decay.
    experiment.record.values(i, 0) += std::cos(2 * testing::kPi * 3 * static_cast<double>(i) / 11);
  }
  EXPECT_EQ(LevelOf(experiment).source, NoiseLevel::Source::kUnknown);
}

TEST(NoiseLevelTest, ElevenStepsTellIt) {
  constexpr int kSteps = 11, kSets = 400;
  double square = 0;
  int alarms = 0;
  for (std::uint32_t seed = 1; seed <= kSets; ++seed) {
    Experiment experiment = Steps(kSteps);
    experiment.b.motion = ClampMotion();  // no step repeats another
    for (int i = 0; i < kSteps; ++i) {
      experiment.b.motion->poses.emplace_back();
      experiment.b.motion->poses.back().p.x() = 1e-3 * i;
    }
    const Eigen::VectorXd noise = Noise(kSteps, 0, seed);
    for (int i = 0; i < kSteps; ++i)
      experiment.record.values(i, 0) = 0.3 * i - 0.02 * i * i + noise[i];
    const NoiseLevel level = LevelOf(experiment);
    ASSERT_EQ(level.source, NoiseLevel::Source::kRecord);
    square += level.sd * level.sd / kSets;
    alarms += IsMisfit(std::sqrt(noise.squaredNorm() / kSteps), kSteps, level);
  }
  // 400 estimates with eight degrees of freedom each: their mean square is good to 2.5 %.
  EXPECT_NEAR(std::sqrt(square), kNoise, 0.05 * kNoise);
  EXPECT_LE(alarms, kSets / 100);
}

TEST(NoiseLevelTest, RepeatedStepsTellItWhateverMovesBetween) {
  constexpr int kSteps = 40;
  Experiment experiment = Steps(kSteps);
  ClampMotion motion;
  motion.quasi_static = true;
  for (int i = 0; i < kSteps; ++i) {
    motion.t.push_back(i);
    motion.poses.emplace_back();
    motion.poses.back().p.x() = 1e-3 * (i / 2);
  }
  experiment.b.motion = motion;
  const Eigen::VectorXd noise = Noise(kSteps, 0, 5);
  std::mt19937 random(6);
  for (int i = 0; i < kSteps; i += 2) {
    // From pair to pair it jumps by a hundred times the noise.
    const double jump = 100 * kNoise * (static_cast<double>(random() % 100) / 50 - 1);
    for (const int k : {i, i + 1}) experiment.record.values(k, 0) = jump + noise[k];
  }
  const NoiseLevel level = LevelOf(experiment);
  EXPECT_EQ(level.source, NoiseLevel::Source::kRepeats);
  EXPECT_EQ(level.freedom, kSteps / 2);
  // Twenty degrees of freedom: good to 16 %; three times that.
  EXPECT_NEAR(level.sd, kNoise, 0.5 * kNoise);
}

TEST(NoiseLevelTest, FourStepsTellNothing) {
  Experiment experiment = Steps(4);
  experiment.b.motion = ClampMotion();
  for (int i = 0; i < 4; ++i) {
    experiment.b.motion->poses.emplace_back();
    experiment.b.motion->poses.back().p.x() = 1e-3 * i;
    experiment.record.values(i, 0) = i;
  }
  EXPECT_EQ(LevelOf(experiment).source, NoiseLevel::Source::kUnknown);
  EXPECT_EQ(TimesNoise(1, LevelOf(experiment)), 0);
  EXPECT_FALSE(IsMisfit(1, 4, LevelOf(experiment)));
}

TEST(NoiseLevelTest, WhatTheSetGivesIsTaken) {
  Experiment experiment = Steps(11);
  experiment.channels[0].sigma = 0.5;
  EXPECT_EQ(LevelOf(experiment).source, NoiseLevel::Source::kGiven);
  EXPECT_EQ(LevelOf(experiment).sd, 0.5);
  EXPECT_TRUE(IsMisfit(2, 11, LevelOf(experiment)));
}

}  // namespace
}  // namespace cosserat_cable
