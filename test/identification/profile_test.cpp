// Profiles hold the others' best values.
#include "../../src/identification/profile.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <memory>
#include <random>

#include "../../src/identification/refit.h"
#include "../measurement/rigs.h"

namespace cosserat_cable {
namespace {

constexpr double kNormal95 = 1.959964;
constexpr double kInertia = 2e-6;  // the disc turns at 10 Hz
constexpr double kNoise = 2e-3;    // [rad]
// The noise's own size makes the problem as good as linear: intervals of profile and curvature
// agree but for the tolerance to which each point is minimised.
constexpr double kLinear = 0.05;
// Sum of squares: what a refit leaves, against where it should be.
constexpr double kLeft = 0.05;

/// A torsional pendulum whose zero is unknown or not, over a time that is less than a period: the
/// stiffness and the zero are hard to tell apart.
struct Pendulum {
  explicit Pendulum(bool unknown_offset) {
    Experiment experiment = testing::Torsion(kInertia, 0.5, 0.04, 81);
    Specimen specimen = testing::CableSpecimen();
    specimen.disc_inertia = kInertia;
    const SimulatedRecord record =
        SimulateRefined(experiment, specimen, SimulationOptions()).record;
    EXPECT_TRUE(record.ok) << record.message;
    std::mt19937 random(11);
    std::normal_distribution<double> normal(0, kNoise);
    experiment.record.values =
        record.values.unaryExpr([&](double y) { return y + normal(random); });
    experiment.channels[0].sigma = kNoise;
    experiment.channels[0].unknown_offset = unknown_offset;
    Problems problems;
    MapReader map(YamlValue::Root("set",
                                  YAML::Load("length: 0.25\ndiameter: 0.006\n"
                                             "mass_per_length: 0.05\nEI: 0.0027\nGJ: 0.002\n"
                                             "eta_EI: 6.0e-6\neta_GJ: 4.0e-6\nuncertain: [GJ]\n"),
                                  &problems));
    set.cable = ReadCableKeys(&map);
    set.cable_mark = map.mark();
    set.experiments = {experiment};
    UnknownOptions options;
    options.end_damping = false;
    unknowns = std::make_unique<Unknowns>(set, options, &problems);
    EXPECT_TRUE(problems.empty()) << problems.ToString();
    model = std::make_unique<RecordModel>(*unknowns);
    noise = GuessNoise(*model);
  }

  /// Everything at these values, with central derivatives.
  Optimum At(const Eigen::VectorXd& values) const {
    const auto found =
        model->Differentiate(values, model->WholeHorizon(), RecordModel::Difference::kCentral);
    EXPECT_TRUE(found.at.ok) << found.at.message;
    Optimum optimum;
    optimum.values = values;
    optimum.jacobian = WeightedJacobian(*model, found, noise);
    optimum.residuals = WeightedResiduals(*model, values, found.at.records, noise);
    const Eigen::MatrixXd normal = optimum.jacobian.transpose() * optimum.jacobian;
    optimum.covariance = normal.inverse();
    return optimum;
  }

  Eigen::VectorXd Best() const {
    RefitJob job;
    job.values = unknowns->StartValues();
    const Refitted fit = Refit(*model, noise, {job}, FitProgress()).front();
    EXPECT_TRUE(fit.ok);
    return fit.values;
  }

  double Sd(const Optimum& optimum) const {
    return std::sqrt(optimum.covariance(0, 0)) * unknowns->all()[0].scale;
  }

  MeasurementSet set;
  std::unique_ptr<Unknowns> unknowns;
  std::unique_ptr<RecordModel> model;
  NoiseLevels noise;
};

std::pair<double, double> IntervalOfGJ(const Pendulum& pendulum, const Optimum& optimum) {
  const Profiles found =
      FindProfiles(*pendulum.model, optimum, pendulum.noise, {{0, kNormal95}}, FitProgress());
  EXPECT_FALSE(found.better);
  const auto interval = IntervalOf(found.profiles.front(), optimum.values[0], kNormal95);
  EXPECT_TRUE(interval);
  return interval.value_or(std::pair<double, double>());
}

TEST(ProfileTest, TheOthersAreAtTheirBestAllAlong) {
  const Pendulum known(false), unknown(true);
  const Optimum alone = known.At(known.Best()), beside = unknown.At(unknown.Best());
  ASSERT_EQ(beside.values.size(), 2);
  const auto [low, high] = IntervalOfGJ(known, alone);
  const auto [beside_low, beside_high] = IntervalOfGJ(unknown, beside);
  EXPECT_NEAR((high - low) / (2 * kNormal95 * known.Sd(alone)), 1, kLinear);
  EXPECT_NEAR((beside_high - beside_low) / (2 * kNormal95 * unknown.Sd(beside)), 1, kLinear);
  // What the zero might be is in the interval of the stiffness.
  constexpr double kMuchWider = 1.5;
  EXPECT_GT(beside_high - beside_low, kMuchWider * (high - low));
}

TEST(ProfileTest, AnOptimumThatIsNoneIsTold) {
  const Pendulum pendulum(true);
  const Optimum best = pendulum.At(pendulum.Best());
  Eigen::VectorXd values = best.values;
  values[1] += 3 * std::sqrt(best.covariance(1, 1)) * pendulum.unknowns->all()[1].scale;
  const Optimum none = pendulum.At(values);
  const Profiles found =
      FindProfiles(*pendulum.model, none, pendulum.noise, {{0, kNormal95}}, FitProgress());
  ASSERT_TRUE(found.better);
  EXPECT_LT(pendulum.At(*found.better).residuals.squaredNorm(), none.residuals.squaredNorm());
}

TEST(ProfileTest, ARefitReachesTheMinimumFromAfarAndFromWrongDerivatives) {
  const Pendulum pendulum(true);
  const Optimum best = pendulum.At(pendulum.Best());
  RefitJob job;
  job.values = best.values;
  for (int i = 0; i < 2; ++i)
    job.values[i] += 10 * std::sqrt(best.covariance(i, i)) * pendulum.unknowns->all()[i].scale;
  job.jacobian = best.jacobian;
  job.jacobian.col(0) *= -1;  // the way up
  const Refitted fit = Refit(*pendulum.model, pendulum.noise, {job}, FitProgress()).front();
  ASSERT_TRUE(fit.ok);
  EXPECT_NEAR(fit.cost, best.residuals.squaredNorm(), kLeft);
  // One that is held stays.
  job.held = {true, false};
  const Refitted held = Refit(*pendulum.model, pendulum.noise, {job}, FitProgress()).front();
  EXPECT_EQ(held.values[0], job.values[0]);
  EXPECT_LT(held.cost, pendulum.At(job.values).residuals.squaredNorm());
  EXPECT_GT(held.cost, fit.cost);
}

TEST(ProfileTest, AtABoundTheIntervalEndsThere) {
  // The root of the deviance is the value less one, in units of 1/2; the bound is 0.
  const Profile profile{{0, 0.5, 1, 1.5, 2}, {1, 0.25, 0, 1, 4}};
  const auto interval = IntervalOf(profile, 1, 2, 0);
  ASSERT_TRUE(interval);
  EXPECT_EQ(interval->first, 0);
  EXPECT_DOUBLE_EQ(interval->second, 2);
  // So does one that has not risen yet where the bound is.
  const auto flat = IntervalOf({{0, 0.5, 1, 2, 4}, {0, 0, 0.001, 1, 9}}, 0.5, 2, 0);
  ASSERT_TRUE(flat);
  EXPECT_EQ(flat->first, 0);
  EXPECT_DOUBLE_EQ(flat->second, 3);
  // A profile that falls again says nothing.
  EXPECT_FALSE(IntervalOf({{0, 1, 2, 3}, {4, 0, 4, 3}}, 1, 2));
}

}  // namespace
}  // namespace cosserat_cable
