// How the errors fall with the number of elements and with the time step.
#include <gtest/gtest.h>

#include <algorithm>

#include "rod/rod_cases.h"
#include "rod/validation.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::AngleAxisd;

/// Cable P1 with a tenth of its damping, standing as an arch on a body that is swept through its
/// resonance.
struct Result {
  double apex_height;  // at rest [m]
  double resonance;    // largest amplitude of the apex in space [m]
};

Result SweptArch(int elements, double dt) {
  const RodModel model = RoundCable(0.2, 0.008, 0.22, 0.012, 0.009, 1.2e-5, 6e-6, elements);
  const Pose a;
  const Pose b{{0.1, 0, 0}, Eigen::Quaterniond(AngleAxisd(M_PI, Eigen::Vector3d::UnitY()))};
  Rod rod(model);
  rod.SetConfiguration(BowedShape(a, b, 0.2, elements, model.gravity));
  EXPECT_TRUE(rod.Equilibrate().converged);
  const Eigen::Vector3d rest = rod.pose(elements / 2).p;
  Motion start;
  start.v.x() = 1.5e-3 * 2 * M_PI * 10;
  start.a.x() = 1.5e-3 * 8 * M_PI;
  rod.AddRigidMotion(start);
  double before = 0, last = 0, largest = 0;
  for (int k = 1; k * dt < 6.2; ++k) {
    const double t = k * dt;
    const auto shake = [t](Pose X) {
      X.p.x() += 1.5e-3 * std::sin(2 * M_PI * (10 + 2 * t) * t);
      return X;
    };
    EXPECT_TRUE(rod.Step(dt, shake(a), shake(b)).converged) << t;
    const double x = rod.pose(elements / 2).p.x() - rest.x();
    if (t > 4.5 && (last - before) * (x - last) < 0) {
      // Vertex of the parabola through three samples.
      const double curvature = before - 2 * last + x, slope = 0.5 * (x - before);
      largest = std::max(largest, std::abs(last - 0.5 * slope * slope / curvature));
    }
    before = last;
    last = x;
  }
  return {rest.z(), largest};
}

// Successive differences fall by 4 where the order is 2; where another order shows beside it, a
// little less.
constexpr double kLeastRatio = 3.5;

TEST(ConvergenceTest, SecondOrderInTheElementLengthAndAccurateAtForty) {
  constexpr double kDt = 5e-4;
  constexpr double kApexWithin = 2.5e-3, kResonanceWithin = 4e-3;  // relative, at 40 elements
  const int elements[] = {10, 20, 40, 80};
  Result results[4];
  for (int k = 0; k < 4; ++k) results[k] = SweptArch(elements[k], kDt);
  const auto check = [&](double Result::*value, const char* what, double within) {
    const double coarse = results[0].*value, fine = results[1].*value, finer = results[2].*value,
                 finest = results[3].*value;
    EXPECT_GT(std::abs(coarse - fine) / std::abs(fine - finer), kLeastRatio) << what;
    EXPECT_GT(std::abs(fine - finer) / std::abs(finer - finest), kLeastRatio) << what;
    const double limit = finest + (finest - finer) / 3;
    Validate({"Numerics", std::string(what) + ", against its own limit", "Richardson, N = 40, 80",
              limit, finer, within * std::abs(limit), 40, kDt});
  };
  check(&Result::apex_height, "apex of arch P1 at rest [m]", kApexWithin);
  check(&Result::resonance, "resonant amplitude of P1, eta x 0.1 [m]", kResonanceWithin);
}

TEST(ConvergenceTest, SecondOrderInTheTimeStep) {
  constexpr double kWithin = 4e-3;  // relative, at 0.5 ms
  const double steps[] = {2e-3, 1e-3, 5e-4, 2.5e-4};
  double resonance[4];
  for (int k = 0; k < 4; ++k) resonance[k] = SweptArch(20, steps[k]).resonance;
  for (int k = 0; k < 2; ++k)
    EXPECT_GT(std::abs(resonance[k] - resonance[k + 1]) /
                  std::abs(resonance[k + 1] - resonance[k + 2]),
              kLeastRatio);
  const double limit = resonance[3] + (resonance[3] - resonance[2]) / 3;
  Validate({"Numerics", "resonant amplitude of P1, eta x 0.1 [m], against its limit in dt",
            "Richardson, dt = 0.5, 0.25 ms", limit, resonance[2], kWithin * limit, 20, 5e-4});
}

}  // namespace
}  // namespace cosserat_cable::rod
