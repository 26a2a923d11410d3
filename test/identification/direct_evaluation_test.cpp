// EvaluateDirectly on records made with the formulas (11) to (13), turned round by hand.

#include "cosserat_cable/identification/direct_evaluation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "../../src/identification/direct_biases.h"
#include "../../src/identification/weighted_line.h"
#include "cosserat_cable/cable/parameters.h"

namespace cosserat_cable {
namespace {

// Records carry noise of 1e-4 of their amplitude; frequencies are then good to 1e-5 and decay
// rates to 1e-3.
constexpr double kNoise = 1e-4;
constexpr double kFrequency = 1e-4;
constexpr double kDecay = 5e-3;

template <typename T>
CableKey<T> Known(const T& value) {
  return {value, {}};
}

Record Ringing(double omega, double delta, double amplitude, std::mt19937* random) {
  std::normal_distribution<double> normal;
  Record record;
  record.values.resize(600, 1);
  for (int i = 0; i < 600; ++i) {
    const double t = 0.005 * i;
    record.t.push_back(t);
    record.values(i, 0) =
        amplitude * (std::exp(-delta * t) * std::cos(omega * t - 0.2) + kNoise * normal(*random));
  }
  return record;
}

// Clamped at the origin, its tangent along x (level) or down.
Experiment Cantilever(bool hangs, double omega, double delta, std::mt19937* random) {
  Experiment e;
  e.name = "bend";
  // 90 degrees about y turn z into x, 180 degrees into -z.
  e.a.pose.q =
      Eigen::AngleAxisd((hangs ? 1.0 : 0.5) * 3.14159265358979323846, Eigen::Vector3d::UnitY());
  e.b.kind = EndCondition::Kind::kFree;
  e.start.kind = StartCondition::Kind::kUnknown;
  Channel tip;
  tip.column = "tip_y";
  tip.s = 0.2;
  tip.axis = 1;
  e.channels = {tip};
  e.record = Ringing(omega, delta, 0.002, random);
  return e;
}

Experiment Pendulum(double length, double inertia, double omega, double delta,
                    std::mt19937* random) {
  Experiment e;
  e.name = "twist";
  e.specimen.length = Known(length);
  e.a.pose.q = Eigen::AngleAxisd(3.14159265358979323846, Eigen::Vector3d::UnitY());
  e.b.kind = EndCondition::Kind::kDisc;
  e.b.disc.inertia = inertia;
  e.b.disc.mass = 0.15;
  e.start.kind = StartCondition::Kind::kTwisted;
  Channel angle;
  angle.column = "angle";
  angle.quantity = Quantity::kAngle;
  angle.s = length;
  e.channels = {angle};
  e.record = Ringing(omega, delta, 1.0, random);
  return e;
}

MeasurementSet Wire() {
  MeasurementSet set;
  set.cable.length = Known(0.2);
  set.cable.diameter = Known(0.004);
  set.cable.mass_per_length = Known(0.027);
  set.cable.GJ = Known(1.0e-3);
  return set;
}

const DirectBias* Find(const DirectRingDown& ring, const std::string& name) {
  for (const DirectBias& bias : ring.biases) {
    if (bias.name == name) return &bias;
  }
  return nullptr;
}

TEST(DirectEvaluation, AFitFarFromTheFrequencyIsNamed) {
  std::mt19937 random(1);
  MeasurementSet set = Wire();
  set.experiments = {Cantilever(false, 20.0, 1.5, &random)};
  const DirectEvaluation out = EvaluateDirectly(set);
  const double EI = 402.25 * 3.494486e-6;  // as in BendingByHand
  EXPECT_EQ(DisagreementOf(out, "EI", 0.99 * EI, 1.01 * EI), "");
  EXPECT_EQ(DisagreementOf(out, "GJ", 0.99 * EI, 1.01 * EI), "");
  const std::string text = DisagreementOf(out, "EI", 2.49 * EI, 2.51 * EI);
  EXPECT_NE(text.find("the frequency alone of bend makes [EI] 0.0014"), std::string::npos) << text;
  // A wide interval contradicts nothing.
  EXPECT_EQ(DisagreementOf(out, "EI", 0.5 * EI, 4.5 * EI), "");
  // Of a hanging cable gravity's share is taken away first: w^2 rises by 1.571 g/L = 77.06.
  set.experiments = {Cantilever(true, 20.0, 1.5, &random)};
  const double without = (402.25 - 77.06) * 3.494486e-6;
  EXPECT_EQ(DisagreementOf(EvaluateDirectly(set), "EI", 0.99 * without, 1.01 * without), "");
}

TEST(DirectEvaluation, BendingByHand) {
  std::mt19937 random(1);
  MeasurementSet set = Wire();
  set.experiments = {Cantilever(false, 20.0, 1.5, &random)};
  const DirectEvaluation out = EvaluateDirectly(set);
  // w^2 = 402.25; C_bc = 0.027 (0.2/1.87510407)^4 = 3.494486e-6 kg m^3.
  const double C = 3.494486e-6;
  ASSERT_EQ(out.bending.size(), 1u);
  ASSERT_EQ(out.bending[0].refused, "");
  EXPECT_EQ(out.bending[0].plane, "across the sag");
  EXPECT_NEAR(out.values.at("EI").value, 402.25 * C, kFrequency * 402.25 * C);
  EXPECT_NEAR(out.values.at("eta_EI").value, 3.0 * C, kDecay * 3.0 * C);
  EXPECT_GT(out.values.at("EI").sd, 0);
  EXPECT_LT(std::abs(out.values.at("EI").value - 402.25 * C), 4 * out.values.at("EI").sd);
  EXPECT_LT(std::abs(out.values.at("eta_EI").value - 3 * C), 4 * out.values.at("eta_EI").sd);
  // The tip sags by rhoA g L^4/(8 EI) = 37.7 mm, 0.188 L.
  ASSERT_NE(Find(out.bending[0], "sag"), nullptr);
  EXPECT_NEAR(Find(out.bending[0], "sag")->relative, 0.188 * 0.188, 0.001);
  // 2 mm of 200.
  const DirectBias* amplitude = Find(out.bending[0], "large_amplitude");
  EXPECT_TRUE(amplitude == nullptr || amplitude->relative < 1.1e-4);
  EXPECT_EQ(out.values.count("GJ"), 0u);
  // (10): (4 L/pi) sqrt(rhoJ GJ), rhoJ = rhoA d^2/8 = 5.4e-8.
  EXPECT_NEAR(out.critical.at("eta_GJ"), 0.8 / 3.14159265 * std::sqrt(5.4e-8 * 1e-3), 1e-10);
}

TEST(DirectEvaluation, NamesWhatGravityDoesToAHangingWire) {
  std::mt19937 random(2);
  const double EI = 1.2e-3;
  const double square = 12.362 * EI / (0.027 * std::pow(0.2, 4)) + 1.571 * 9.81 / 0.2;
  MeasurementSet set = Wire();
  set.experiments = {Cantilever(true, std::sqrt(square - 1), 1, &random)};
  const DirectEvaluation out = EvaluateDirectly(set);
  ASSERT_EQ(out.bending.at(0).plane, "across");
  const double high = out.values.at("EI").value / EI - 1;
  EXPECT_GT(high, 0.20);
  EXPECT_LT(high, 0.25);
  ASSERT_NE(Find(out.bending[0], "gravity"), nullptr);
  constexpr double kRoot = 1e-3;  // 12.362 is mu0^4 in five digits
  EXPECT_NEAR(Find(out.bending[0], "gravity")->relative, high, kRoot);
  EXPECT_EQ(Find(out.bending[0], "sag"), nullptr);
}

TEST(DirectEvaluation, MassAtTheTipByRayleigh) {
  std::mt19937 random(3);
  MeasurementSet set = Wire();
  LumpedMassKey clip;
  clip.mass = {0.2, 1e-4};
  set.cable.masses = Known(std::vector<LumpedMassKey>{clip});
  set.experiments = {Cantilever(false, 20.0, 1.5, &random)};
  const DirectEvaluation out = EvaluateDirectly(set);
  // w^2 = 3 EI/(L^3 (m + 0.2357 rhoA L)), 0.2357 for the static shape where the mode has 1/4 of
  // 3/mu0^4 = 0.2427: the same up to 4 % of the effect.
  const double effect = 1e-4 / (1e-4 + 0.2427 * 0.027 * 0.2);
  ASSERT_NE(Find(out.bending[0], "masses"), nullptr);
  EXPECT_NEAR(Find(out.bending[0], "masses")->relative, -effect, 0.04 * effect);
  EXPECT_NEAR(CantileverShape(1), 1, 1e-12);
  EXPECT_NEAR(CantileverShape(0.5), 0.3395, 1e-4);  // tables of beam modes
}

// delta = (eta_GJ/L + D_E)/(2 J), w^2 = GJ/(L J).
Experiment Twisted(double length, double GJ, double eta, double D_E, double factor,
                   std::mt19937* random) {
  const double J = 1e-4;
  const double delta = factor * (eta / length + D_E) / (2 * J);
  return Pendulum(length, J, std::sqrt(GJ / (length * J) - delta * delta), delta, random);
}

TEST(DirectEvaluation, TorsionOverLengths) {
  std::mt19937 random(4);
  MeasurementSet set = Wire();
  for (const double length : {0.1, 0.2, 0.4}) {
    set.experiments.push_back(Twisted(length, 1e-2, 4e-5, 1e-4, 1, &random));
  }
  const DirectEvaluation out = EvaluateDirectly(set);
  ASSERT_EQ(out.torsion.size(), 3u);
  EXPECT_NEAR(out.values.at("GJ").value, 1e-2, kFrequency * 1e-2);
  const DirectValue eta = out.values.at("eta_GJ"), D_E = out.values.at(kEndDamping);
  EXPECT_NEAR(eta.value, 4e-5, 4 * eta.sd);
  EXPECT_NEAR(D_E.value, 1e-4, 4 * D_E.sd);
  EXPECT_NEAR(eta.value, 4e-5, kDecay * 4e-5);
  EXPECT_NEAR(D_E.value, 1e-4, kDecay * 1e-4);
  EXPECT_LT(out.eta_GJ_D_E_correlation, -0.5);
  EXPECT_FALSE(out.combination);
  // The cable's own inertia, rhoJ L/3 = 5.4e-8 0.1/3, against 1e-4; the disc's weight,
  // 0.15 9.81 d^2/8 = 2.94e-6 against 1e-2.
  EXPECT_EQ(Find(out.torsion[0], "cable_inertia"), nullptr);
  EXPECT_NEAR(Find(out.torsion[0], "disc_weight")->relative, 2.943e-4, 1e-6);
}

TEST(DirectEvaluation, OneLengthGivesOneCombination) {
  std::mt19937 random(5);
  MeasurementSet set = Wire();
  for (int i = 0; i < 3; ++i) {
    set.experiments.push_back(Twisted(0.2, 1e-2, 4e-5, 1e-4, 1, &random));
  }
  const DirectEvaluation out = EvaluateDirectly(set);
  EXPECT_EQ(out.values.count("eta_GJ"), 0u);
  EXPECT_EQ(out.values.count(kEndDamping), 0u);
  ASSERT_TRUE(out.combination);
  EXPECT_NEAR(out.combination->value, 3e-4, kDecay * 3e-4);
  EXPECT_NE(out.undetermined.at("eta_GJ").find("eta_GJ/L + D_E"), std::string::npos);
  EXPECT_NE(out.undetermined.at(kEndDamping).find("0.2 m"), std::string::npos);
}

TEST(DirectEvaluation, RepeatsThatScatterMakeTheInterval) {
  std::mt19937 random(6);
  MeasurementSet set = Wire();
  const std::vector<double> factors = {0.8, 0.95, 1.0, 1.05, 1.2};
  for (const double factor : factors) {
    set.experiments.push_back(Twisted(0.2, 1e-2, 4e-5, 1e-4, factor, &random));
  }
  const DirectEvaluation out = EvaluateDirectly(set);
  ASSERT_TRUE(out.combination);
  // Mean 1; squares 0.04 + 0.0025 + 0.0025 + 0.04 = 0.085 over 4: 0.1458, over sqrt 5: 0.0652.
  EXPECT_NEAR(out.combination->value, 3e-4, kDecay * 3e-4);
  EXPECT_NEAR(out.combination->scatter, 0.1458 * 3e-4, 0.01 * 0.1458 * 3e-4);
  EXPECT_NEAR(out.combination->sd, 0.0652 * 3e-4, 0.01 * 0.0652 * 3e-4);
  EXPECT_NEAR(out.combination->high - out.combination->value, 2.776 * out.combination->sd,
              0.001 * out.combination->sd);
}

TEST(DirectEvaluation, SaysWhatItCannotEvaluate) {
  std::mt19937 random(7);
  MeasurementSet set = Wire();
  Experiment noise = Cantilever(false, 20, 1.5, &random);
  for (double& value : noise.record.values.reshaped()) {
    value = 1e-5 * std::normal_distribution<double>()(random);
  }
  set.experiments = {noise};
  const DirectEvaluation out = EvaluateDirectly(set);
  EXPECT_EQ(out.values.count("EI"), 0u);
  EXPECT_EQ(out.undetermined.count("EI"), 1u);
  EXPECT_NE(out.bending[0].refused, "");
  EXPECT_NE(out.bending[0].messages.at(0).find("tip_y: no oscillation"), std::string::npos);
  const nlohmann::json json = ToJson(out);
  EXPECT_TRUE(json["values"].empty());
  EXPECT_EQ(json["bending"][0].count("stiffness"), 0u);
}

TEST(DirectEvaluation, LeavesOtherExperimentsOut) {
  std::mt19937 random(8);
  MeasurementSet set = Wire();
  Experiment driven = Cantilever(false, 20, 1.5, &random), loaded = driven, steps = driven;
  driven.a.motion.emplace();
  loaded.load.samples.resize(1);
  steps.record.quasi_static = true;
  set.experiments = {driven, loaded, steps};
  const DirectEvaluation out = EvaluateDirectly(set);
  EXPECT_TRUE(out.bending.empty());
  EXPECT_TRUE(out.values.empty());
  EXPECT_TRUE(out.undetermined.empty());
}

TEST(DirectEvaluation, JsonHoldsTheNumbers) {
  std::mt19937 random(9);
  MeasurementSet set = Wire();
  set.experiments = {Cantilever(false, 20, 1.5, &random),
                     Twisted(0.2, 1e-2, 4e-5, 1e-4, 1, &random)};
  const DirectEvaluation out = EvaluateDirectly(set);
  const nlohmann::json json = ToJson(out);
  EXPECT_EQ(json["values"]["EI"]["value"].get<double>(), out.values.at("EI").value);
  EXPECT_EQ(json["combination"]["value"].get<double>(), out.combination->value);
  EXPECT_EQ(json["bending"][0]["omega"][1].get<double>(), out.bending[0].omega_sd);
  EXPECT_EQ(json["torsion"][0]["inertia"].get<double>(), 1e-4);
  EXPECT_EQ(json["undetermined"][kEndDamping].get<std::string>(), out.undetermined.at(kEndDamping));
}

TEST(WeightedLine, Quantiles) {
  // Printed tables.
  constexpr double kTable = 1e-3;
  EXPECT_NEAR(StudentQuantile(1), 12.706, kTable);
  EXPECT_NEAR(StudentQuantile(2), 4.303, kTable);
  EXPECT_NEAR(StudentQuantile(5), 2.571, kTable);
  EXPECT_NEAR(StudentQuantile(30), 2.042, kTable);
  constexpr double kHundredth = 0.01;
  EXPECT_NEAR(ChiSquareQuantile(1), 3.841, kTable);
  EXPECT_NEAR(ChiSquareQuantile(2) / 5.991, 1, kHundredth);
  EXPECT_NEAR(ChiSquareQuantile(10) / 18.307, 1, kHundredth);
}

TEST(WeightedLine, CoversWithAndWithoutScatter) {
  // 95 % of 1000 have a standard error of 0.7 %.
  constexpr double kLeast = 0.90, kMost = 0.98;
  std::mt19937 random(10);
  std::normal_distribution<double> normal;
  for (const double scatter : {0.0, 0.05, 0.5}) {
    int covered = 0;
    for (int trial = 0; trial < 1000; ++trial) {
      Eigen::MatrixXd X = Eigen::MatrixXd::Ones(9, 2);
      Eigen::VectorXd y(9), variance(9);
      for (int i = 0; i < 9; ++i) {
        X(i, 0) = 1 / (0.1 + 0.1 * (i / 3));
        variance[i] = std::pow(0.05 * (1 + i % 3), 2);
        y[i] =
            0.3 * X(i, 0) + 2 + std::sqrt(variance[i]) * normal(random) + scatter * normal(random);
      }
      const WeightedLine line = FitWeightedLine(X, y, variance);
      if (std::abs(line.estimate[0] - 0.3) < line.quantile * line.sd(0)) ++covered;
    }
    RecordProperty("covered_at_" + std::to_string(scatter), covered);
    EXPECT_GE(covered, kLeast * 1000) << scatter;
    EXPECT_LE(covered, kMost * 1000) << scatter;
  }
}

}  // namespace
}  // namespace cosserat_cable
