// Levenberg and Marquardt's method on Rosenbrock's valley, whose floor lies at (1, 1).
#include "../../src/fit/least_squares.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace cosserat_cable {
namespace {

using Eigen::Vector2d;

/// What takes a value for a simulation.
class Simulated : public LeastSquaresProblem {
 public:
  int SideBySide() const override { return 4; }
  int Room() const override { return 1; }
  bool GoOn(int, double) override { return true; }
  void Restrain(const Eigen::VectorXd&, Eigen::VectorXd*) const override {}

  int linearised = 0;
};

/// Residuals 10 (y - x^2), 1 - x and one that nothing changes, all by a noise of a hundredth, so
/// that the valley has an end. May keep a derivative.
class Valley : public Simulated {
 public:
  explicit Valley(double floor) : floor_(floor) {}

  Linearisation Linearise(const Eigen::VectorXd& x, const std::vector<Eigen::VectorXd>& others,
                          Renew renew, std::vector<double>* costs) override {
    ++linearised;
    places.push_back(x);
    *costs = Costs(others);
    Linearisation at;
    at.ok = !(x[0] > cliff_[0] && x[0] < cliff_[1]);
    if (!at.ok) return at;
    at.kept = renew == Renew::kNone && known_;
    at.whole = !at.kept;
    if (at.whole)
      slope_ = -20 * x[0];
    else if (x[0] != last_[0])  // as the way from the last place has it
      slope_ = (kNoise * (Residuals(x)[0] - Residuals(last_)[0]) - 10 * (x[1] - last_[1])) /
               (x[0] - last_[0]);
    last_ = x;
    known_ = true;
    Eigen::Matrix<double, 3, 2> jacobian;
    jacobian << slope_, 10, -1, 0, 0, 0;
    jacobian /= kNoise;
    at.cost = Cost(x);
    at.gram = jacobian.transpose() * jacobian;
    at.gradient = jacobian.transpose() * Residuals(x);
    return at;
  }
  std::vector<double> Costs(const std::vector<Eigen::VectorXd>& points) override {
    std::vector<double> costs;
    for (const Eigen::VectorXd& x : points) costs.push_back(Cost(x));
    return costs;
  }

  /// Between these, on the first axis, there are values but no derivatives.
  void SetCliff(double from, double to) { cliff_ = {from, to}; }

  std::vector<Eigen::VectorXd> places;  ///< where derivatives were asked for

 private:
  Eigen::Vector3d Residuals(const Eigen::VectorXd& x) const {
    return Eigen::Vector3d(10 * (x[1] - x[0] * x[0]), 1 - x[0], floor_) / kNoise;
  }
  double Cost(const Eigen::VectorXd& x) const { return 0.5 * Residuals(x).squaredNorm(); }

  static constexpr double kNoise = 0.01;
  double floor_;
  Vector2d cliff_ = Vector2d::Zero();
  bool known_ = false;
  double slope_ = 0;
  Eigen::VectorXd last_;
};

LeastSquaresOptions Wide() {
  LeastSquaresOptions options;
  options.lower = Vector2d::Constant(-1e3);
  options.upper = Vector2d::Constant(1e3);
  options.small_gain = 1e-10;
  return options;
}

const Vector2d kStart(-1.2, 1);  // Rosenbrock's
constexpr double kNear = 1e-4;

TEST(LeastSquaresTest, ComesToTheEndOfTheValley) {
  Valley valley(0);
  const LeastSquaresResult found = Minimise(kStart, Wide(), &valley);
  EXPECT_EQ(found.end, LeastSquaresResult::End::kMinimum);
  EXPECT_LT((found.x - Vector2d(1, 1)).norm(), kNear);
}

TEST(LeastSquaresTest, EndsWhereWholeDerivativesSaySo) {
  Valley valley(0);
  LeastSquaresOptions options = Wide();
  options.renew = LeastSquaresProblem::Renew::kNone;
  options.max_iterations = 200;
  const LeastSquaresResult found = Minimise(kStart, options, &valley);
  EXPECT_EQ(found.end, LeastSquaresResult::End::kMinimum);
  EXPECT_LT((found.x - Vector2d(1, 1)).norm(), kNear);
}

TEST(LeastSquaresTest, GoesOnPastAPlaceWithoutDerivatives) {
  Valley smooth(0), broken(0);
  const LeastSquaresResult whole = Minimise(kStart, Wide(), &smooth);
  // Where the first step leads that gains something, and close around it.
  const double start = smooth.Costs({kStart})[0];
  const auto first =
      std::find_if(smooth.places.begin(), smooth.places.end(),
                   [&](const Eigen::VectorXd& x) { return smooth.Costs({x})[0] < start; });
  ASSERT_NE(first, smooth.places.end());
  broken.SetCliff((*first)[0] - kNear, (*first)[0] + kNear);
  const LeastSquaresResult found = Minimise(kStart, Wide(), &broken);
  EXPECT_EQ(found.end, LeastSquaresResult::End::kMinimum);
  EXPECT_LT((found.x - whole.x).norm(), kNear);
  EXPECT_NE(broken.linearised, smooth.linearised);
}

TEST(LeastSquaresTest, KeepsTheBestPlaceWhereAllAroundThereAreNoDerivatives) {
  Valley valley(0);
  valley.SetCliff(-1.2 + 1e-12, 1e3);
  const LeastSquaresResult found = Minimise(kStart, Wide(), &valley);
  EXPECT_EQ(found.end, LeastSquaresResult::End::kStuck);
  const double at_start = 0.5 * (std::pow(10 * (1 - 1.44), 2) + 2.2 * 2.2) * 1e4;
  EXPECT_LT(found.cost, at_start);
}

TEST(LeastSquaresTest, DoesNotFollowTheValleyWhereItsAimLiesBelowTheFloor) {
  constexpr double kFloor = 30;
  Valley whole(kFloor), ended(kFloor), reached(kFloor);
  LeastSquaresOptions options = Wide();
  options.small_gain = 1e-12;
  const LeastSquaresResult end = Minimise(kStart, options, &whole);
  EXPECT_EQ(end.end, LeastSquaresResult::End::kMinimum);
  options.aim = 0.5 * end.cost;
  const LeastSquaresResult early = Minimise(kStart, options, &ended);
  EXPECT_EQ(early.end, LeastSquaresResult::End::kFar);
  EXPECT_LT(ended.linearised, whole.linearised);
  options.aim = 1.001 * end.cost;
  const LeastSquaresResult there = Minimise(kStart, options, &reached);
  EXPECT_EQ(there.end, LeastSquaresResult::End::kMinimum);
  EXPECT_LT((there.x - end.x).norm(), kNear);
}

/// Residuals 100 (x - 1) and `shown` (y - 50), in units of the noise.
class Shown : public Simulated {
 public:
  explicit Shown(double shown) : slopes_(100, shown) {}

  Linearisation Linearise(const Eigen::VectorXd& x, const std::vector<Eigen::VectorXd>& others,
                          Renew, std::vector<double>* costs) override {
    ++linearised;
    *costs = Costs(others);
    Linearisation at;
    at.ok = true;
    at.cost = Costs({x})[0];
    at.gram = slopes_.cwiseAbs2().asDiagonal();
    at.gradient = slopes_.cwiseProduct(Residuals(x));
    return at;
  }
  std::vector<double> Costs(const std::vector<Eigen::VectorXd>& points) override {
    std::vector<double> costs;
    for (const Eigen::VectorXd& x : points) costs.push_back(0.5 * Residuals(x).squaredNorm());
    return costs;
  }

 private:
  Vector2d Residuals(const Eigen::VectorXd& x) const {
    return slopes_.cwiseProduct(x - Vector2d(1, 50));
  }

  Vector2d slopes_;
};

TEST(LeastSquaresTest, WhatTheResidualsHardlyShowStaysWhereItIs) {
  LeastSquaresOptions options = Wide();
  options.small_gain = 5e-3;
  options.samples = 1000;
  // The whole way is worth half of the noise's variance.
  Shown hardly(0.02);
  const LeastSquaresResult kept = Minimise(Vector2d(2, 1), options, &hardly);
  EXPECT_EQ(kept.end, LeastSquaresResult::End::kMinimum);
  constexpr double kOfNoise = 0.01;  // in x
  EXPECT_NEAR(kept.x[0], 1, kOfNoise);
  EXPECT_NEAR(kept.x[1], 1, 0.5);
  // Here it is worth 1200 of it.
  Shown well(1);
  const LeastSquaresResult found = Minimise(Vector2d(2, 1), options, &well);
  EXPECT_EQ(found.end, LeastSquaresResult::End::kMinimum);
  EXPECT_NEAR(found.x[1], 50, 0.2);
}

}  // namespace
}  // namespace cosserat_cable
