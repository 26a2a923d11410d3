// What a constant and a filter of the clamps' motion leave of records made for it.
#include "cosserat_cable/identification/reference_models.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "../measurement/rigs.h"

namespace cosserat_cable {
namespace {

constexpr int kSamples = 600;
constexpr double kInterval = 0.01;             // [s]
constexpr double kDelay = 0.1, kFactor = 0.4;  // of the record behind the clamp
constexpr double kNoise = 1e-3;                // [m]

/// A sum of sines with this seed's phases, 0.2 to 2 Hz.
double Moved(int seed, double t) {
  double sum = 0;
  for (int k = 1; k <= 10; ++k) sum += 0.02 * std::sin(2 * M_PI * 0.2 * k * t + seed * k * k);
  return sum;
}

/// Its one channel goes with clamp a, a part of the way late, besides noise.
Experiment Follows(int seed) {
  Experiment experiment = testing::RingDown(0.02, kInterval * (kSamples - 1), kSamples);
  Channel channel = testing::ChannelAt(0.1, Quantity::kPosition);
  channel.column = "x";
  experiment.channels = {channel};
  ClampMotion motion;
  experiment.record.values.resize(kSamples, 1);
  std::mt19937 random(static_cast<std::uint32_t>(seed));
  std::normal_distribution<double> noise(0, kNoise);
  for (int i = 0; i < kSamples; ++i) {
    const double t = i * kInterval;
    experiment.record.t[static_cast<std::size_t>(i)] = t;
    motion.t.push_back(t);
    motion.poses.push_back({Eigen::Vector3d(Moved(seed, t), 0, 0), Eigen::Quaterniond::Identity()});
    const double now = Moved(seed, t), late = Moved(seed, std::max(0.0, t - kDelay));
    experiment.record.values(i, 0) = 0.3 + (1 - kFactor) * now + kFactor * late + noise(random);
  }
  experiment.a.motion = motion;
  return experiment;
}

std::vector<std::vector<ReferenceResiduals>> Of(const MeasurementSet& set) {
  Records usable;
  for (const Experiment& experiment : set.experiments)
    usable.push_back(
        Eigen::MatrixXd::Ones(experiment.record.values.rows(), experiment.record.values.cols()));
  return FindReferenceResiduals(set, usable);
}

TEST(ReferenceModelsTest, TheFilterFindsWhatFollowsAClampLate) {
  MeasurementSet set;
  for (int seed = 1; seed <= 3; ++seed) set.experiments.push_back(Follows(seed));
  const auto found = Of(set);
  for (const auto& of : found) {
    // Ten sines of 0.02 m, the fast ones less by the delay.
    EXPECT_NEAR(of[0].constant, 0.02 * std::sqrt(5.0), 0.3 * 0.02 * std::sqrt(5.0));
    // What the weights have learnt of the noise is small: 13 of 600 samples.
    EXPECT_LT(of[0].filter, 1.1 * kNoise);
    EXPECT_GT(of[0].filter, 0.9 * kNoise);
    EXPECT_LT(of[0].filter_unseen, 1.2 * kNoise);
    EXPECT_GT(of[0].filter_unseen, of[0].filter);
  }
}

TEST(ReferenceModelsTest, SamplesThatDoNotCountChangeNothing) {
  MeasurementSet set;
  set.experiments = {Follows(1), Follows(2)};
  Records usable(2, Eigen::MatrixXd::Ones(kSamples, 1));
  usable[0].middleRows(100, 50).setZero();
  const auto clean = FindReferenceResiduals(set, usable);
  set.experiments[0].record.values.middleRows(100, 50).setConstant(1e3);
  const auto spoilt = FindReferenceResiduals(set, usable);
  EXPECT_DOUBLE_EQ(clean[0][0].filter, spoilt[0][0].filter);
  EXPECT_DOUBLE_EQ(clean[0][0].constant, spoilt[0][0].constant);
}

TEST(ReferenceModelsTest, OfClampsThatStandThereIsNoFilter) {
  MeasurementSet set;
  set.experiments = {Follows(1)};
  EXPECT_TRUE(std::isnan(Of(set)[0][0].filter_unseen));  // no other record
  set.experiments[0].a.motion.reset();
  EXPECT_TRUE(std::isnan(Of(set)[0][0].filter));
  EXPECT_GT(Of(set)[0][0].constant, 0);
}

}  // namespace
}  // namespace cosserat_cable
