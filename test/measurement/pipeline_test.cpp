// What each stage of a record makes of a fault, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "../../src/measurement/clamp_path.h"
#include "../../src/measurement/low_pass.h"
#include "cosserat_cable/math/rotation.h"
#include "cosserat_cable/measurement/experiment_simulation.h"
#include "rigs.h"
#include "tools/validation.h"

namespace cosserat_cable {
namespace {

using Eigen::Vector3d;
using testing::CableSpecimen;
using testing::ChannelAt;
using testing::kPi;
using testing::RingDown;
using testing::SampleEvenly;
using testing::Torsion;

SimulationOptions Fine() {
  SimulationOptions options;
  options.dt = 5e-4;
  options.elements = 20;
  return options;
}

constexpr double kAmplitude = 0.002, kShaker = 2 * kPi * 5;  // [m], [rad/s]
const Vector3d kMiddle(0.3, -0.2, 0.1);

/// A whole number of periods along z about kMiddle, sampled at 1 kHz.
ClampMotion Shaken(double duration) {
  ClampMotion motion;
  const int count = static_cast<int>(std::lround(duration * 1000));
  for (int i = 0; i <= count; ++i) {
    const double t = 1e-3 * i;
    motion.t.push_back(t);
    motion.poses.push_back({kMiddle + Vector3d(0, 0, kAmplitude * std::sin(kShaker * t)),
                            Eigen::Quaterniond(Eigen::AngleAxisd(kPi / 2, Vector3d::UnitY()))});
  }
  return motion;
}

/// The cable hangs out from a shaken clamp; channels at the clamp show its motion.
Experiment ShakenArm(double duration, int count) {
  Experiment experiment = RingDown(0.001, duration, count);
  experiment.start = StartCondition();
  experiment.a.motion = Shaken(duration);
  experiment.channels = {ChannelAt(0, Quantity::kPosition, 2), ChannelAt(0, Quantity::kVelocity, 2),
                         ChannelAt(0, Quantity::kAcceleration, 2)};
  return experiment;
}

Eigen::MatrixXd Simulated(const Experiment& experiment, const Faults& faults) {
  Specimen specimen = CableSpecimen();
  specimen.disc_inertia = experiment.b.disc.inertia;
  specimen.faults = faults;
  const SimulatedRecord record = SimulateExperiment(experiment, {specimen}, Fine()).front();
  EXPECT_TRUE(record.ok) << record.message;
  return record.values;
}

/// Instants of the falling and rising zeros of a swing [s], between samples by a straight line.
std::vector<double> Zeros(const Experiment& experiment, const Eigen::VectorXd& y) {
  std::vector<double> zeros;
  const std::vector<double>& t = experiment.record.t;
  for (Eigen::Index i = 1; i < y.size(); ++i)
    if (y[i - 1] * y[i] < 0) {
      const auto k = static_cast<std::size_t>(i);
      zeros.push_back(t[k - 1] + y[i - 1] / (y[i - 1] - y[i]) * (t[k] - t[k - 1]));
    }
  return zeros;
}

/// Of y(t) = gain sin(kShaker t + phase) and a constant: gain exp(i phase), from `count` samples
/// that fill a period from `begin` on.
template <class Function>
std::complex<double> Response(const Function& y, double begin, int count) {
  std::complex<double> sum = 0;
  for (int i = 0; i < count; ++i) {
    const double t = begin + 2 * kPi / kShaker * i / count;
    sum += y(t) * std::exp(std::complex<double>(0, -kShaker * t));
  }
  return sum * std::complex<double>(0, 2.0 / count);
}

TEST(Clock, ShiftsThePhaseOfAPendulum) {
  const double J = 2e-6;
  const Experiment experiment = Torsion(J, 0.5, 1.0, 501);
  Faults faults;
  faults.clock = ClockFault{0.03, 0.004, {}};
  const Eigen::MatrixXd angle = Simulated(experiment, faults);
  const CableModel m = CableSpecimen().cable;
  const double inertia = J + m.rhoJ() * m.length / 3;
  const double delta = m.eta_GJ / m.length / (2 * inertia);
  const double Omega = std::sqrt(m.GJ / (m.length * inertia) - delta * delta);
  constexpr double kCableInertia = 2e-3;  // rhoJ L/3 is good to (rhoJ L/J)^2
  for (Eigen::Index i = 0; i < angle.rows(); ++i) {
    const double t = std::max(0.0, (experiment.record.t[i] - 0.004) / 1.03);
    const double expected =
        0.5 * std::exp(-delta * t) * (std::cos(Omega * t) + delta / Omega * std::sin(Omega * t));
    EXPECT_NEAR(angle(i, 0), expected, kCableInertia * 0.5) << "t = " << t;
  }
  // Zeros of the pendulum on the motion's clock and on the record's.
  constexpr double kZero = 1e-5;  // [s] a straight line for the swing between two samples
  const std::vector<double> on_motions = Zeros(experiment, Simulated(experiment, {}).col(0)),
                            on_records = Zeros(experiment, angle.col(0));
  ASSERT_GE(on_motions.size(), on_records.size());
  ASSERT_GT(on_records.size(), 10u);
  const std::size_t last = on_records.size() - 1;
  const double rate = (on_records[last] - on_records[0]) / (on_motions[last] - on_motions[0]);
  const char* source = "t_record = (1 + scale) t + delay";
  Validate({"Causes", "clock: scale, from the zeros of a pendulum", source, 0.03, rate - 1,
            2 * kZero / on_motions[last], Fine().elements, Fine().dt});
  Validate({"Causes", "clock: delay, from the zeros of a pendulum [s]", source, 0.004,
            on_records[0] - 1.03 * on_motions[0], 2 * kZero, Fine().elements, Fine().dt});
}

TEST(Sensor, TiltAndScaleTurnWhatIsSeenAboutTheOrigin) {
  Experiment experiment = ShakenArm(0.1, 11);
  // The record has one axis of the three.
  experiment.channels = {ChannelAt(0, Quantity::kPosition, 0)};
  Faults faults;
  SensorFault sensor;
  sensor.scale = 1.1;
  sensor.tilt = {0.1, -0.2, 0.3};
  faults.sensor = {sensor};
  const Eigen::MatrixXd seen = Simulated(experiment, faults);
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(sensor.tilt.norm(), sensor.tilt.normalized()).toRotationMatrix();
  constexpr double kRounding = 1e-12;
  for (Eigen::Index i = 0; i < seen.rows(); ++i) {
    const Vector3d p =
        kMiddle + Vector3d(0, 0, kAmplitude * std::sin(kShaker * experiment.record.t[i]));
    EXPECT_NEAR(seen(i, 0), 1.1 * (R * p).x(), kAmplitude * 1e-6 + kRounding);
    if (i + 1 == seen.rows())
      Validate({"Causes", "sensor: x of a point through scale and tilt [m]",
                "1.1 times the turned position", 1.1 * (R * p).x(), seen(i, 0),
                kAmplitude * 1e-6 + kRounding, Fine().elements, Fine().dt});
  }
}

TEST(Sensor, OfClampAsFrameTurnsAboutIt) {
  Experiment experiment = RingDown(0.001, 0.05, 11);
  const double L = CableSpecimen().cable.length;
  experiment.channels = {ChannelAt(L, Quantity::kPosition, 0), ChannelAt(L, Quantity::kPosition, 1),
                         ChannelAt(L, Quantity::kPosition, 2)};
  for (Channel& channel : experiment.channels) {
    channel.in_frame_a = true;
    channel.column += "xyz"[channel.axis];
  }
  const Eigen::MatrixXd plain = Simulated(experiment, {});
  Faults faults;
  SensorFault sensor;
  sensor.tilt = {0, 0.25, 0};
  sensor.channels = {"positionx", "positionz"};
  faults.sensor = {sensor};
  const Eigen::MatrixXd seen = Simulated(experiment, faults);
  constexpr double kRounding = 1e-15;
  for (Eigen::Index i = 0; i < seen.rows(); ++i) {
    EXPECT_NEAR(seen(i, 0), std::cos(0.25) * plain(i, 0) + std::sin(0.25) * plain(i, 2), kRounding);
    EXPECT_NEAR(seen(i, 2), std::cos(0.25) * plain(i, 2) - std::sin(0.25) * plain(i, 0), kRounding);
    EXPECT_EQ(seen(i, 1), plain(i, 1)) << "not in the group";
  }
}

TEST(Sensor, LowPassesASineAsAFirstOrderFilterDoes) {
  const Experiment experiment = ShakenArm(0.4, 401);
  for (const double cutoff : {2.0, 8.0, 150.0}) {
    Faults faults;
    SensorFault sensor;
    sensor.low_pass = 1 / (2 * kPi * cutoff);
    faults.sensor = {sensor};
    const Eigen::MatrixXd seen = Simulated(experiment, faults);
    const double w = kShaker, wc = 2 * kPi * cutoff;
    const double gain = kAmplitude / std::hypot(1, w / wc), lag = std::atan(w / wc);
    // The clamp has been moving on at its first speed: y(0) = -x'(0)/wc.
    const double rest = -kAmplitude * w / wc + gain * std::sin(lag);
    // Of the curve through samples 200 to a period, and of derivatives of the trace; one-sided at
    // the record's ends.
    constexpr double kCurve = 1e-6, kRate = 1e-5, kAcceleration = 2e-3;
    for (Eigen::Index i = 0; i < seen.rows(); ++i) {
      const double t = experiment.record.t[i], decayed = rest * std::exp(-wc * t);
      EXPECT_NEAR(seen(i, 0), kMiddle.z() + gain * std::sin(w * t - lag) + decayed,
                  kCurve * kAmplitude);
      EXPECT_NEAR(seen(i, 1), gain * w * std::cos(w * t - lag) - wc * decayed,
                  kRate * kAmplitude * std::max(w, wc));
      EXPECT_NEAR(seen(i, 2), -gain * w * w * std::sin(w * t - lag) + wc * wc * decayed,
                  kAcceleration * kAmplitude * w * std::max(w, wc));
    }
    if (cutoff != 8) continue;
    // Over the second period, when the start is forgotten but for exp(-10).
    constexpr double kForgotten = 1e-4;
    const std::complex<double> response =
        Response([&](double t) { return seen(static_cast<Eigen::Index>(std::lround(1e3 * t)), 0); },
                 0.2, 200);
    const char* source = "1/(1 + i w tau)";
    Validate({"Causes", "sensor: gain of a low pass of 8 Hz at 5 Hz", source, gain / kAmplitude,
              std::abs(response) / kAmplitude, kForgotten, Fine().elements, Fine().dt});
    Validate({"Causes", "sensor: lag of a low pass of 8 Hz at 5 Hz [rad]", source, lag,
              -std::arg(response), kForgotten, Fine().elements, Fine().dt});
  }
}

TEST(Sensor, OfASwingThatWasThereBeforeHasNoTransient) {
  // x = sin(w t + 1) sampled from t = 0, eight whole periods: its mean is zero.
  constexpr double w = 2 * kPi * 4, kStep = 1e-3;
  constexpr int kSteps = 2001;
  Trace trace(0, kStep, kSteps, 1);
  for (int k = 0; k < kSteps; ++k) trace.at(k)[0] = std::sin(w * k * kStep + 1);
  const LowPass filtered(trace, 0, 1 / (2 * kPi * 3.0), LowPass::Before::kSwings);
  const double ratio = w / (2 * kPi * 3), gain = 1 / std::hypot(1, ratio), lag = std::atan(ratio);
  constexpr double kMean = 1e-3;  // the last sample is one more than whole periods
  for (int k = 0; k < kSteps; ++k)
    EXPECT_NEAR(filtered.Evaluate(k * kStep, 0), gain * std::sin(w * k * kStep + 1 - lag), kMean);
}

TEST(BaseMotion, AmplitudeIsAboutTheMean) {
  const Experiment experiment = ShakenArm(0.2, 21);
  Faults faults;
  faults.a = ClampMotionFault();
  faults.a->amplitude = 1.4;
  const Eigen::MatrixXd seen = Simulated(experiment, faults);
  constexpr double kCurve = 1e-6;
  for (Eigen::Index i = 0; i < seen.rows(); ++i)
    EXPECT_NEAR(seen(i, 0),
                kMiddle.z() + 1.4 * kAmplitude * std::sin(kShaker * experiment.record.t[i]),
                kCurve * kAmplitude);
}

/// Rocks about z by `size` [rad], about a mean that is turned about x.
ClampMotion Rocking(double size, double duration) {
  ClampMotion motion = Shaken(duration);
  for (std::size_t i = 0; i < motion.t.size(); ++i)
    motion.poses[i].q =
        Eigen::AngleAxisd(1.0, Vector3d::UnitX()) *
        Eigen::AngleAxisd(size * std::sin(kShaker * motion.t[i]), Vector3d::UnitZ());
  return motion;
}

TEST(BaseMotion, AmplitudeGrowsRotationsToo) {
  EndCondition end;
  end.motion = Rocking(0.2, 1.0);
  ClampMotionFault fault;
  fault.amplitude = 2;
  ClampPath path(end, fault);
  end.motion = Rocking(0.4, 1.0);
  ClampPath expected(end, std::nullopt);
  constexpr double kCurve = 1e-9;
  for (const double t : {0.1, 0.333, 0.71})
    EXPECT_LT(path.At(t).X.q.angularDistance(expected.At(t).X.q), kCurve);
}

TEST(BaseMotion, PhaseAdvancesTheDominantFrequency) {
  EndCondition end;
  end.motion = Shaken(2.0);
  // A weaker overtone does not count.
  for (std::size_t i = 0; i < end.motion->t.size(); ++i)
    end.motion->poses[i].p.x() += 0.4 * kAmplitude * std::sin(3 * kShaker * end.motion->t[i]);
  EXPECT_NEAR(DominantFrequency(*end.motion), kShaker, 1e-3 * kShaker);
  ClampMotionFault fault;
  fault.phase = 0.3;
  ClampPath path(end, fault);
  constexpr double kPeriodogram = 1e-3;
  for (const double t : {0.5, 0.817, 1.2})
    EXPECT_NEAR(path.At(t).X.p.z(), kMiddle.z() + kAmplitude * std::sin(kShaker * t + 0.3),
                kPeriodogram * kAmplitude);
  const std::complex<double> response =
      Response([&](double t) { return path.At(t).X.p.z(); }, 1.0, 200);
  Validate({"Causes", "base_motion: phase by which a shaken clamp is ahead [rad]",
            "sin(w t + phase)", 0.3, std::arg(response), kPeriodogram, 0, 1e-3});
}

TEST(BaseMotion, ABracketResonatesAsItsTransferFunctionSays) {
  constexpr double kZeta = 0.1;
  for (const double frequency : {3.0, 5.0, 5.5, 40.0}) {
    EndCondition end;
    end.motion = Rocking(0.2, 8.0);
    ClampMotionFault fault;
    fault.bracket_frequency = frequency;
    fault.bracket_damping = kZeta;
    ClampPath path(end, fault);
    const double w0 = 2 * kPi * frequency;
    const std::complex<double> s(0, kShaker);
    const std::complex<double> H =
        (w0 * w0 + 2 * kZeta * w0 * s) / (s * s + 2 * kZeta * w0 * s + w0 * w0);
    // Parabolas of 20 points and more in a period of the bracket, and 400 of the motion.
    constexpr double kGrid = 2e-5;
    for (const double t : {7.1, 7.337, 7.8}) {
      const std::complex<double> y = H * std::exp(s * t);
      const Motion motion = path.At(t);
      EXPECT_NEAR(motion.X.p.z() - kMiddle.z(), kAmplitude * y.imag(), kGrid * kAmplitude)
          << frequency;
      EXPECT_NEAR(motion.v.z(), kAmplitude * (s * y).imag(), kGrid * kAmplitude * kShaker);
      EXPECT_NEAR(motion.a.z(), kAmplitude * (s * s * y).imag(),
                  kGrid * kAmplitude * kShaker * kShaker);
      const Vector3d turn =
          RotationLog(Eigen::Quaterniond(Eigen::AngleAxisd(-1.0, Vector3d::UnitX())) * motion.X.q);
      EXPECT_NEAR(turn.z(), 0.2 * y.imag(), kGrid * 0.2);
    }
    const std::complex<double> response =
        Response([&](double t) { return path.At(t).X.p.z(); }, 7, 200);
    if (frequency != 5.5)
      Validate({"Causes",
                "base_motion: gain of a bracket of " + Shown(frequency) + " Hz shaken with 5 Hz",
                "(1 + 2 i zeta r)/(1 - r^2 + 2 i zeta r)", std::abs(H),
                std::abs(response) / kAmplitude, kGrid * std::abs(H), 0, 1e-3});
    // C2: accelerations on both sides of any instant agree.
    constexpr double kInstant = 1e-7, kChange = 1e-4;
    for (const double t : {0.01, 0.25, 3.0})
      EXPECT_LT((path.At(t + kInstant).a - path.At(t - kInstant).a).norm(),
                kChange * kAmplitude * kShaker * kShaker);
  }
}

TEST(BaseMotion, TiltTurnsTheClampInItsOwnFrame) {
  EndCondition end;
  end.pose = {Vector3d(1, 2, 3), Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Vector3d::UnitX()))};
  ClampMotionFault fault;
  fault.tilt = {0, 0.2, 0};
  ClampPath path(end, fault);
  const Eigen::Quaterniond expected(Eigen::AngleAxisd(0.5, Vector3d::UnitX()) *
                                    Eigen::AngleAxisd(0.2, Vector3d::UnitY()));
  constexpr double kRounding = 1e-15;
  EXPECT_LT(path.At(0).X.q.angularDistance(expected), kRounding + 1e-8);
  EXPECT_EQ(path.At(0).X.p, end.pose.p);
  EXPECT_LT(path.AtStep(0).q.angularDistance(expected), kRounding + 1e-8);
}

TEST(Drift, MakesAPendulumChirp) {
  constexpr double kDuration = 1.0, kChange = 0.3;
  const double J = 2e-6;
  const Experiment experiment = Torsion(J, 0.1, kDuration, 2001);
  Specimen specimen = CableSpecimen();
  specimen.disc_inertia = J;
  specimen.cable.eta_GJ = 1e-8;
  const auto zeros = [&] {
    const SimulatedRecord record = SimulateExperiment(experiment, {specimen}, Fine()).front();
    EXPECT_TRUE(record.ok) << record.message;
    return Zeros(experiment, record.values.col(0));
  };
  const std::vector<double> steady = zeros();
  ASSERT_GT(steady.size(), 15u);
  const double Omega =
      kPi * static_cast<double>(steady.size() - 1) / (steady.back() - steady.front());
  specimen.cable.extensions.push_back(
      {"drift", {{{"EI", 0.0}, {"eta_EI", 0.0}, {"GJ", kChange}, {"eta_GJ", 0.0}}}});
  const std::vector<double> chirped = zeros();
  ASSERT_GT(chirped.size(), steady.size());
  // The instantaneous frequency is Omega sqrt(1 + x t/T): the phase at the n-th zero is (n + 1/2)
  // pi, but for the slow change of the amplitude, of the order of x/(Omega T).
  const double adiabatic = kChange / (Omega * kDuration);
  for (std::size_t n = 0; n < chirped.size(); ++n) {
    const double x = 1 + kChange * chirped[n] / kDuration;
    const double phase = Omega * 2 * kDuration / (3 * kChange) * (std::pow(x, 1.5) - 1);
    EXPECT_NEAR(phase, (static_cast<double>(n) + 0.5) * kPi, adiabatic);
    if (n + 1 == chirped.size())
      Validate({"Causes", "drift: phase of a pendulum whose GJ grows by 0.3, in the end [rad]",
                "2 W T/(3 x) ((1 + x t/T)^(3/2) - 1)", (static_cast<double>(n) + 0.5) * kPi, phase,
                adiabatic, Fine().elements, Fine().dt});
  }
}

TEST(Drift, ThatIsNeutralChangesNoBit) {
  const Experiment experiment = RingDown(0.01, 0.1, 51);
  Specimen specimen = CableSpecimen();
  specimen.cable.extensions.push_back(
      {"drift", {{{"EI", 0.0}, {"eta_EI", 0.0}, {"GJ", 0.0}, {"eta_GJ", 0.0}}}});
  EXPECT_EQ(SimulateExperiment(experiment, {specimen}, Fine()).front().values,
            SimulateExperiment(experiment, {CableSpecimen()}, Fine()).front().values);
}

TEST(Drift, ThatStopsTheDampingLetsTheSwingGoOn) {
  // delta = eta_GJ/(2 L J) falls to nothing: the amplitude is exp(-int delta (1 - t/T) dt).
  const double J = 2e-6;
  const Experiment experiment = Torsion(J, 0.1, 1.0, 2001);
  Specimen specimen = CableSpecimen();
  specimen.disc_inertia = J;
  const CableModel& m = specimen.cable;
  const double delta = m.eta_GJ / m.length / (2 * (J + m.rhoJ() * m.length / 3));
  specimen.cable.extensions.push_back(
      {"drift", {{{"EI", 0.0}, {"eta_EI", 0.0}, {"GJ", 0.0}, {"eta_GJ", -1.0}}}});
  const SimulatedRecord record = SimulateExperiment(experiment, {specimen}, Fine()).front();
  ASSERT_TRUE(record.ok) << record.message;
  const Eigen::VectorXd angle = record.values.col(0);
  const double last = angle.tail(200).cwiseAbs().maxCoeff();
  constexpr double kPeak = 0.02;  // where in its last period the swing is largest
  EXPECT_NEAR(last, 0.1 * std::exp(-delta * 0.5), kPeak * 0.1);
}

TEST(Drift, InLanesLeavesTheNeighboursAlone) {
  const Experiment experiment = RingDown(0.02, 0.1, 51);
  std::vector<Specimen> specimens(4, CableSpecimen());
  specimens[1].cable.extensions.push_back(
      {"drift", {{{"EI", 0.5}, {"eta_EI", 0.2}, {"GJ", 0.0}, {"eta_GJ", 0.0}}}});
  const auto all = SimulateExperiment(experiment, specimens, Fine());
  const auto plain =
      SimulateExperiment(experiment, {CableSpecimen(), CableSpecimen()}, Fine()).front();
  EXPECT_EQ(all[0].values, plain.values);
  EXPECT_EQ(all[3].values, plain.values);
  const auto alone =
      SimulateExperiment(experiment, {specimens[1], CableSpecimen()}, Fine()).front();
  EXPECT_EQ(all[1].values, alone.values);
  EXPECT_GT((all[1].values - plain.values).cwiseAbs().maxCoeff(), 1e-3);
}

Faults Neutral() {
  Faults faults;
  faults.clock = ClockFault();
  faults.sensor = {SensorFault()};
  faults.a = faults.b = ClampMotionFault();
  return faults;
}

TEST(Pipeline, NeutralFaultsChangeNoBit) {
  for (const Experiment& experiment :
       {ShakenArm(0.1, 51), RingDown(0.01, 0.1, 51), Torsion(2e-6, 0.5, 0.1, 51)})
    EXPECT_EQ(Simulated(experiment, Neutral()), Simulated(experiment, {}));
}

TEST(Pipeline, SpecimensSideBySideHaveFaultsOfTheirOwn) {
  Experiment experiment = ShakenArm(0.1, 51);
  experiment.channels.push_back(
      ChannelAt(CableSpecimen().cable.length, Quantity::kAcceleration, 2));
  std::vector<Specimen> specimens(4, CableSpecimen());
  specimens[1].faults.clock = ClockFault{0.2, -0.001, {}};
  specimens[2].faults.clock = ClockFault{-0.2, 0.001, {}};
  specimens[2].faults.sensor = {SensorFault()};
  specimens[2].faults.sensor[0].low_pass = 0.008;
  specimens[3].faults.a = ClampMotionFault();
  specimens[3].faults.a->bracket_frequency = 12;
  const auto all = SimulateExperiment(experiment, specimens, Fine());
  for (std::size_t k = 0; k < specimens.size(); ++k) {
    ASSERT_TRUE(all[k].ok) << all[k].message;
    // In lanes too: with one that has no faults.
    const auto beside =
        SimulateExperiment(experiment, {specimens[k], CableSpecimen()}, Fine()).front();
    EXPECT_EQ(all[k].values, beside.values) << k;
  }
  EXPECT_NE(all[0].values, all[1].values);
}

}  // namespace
}  // namespace cosserat_cable
