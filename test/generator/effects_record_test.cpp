// Faults of a record, size zero, default sizes, convergence, and what the sets say.

#include <gtest/gtest.h>

#include <complex>

#include "effect_sets.h"
#include "effects_fixture.h"
#include "rotation_vector.h"

namespace cosserat_cable::generator {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

// Size zero runs other steps: the integrator's tolerance (1e-7 of the strains a step), some hundred
// of them; with kinks thirty times that.
constexpr double kNothing = 2e-5;
// Half of what 40 dB of noise hides in 3000 samples.
constexpr double kConverged = 1e-4;

EffectScale scaleOfTests() {
  EffectScale scale;
  scale.cable = effectCable();
  scale.shortest = scale.cable.length;
  scale.frequency = 55.5;
  scale.torsion = 115.0;
  scale.amplitude = 0.15;
  return scale;
}

Experiment largerRingdown(double duration) {
  Experiment e = smallRingdown(0.15, duration, 2e-3);
  e.cable.eta_EI = 4e-5;
  e.cable.eta_GJ = 4e-5;
  e.gravity = Vector3d(0.0, 4.0, 9.0);
  return e;
}

TEST(Effects, SizeZeroIsThePlainRod) {
  Experiment e = largerRingdown(0.2);
  const Record plain = simulate(e);
  const double swing = plain.values.cwiseAbs().maxCoeff();
  for (const EffectKind* kind : effectKinds()) {
    e.effects = chooseEffects({kind->name}, 0.0, scaleOfTests());
    const Record record = simulate(e);
    EXPECT_LT((record.values - plain.values).cwiseAbs().maxCoeff(), kNothing * swing) << kind->name;
  }
}

TEST(Effects, FrictionIsConverged) {
  // The default accuracy, thirty times coarser where there are kinks, against a far finer one.
  for (const char* name : {"section_friction", "clamp_friction", "clamp_play"}) {
    Experiment e = largerRingdown(0.4);
    e.effects = chooseEffects({name}, 1.0, scaleOfTests());
    Accuracy fine;
    fine.tolerance = 3e-9;
    const Record reference = simulate(e, fine), record = simulate(e);
    const double swing = (reference.values.array() - reference.rest[0]).matrix().norm();
    EXPECT_LT((record.values - reference.values).norm() / swing, 10.0 * kConverged) << name;
  }
}

TEST(Clock, ShowsTheMotionAtItsOwnTime) {
  Experiment e = largerRingdown(0.3);
  const double scale = 0.02, delay = 0.01;
  e.effects = {{&kClock, 1.0, {{"scale", scale}, {"delay", delay}}}};
  const Record record = simulate(e);
  e.effects.clear();
  VectorXd times = (e.times.array() - delay) / (1.0 + scale);
  e.times = times.tail(times.size() - 5);  // from the release on
  const Record plain = simulate(e);
  EXPECT_LT((record.values.bottomRows(plain.values.rows()) - plain.values).cwiseAbs().maxCoeff(),
            1e-7);
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(record.values(i, 0), (*e.held).x(), 1e-9) << i;
}

TEST(Sensor, FirstOrderLowPass) {
  const double corner = 8.0, hertz = 5.0, dt = 2e-4, turn = 2.0 * std::acos(-1.0);
  const auto sensor = effectOf(kSensor, {{"scale", 1.5}, {"low_pass", 1.0 / (turn * corner)}});
  const int n = 10000;
  Eigen::MatrixXd samples(n, 1);
  for (int i = 0; i < n; ++i) samples(i, 0) = std::sin(turn * hertz * i * dt);
  sensor->sense(dt, samples);
  const double gain = 1.5 / std::hypot(1.0, hertz / corner), lag = std::atan(hertz / corner);
  for (int i = n / 2; i < n; i += 97) {  // long after the start
    EXPECT_NEAR(samples(i, 0), gain * std::sin(turn * hertz * i * dt - lag), 1e-5);
  }
}

TEST(Sensor, TiltsAndScalesAboutTheWorldsOrigin) {
  Experiment e = largerRingdown(0.1);
  e.a.p = Vector3d(0.3, -0.2, 0.1);
  *e.held += e.a.p;
  e.channels = {{"tip_x", 0.3, Channel::Quantity::kPosition, 0},
                {"tip_y", 0.3, Channel::Quantity::kPosition, 1},
                {"tip_z", 0.3, Channel::Quantity::kPosition, 2}};
  const Record plain = simulate(e);
  e.channels.erase(e.channels.begin());  // y and z only
  const double angle = 0.3;
  e.effects = {{&kSensor, 1.0, {{"scale", 1.1}, {"tilt[2]", angle}}}};
  const Record record = simulate(e);
  const VectorXd expected =
      1.1 * (std::sin(angle) * plain.values.col(0) + std::cos(angle) * plain.values.col(1));
  // Dense samples are joined by straight lines.
  EXPECT_LT((record.values.col(0) - expected).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((record.values.col(1) - 1.1 * plain.values.col(2)).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(BaseMotion, BracketAmplifiesByItsTransferFunction) {
  const double turn = 2.0 * std::acos(-1.0), hertz = 6.0, own = 9.0, damping = 0.15;
  Excitation drive;
  drive.lines = {{0.01, hertz, hertz, 0.0}};
  drive.duration = 4.0;
  const auto fault = effectOf(kBaseMotion, {{"a.amplitude", 1.0},
                                            {"a.phase", 0.0},
                                            {"a.bracket.frequency", own},
                                            {"a.bracket.damping", damping}});
  const FrameCurve moved = fault->clampMotion(0, excite(drive), 4.0, true);
  const double r = hertz / own;
  const std::complex<double> gain = std::complex<double>(1.0, 2.0 * damping * r) /
                                    std::complex<double>(1.0 - r * r, 2.0 * damping * r);
  for (double t = 3.0; t < 4.0; t += 0.013) {
    const std::complex<double> x =
        0.01 * gain * std::exp(std::complex<double>(0.0, turn * hertz * t));
    EXPECT_NEAR(moved(t).p.x(), x.imag(), 1e-6);
    const double h = 1e-4;
    EXPECT_NEAR(moved(t).a.x(), (moved(t + h).v.x() - moved(t - h).v.x()) / (2.0 * h), 1e-2);
  }
}

TEST(BaseMotion, PhaseIsAShiftAtTheDominantFrequency) {
  const double turn = 2.0 * std::acos(-1.0);
  Excitation drive;
  drive.lines = {{0.01, 5.0, 5.0, 0.0}, {0.003, 11.0, 11.0, 1.0}};
  drive.duration = 3.0;
  const FrameCurve told = excite(drive);
  const auto fault =
      effectOf(kBaseMotion, {{"a.amplitude", 1.0}, {"a.phase", 0.4}, {"a.tilt[0]", 0.1}});
  const FrameCurve moved = fault->clampMotion(0, told, 3.0, true);
  // The other line leaks little under the window.
  EXPECT_NEAR(moved(1.0).p.x(), told(1.0 + 0.4 / (turn * 5.0)).p.x(), 1e-2 * 0.4 * 0.01);
  EXPECT_NEAR(moved(1.0).R(2, 1), std::sin(0.1), 1e-12);
}

TEST(Excitation, DerivativesBelongToThePath) {
  Excitation drive;
  drive.lines = {{0.01, 2.0, 9.0, 0.3}, {0.004, 12.0, 12.0, 1.0}};
  drive.turn = 20.0;
  drive.duration = 2.0;
  const FrameCurve curve = excite(drive);
  const double h = 1e-5;
  for (double t : {0.1, 0.29, 1.3}) {
    const FrameMotion m = curve(t), low = curve(t - h), high = curve(t + h);
    EXPECT_LT(((high.p - low.p) / (2.0 * h) - m.v).norm(), 1e-6);
    EXPECT_LT(((high.v - low.v) / (2.0 * h) - m.a).norm(), 1e-4);
    EXPECT_LT(((high.w - low.w) / (2.0 * h) - m.alpha).norm(), 1e-3);
    EXPECT_LT(((high.R - low.R) / (2.0 * h) * m.R.transpose() - skew(m.w)).norm(), 1e-5);
  }
}

TEST(EffectChoice, NamesAndNumbersAreChecked) {
  EXPECT_THROW(effectKind("air_drags"), std::invalid_argument);
  auto choices = chooseEffects({"none", "clamp_damping", "air_drag"}, 1.0, scaleOfTests());
  ASSERT_EQ(choices.size(), 3u);  // a dashpot comes with its spring
  setEffectValue("air_drag.Cd=2.5", &choices);
  EXPECT_EQ(choices[2].values.at("Cd"), 2.5);
  EXPECT_THROW(setEffectValue("Cd=2.5", &choices), std::invalid_argument);
  EXPECT_THROW(setEffectValue("air_drag.Cd=two", &choices), std::invalid_argument);
  EXPECT_EQ(effectPath(kSensor, "tilt[0]"), "faults.sensor[0].tilt[0]");
}

TEST(Arch, HangsWhereItIsHeld) {
  const MeasurementSet set = archSet(3, 200.0, {});
  ASSERT_EQ(set.experiments.size(), 2u);
  for (const MeasuredExperiment& one : set.experiments) {
    EXPECT_TRUE(one.values.allFinite());
    // A clamp that moves by 12 parts in a thousand moves the middle about as much.
    const double L = one.experiment.cable.length;
    for (int c = 0; c < one.values.cols(); ++c) {
      EXPECT_LT(one.values.col(c).maxCoeff() - one.values.col(c).minCoeff(), 0.5 * L);
    }
  }
}

TEST(Bend, ComesBackWithoutEffectsAndNotWithFriction) {
  const MeasurementSet plain = bendSet(5, 200.0, {});
  EffectPlan plan;
  plan.names = {"section_friction"};
  const MeasurementSet rough = bendSet(5, 200.0, plan);
  const auto gap = [](const MeasurementSet& set) {
    // Steps 24 and 48 are both without force, one coming from either side.
    const Eigen::MatrixXd& v = set.experiments[1].values;
    return (v.row(48) - v.row(24)).cwiseAbs().maxCoeff() /
           (v.colwise().maxCoeff() - v.colwise().minCoeff()).maxCoeff();
  };
  EXPECT_LT(gap(plain), 1e-8);
  EXPECT_GT(gap(rough), 1e-3);
}

}  // namespace
}  // namespace cosserat_cable::generator
