// What a cable makes of clamp motion that is known at samples only.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "cable/cable_cases.h"
#include "cosserat_cable/cable/cable_simulation.h"
#include "cosserat_cable/math/pose_curve.h"

namespace cosserat_cable {
namespace {

using Eigen::Vector3d;

constexpr double kFrequency = 30, kAmplitude = 2e-3, kSampleRate = 100;  // Hz, m, Hz
constexpr double kDt = 1e-3, kBegin = 0.5, kEnd = 1.5;                   // s; compared in between

/// The arch of the swept body, cable P2.
CableModel Arch() { return RoundCableModel(0.2, 0.008, 0.15, 0.0080, 0.0060, 1e-4); }

Motion Analytic(double t) {
  const double w = 2 * M_PI * kFrequency;
  Motion m;
  m.X.p.x() = kAmplitude * std::sin(w * t);
  m.v.x() = kAmplitude * w * std::cos(w * t);
  m.a.x() = -kAmplitude * w * w * std::sin(w * t);
  return m;
}

Motion StraightLines(double t) {
  const double k = std::floor(t * kSampleRate + 1e-9), t0 = k / kSampleRate;
  const Vector3d p0 = Analytic(t0).X.p, p1 = Analytic(t0 + 1 / kSampleRate).X.p;
  Motion m;
  m.v = (p1 - p0) * kSampleRate;
  m.X.p = p0 + (t - t0) * m.v;
  return m;
}

/// Apex positions along x from kBegin to kEnd [m].
std::vector<double> ApexUnder(const std::function<Motion(double)>& body) {
  CableSimulation cable(Arch(), {}, {0, 0, -9.81});
  const Motion at_b = Motion::Resting({{0.1, 0, 0}, {0, 0, 1, 0}});  // a3 down
  const auto at = [&](double t) {
    const Motion m = body(t);
    return Surroundings{m, m * at_b, {}};
  };
  EXPECT_TRUE(cable.Settle(at(0)).ok);
  std::vector<double> apex;
  for (int k = 1; k * kDt < kEnd; ++k) {
    EXPECT_TRUE(cable.Step(kDt, at(k * kDt)).ok);
    if (k * kDt >= kBegin) apex.push_back(cable.Report().apex.x() - 0.05);
  }
  return apex;
}

double RelativeError(const std::vector<double>& x, const std::vector<double>& reference) {
  double error = 0, size = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    error += (x[i] - reference[i]) * (x[i] - reference[i]);
    size += reference[i] * reference[i];
  }
  return std::sqrt(error / size);
}

TEST(SampledBoundaryTest, TheCurveMovesTheApexAsTheTrueMotionDoes) {
  constexpr double kWithin = 0.01;            // of the apex motion, rms: the promise to users
  constexpr double kStraightLinesMiss = 0.1;  // a contrast, not a target
  PoseCurve curve;
  for (int k = -30; k <= (kEnd + 0.3) * kSampleRate; ++k)
    ASSERT_TRUE(curve.Append(k / kSampleRate, Analytic(k / kSampleRate).X));
  curve.Finish();
  const std::vector<double> truth = ApexUnder(Analytic);
  const double curve_error =
      RelativeError(ApexUnder([&](double t) { return curve.Evaluate(t); }), truth);
  const double straight_error = RelativeError(ApexUnder(StraightLines), truth);
  RecordProperty("curve_error", std::to_string(curve_error));
  RecordProperty("straight_error", std::to_string(straight_error));
  EXPECT_LT(curve_error, kWithin);
  EXPECT_GT(straight_error, kStraightLinesMiss);
}

}  // namespace
}  // namespace cosserat_cable
