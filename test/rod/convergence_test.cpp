// How the errors fall with the number of elements and with the time step.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "cosserat_cable/rod/modes.h"
#include "rod/rod_cases.h"
#include "tools/validation.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::AngleAxisd;

const Pose kA;
const Pose kB{{0.1, 0, 0}, Eigen::Quaterniond(AngleAxisd(M_PI, Eigen::Vector3d::UnitY()))};

/// Cable P1 with a tenth of its damping, standing as an arch.
Rod ArchAtRest(int elements) {
  const RodModel model = RoundCable(0.2, 0.008, 0.22, 0.012, 0.009, 1.2e-5, 6e-6, elements);
  Rod rod(model);
  rod.SetConfiguration(BowedShape(kA, kB, 0.2, elements, model.gravity));
  EXPECT_TRUE(rod.Equilibrate().converged);
  return rod;
}

/// The vertex of the parabola through three values side by side.
double Vertex(double before, double at, double after) {
  const double slope = 0.5 * (after - before), curvature = before - 2 * at + after;
  return at - 0.5 * slope * slope / curvature;
}

/// Largest amplitude of its apex in space [m], on a body that is swept through its resonance: the
/// envelope's, of which the turning points are samples.
double Resonance(int elements, double dt) {
  Rod rod = ArchAtRest(elements);
  const Eigen::Vector3d rest = rod.pose(elements / 2).p;
  Motion start;
  start.v.x() = 1.5e-3 * 2 * M_PI * 10;
  start.a.x() = 1.5e-3 * 8 * M_PI;
  rod.AddRigidMotion(start);
  double before = 0, last = 0;
  std::vector<double> amplitudes;
  for (int k = 1; k * dt < 6.2; ++k) {
    const double t = k * dt;
    const auto shake = [t](Pose X) {
      X.p.x() += 1.5e-3 * std::sin(2 * M_PI * (10 + 2 * t) * t);
      return X;
    };
    EXPECT_TRUE(rod.Step(dt, shake(kA), shake(kB)).converged) << t;
    const double x = rod.pose(elements / 2).p.x() - rest.x();
    if (t > 4.5 && (last - before) * (x - last) < 0)
      amplitudes.push_back(std::abs(Vertex(before, last, x)));
    before = last;
    last = x;
  }
  const auto peak = std::max_element(amplitudes.begin() + 1, amplitudes.end() - 1);
  return Vertex(peak[-1], peak[0], peak[1]);
}

/// What a quantity of the chain is called in the table.
std::string OfElements(const std::string& quantity, int elements) {
  return elements == 40 ? quantity : quantity + ", " + std::to_string(elements) + " elements";
}

// Successive differences fall by 4 where the order is 2; where another order shows beside it, a
// little less.
constexpr double kLeastRatio = 3.5;

TEST(ConvergenceTest, ResonanceIsOfSecondOrderInTheElementLength) {
  constexpr double kDt = 5e-4;
  constexpr double kWithin = 4e-3;  // relative, at 10 elements already
  const int elements[] = {10, 20, 40, 80};
  double value[4];
  for (int k = 0; k < 4; ++k) value[k] = Resonance(elements[k], kDt);
  for (int k = 0; k < 2; ++k)
    EXPECT_GT(std::abs(value[k] - value[k + 1]) / std::abs(value[k + 1] - value[k + 2]),
              kLeastRatio);
  const double limit = value[3] + (value[3] - value[2]) / 3;
  for (int k : {0, 2})
    Validate(
        {"Numerics",
         OfElements("resonant amplitude of P1, eta x 0.1 [m], against its limit in N", elements[k]),
         "Richardson, N = 40, 80", limit, value[k], kWithin * limit, elements[k], kDt});
}

TEST(ConvergenceTest, RestShapeAndSwayFrequencyAreOfSecondOrderUpToFineMeshes) {
  // Relative, at 10 elements already.
  constexpr double kApexWithin = 2.5e-3, kFrequencyWithin = 1e-3;
  const int elements[] = {10, 20, 40, 80, 160};
  double apex[5], frequency[5];
  for (int k = 0; k < 5; ++k) {
    const Rod rod = ArchAtRest(elements[k]);
    apex[k] = rod.pose(elements[k] / 2).p.z();
    for (const Mode& mode : FindModes(rod, 2))
      if (mode.kind == ModeKind::kInPlane) frequency[k] = mode.w / (2 * M_PI);
  }
  const auto check = [&](const double* value, const std::string& what, double within) {
    for (int k = 0; k < 3; ++k)
      EXPECT_GT(std::abs(value[k] - value[k + 1]) / std::abs(value[k + 1] - value[k + 2]),
                kLeastRatio)
          << what << ' ' << elements[k];
    const double limit = value[4] + (value[4] - value[3]) / 3;
    for (int k : {0, 2})
      Validate({"Numerics", OfElements(what + ", against its own limit", elements[k]),
                "Richardson, N = 80, 160", limit, value[k], within * limit, elements[k]});
  };
  check(apex, "apex of arch P1 at rest [m]", kApexWithin);
  check(frequency, "sway of arch P1 in its plane [Hz]", kFrequencyWithin);
}

TEST(ConvergenceTest, SecondOrderInTheTimeStep) {
  constexpr double kWithin = 4e-3;  // relative, at 0.5 ms
  const double steps[] = {2e-3, 1e-3, 5e-4, 2.5e-4};
  double resonance[4];
  for (int k = 0; k < 4; ++k) resonance[k] = Resonance(20, steps[k]);
  for (int k = 0; k < 2; ++k)
    EXPECT_GT(
        std::abs(resonance[k] - resonance[k + 1]) / std::abs(resonance[k + 1] - resonance[k + 2]),
        kLeastRatio);
  const double limit = resonance[3] + (resonance[3] - resonance[2]) / 3;
  Validate({"Numerics", "resonant amplitude of P1, eta x 0.1 [m], against its limit in dt",
            "Richardson, dt = 0.5, 0.25 ms", limit, resonance[2], kWithin * limit, 20, 5e-4});
}

}  // namespace
}  // namespace cosserat_cable::rod
