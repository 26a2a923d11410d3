// What does not look like a measurement is said; what does is not.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "cosserat_cable/measurement/sample_runs.h"
#include "measurement/set_folder.h"

namespace cosserat_cable {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kRows = 400;

// A noisy, decaying oscillation of 20 mm at 4 Hz, every 5 ms.
double Tip(int i) {
  static std::mt19937 generator(5);
  std::normal_distribution<double> noise(0, 2e-5);
  const double t = 0.005 * i;
  return 0.02 * std::exp(-t) * std::cos(2 * kPi * 4 * t) + noise(generator);
}

using Change = std::function<double(int, double)>;

struct Looks {
  std::string problems, warnings;
};

// What is said of the ring-down, tip_x changed.
Looks Look(
    const Change& change, const std::string& set = std::string(kHead) + kRingdown,
    const std::function<double(int)>& time = [](int i) { return 0.005 * i; }) {
  SetFolder folder;
  WriteAll(&folder, set);
  std::string text = "t,tip_x,tip_z\n";
  for (int i = 0; i < kRows; ++i) {
    text += std::to_string(time(i)) + "," + std::to_string(change(i, Tip(i))) + "," +
            std::to_string(0.245 + 0.0001 * Tip(i) / 0.02 + 1e-6 * (i % 7)) + "\n";
  }
  folder.Write("ringdown_small.csv", text);
  const MeasurementSet read = folder.LoadGood();
  Problems problems, warnings;
  CheckPlausibility(read, &problems, &warnings);
  return {folder.Anonymous(problems), folder.Anonymous(warnings)};
}
double Same(int, double x) { return x; }

TEST(Plausibility, AMeasurementIsOne) {
  const Looks looks = Look(Same);
  EXPECT_EQ(looks.problems, "");
  EXPECT_EQ(looks.warnings, "");
}

TEST(Plausibility, Frozen) {
  const Looks looks = Look([](int i, double x) { return i >= 100 && i < 140 ? 0.00123 : x; });
  EXPECT_EQ(looks.problems, "");
  EXPECT_EQ(looks.warnings,
            "ringdown_small.csv:102: tip_x: got 0.00123 on lines 102 to 141, 40 of 400 samples (10 "
            "%), while it moves elsewhere: frozen, or still within the sensor's resolution\n");
}

TEST(Plausibility, Clipped) {
  const Looks looks = Look([](int, double x) { return std::min(x, 0.012); });
  EXPECT_EQ(looks.problems, "");
  EXPECT_NE(looks.warnings.find("tip_x: got 0.012 on lines "), std::string::npos) << looks.warnings;
  EXPECT_NE(looks.warnings.find(", at the largest or smallest value: clipped\n"), std::string::npos)
      << looks.warnings;
  EXPECT_EQ(looks.warnings.find("frozen"), std::string::npos) << looks.warnings;
}

TEST(Plausibility, CoarseStepsAreNoClipping) {
  Eigen::VectorXd steps(kRows);
  for (int i = 0; i < kRows; ++i) steps[i] = std::round(20 * std::cos(2 * kPi * i / 100.0));
  EXPECT_TRUE(ClippedRuns(steps).empty());
  EXPECT_TRUE(FrozenRuns(steps).empty());
}

TEST(Plausibility, ASlowSensorIsNotFrozen) {
  constexpr int kRepeats = 12;
  Eigen::VectorXd slow(kRepeats * kRows);
  for (int i = 0; i < slow.size(); ++i) slow[i] = std::cos(2 * kPi * (i / kRepeats) / 37.3);
  EXPECT_TRUE(ClippedRuns(slow).empty());
  EXPECT_TRUE(FrozenRuns(slow).empty());
  slow.segment(1000, 15 * kRepeats).setConstant(0.1);
  ASSERT_EQ(FrozenRuns(slow).size(), 1u);
  EXPECT_EQ(FrozenRuns(slow)[0].first, 1000);
  EXPECT_EQ(ClippedRuns(slow.cwiseMin(0.8)).size(), 11u)
      << "turns at the top in 400 / 37.3 periods";
}

TEST(Plausibility, Constant) {
  const Looks looks = Look([](int, double) { return 0.5e-3; });
  EXPECT_EQ(looks.warnings,
            "ringdown_small.csv:1: tip_x: got the same value 0.0005 throughout: it tells nothing "
            "of the cable, not even the noise\n");
}

TEST(Plausibility, Millimetres) {
  // Only beyond 1.1 times the cable's 250 mm a slip is certain.
  const Looks looks = Look([](int, double x) { return 1000 * x; });
  EXPECT_EQ(looks.warnings, "");
  EXPECT_NE(looks.problems.find("m from clamp a here and farther than the cable's 0.25 m in "),
            std::string::npos)
      << looks.problems;
  EXPECT_NE(looks.problems.find("is it in mm?"), std::string::npos);
}

TEST(Plausibility, AnotherZero) {
  const Looks looks = Look([](int, double x) { return x + 3; });
  EXPECT_NE(looks.problems.find("or its zero another one (`offset: unknown`)?"), std::string::npos)
      << looks.problems;
}

/// What is said of a cable of 0.25 m on a clamp that moves along x for 3 s, with its tip seen.
std::string SaidOfAMotion(const std::function<double(double t)>& clamp,
                          const std::function<double(double t)>& tip, double late = 0) {
  MeasurementSet set;
  set.cable.length.value = 0.25;
  Experiment experiment;
  experiment.name = "moved";
  experiment.record.file = "moved.csv";
  experiment.b.kind = EndCondition::Kind::kFree;
  ClampMotion motion;
  motion.file = "clamp_a.csv";
  for (int i = 0; i <= 300; ++i) {
    motion.t.push_back(0.01 * i);
    motion.poses.emplace_back();
    motion.poses.back().p = {clamp(0.01 * i), 0, 0};
  }
  experiment.a.motion = motion;
  Channel channel;
  channel.column = "tip_x";
  channel.s = 0.25;
  experiment.channels = {channel};
  experiment.record.values.resize(300, 1);
  for (int i = 0; i < 300; ++i) {
    experiment.record.t.push_back(0.01 * i + late);
    experiment.record.values(i, 0) = tip(0.01 * i);
  }
  set.experiments = {experiment};
  Problems problems, warnings;
  CheckPlausibility(set, &problems, &warnings);
  return problems.ToString();
}

/// The clamp travels 3 m in 3 s, the cable's other end is seen along the way; the record's times
/// are late by so much [s].
std::string SaidOfATravelThatIs(double late, double factor) {
  return SaidOfAMotion([](double t) { return t; },
                       [&](double t) { return factor * (t + 0.02 * std::sin(30 * t)); }, late);
}

TEST(Plausibility, ALateRecordOfAMovingClampIsNotInMillimetres) {
  EXPECT_EQ(SaidOfATravelThatIs(0, 1), "");
  const std::string late = SaidOfATravelThatIs(1, 1), early = SaidOfATravelThatIs(-1, 1);
  // Within 0.275 m of the clamp, it fits from 0.725 s on; tried in steps of 0.03 s.
  EXPECT_NE(late.find("are its times 0.7"), std::string::npos) << late;
  EXPECT_NE(late.find(" s too late beside the clamp's motion"), std::string::npos) << late;
  EXPECT_NE(early.find(" s too early beside the clamp's motion"), std::string::npos) << early;
  EXPECT_EQ(late.find("in mm"), std::string::npos) << late;
  const std::string scaled = SaidOfATravelThatIs(0, 1000);
  EXPECT_NE(scaled.find("is it in mm?"), std::string::npos) << scaled;
}

/// The clamp swings by 0.1 m about a place 1 m from the origin, the cable's end is seen behind it;
/// `change` is done to what the clamp's file says.
std::string SaidOfASwingWith(const std::function<double(double x)>& change) {
  const auto place = [](double t) { return 1 + 0.1 * std::sin(4 * t); };
  return SaidOfAMotion([&](double t) { return change(place(t)); },
                       [&](double t) { return place(t - 0.05); });
}

TEST(Plausibility, TheUnitOfAMotionFileIsItsOwnAndNoChannels) {
  EXPECT_EQ(SaidOfASwingWith([](double x) { return x; }), "");
  struct Unit {
    double factor;
    const char* name;
  };
  for (const Unit& unit : {Unit{1e3, "mm"}, Unit{1e2, "cm"}, Unit{1 / 0.0254, "inches"}})
    for (const double from : {0.0, 1.0}) {
      const std::string said =
          SaidOfASwingWith([&](double x) { return from + unit.factor * (x - from); });
      EXPECT_NE(said.find("clamp_a.csv"), std::string::npos) << said;
      EXPECT_NE(said.find(std::string("is it in ") + unit.name), std::string::npos) << said;
      EXPECT_EQ(said.find("tip_x"), std::string::npos) << said;
    }
}

TEST(Plausibility, ExchangedColumnsAreOffered) {
  SetFolder folder;
  WriteAll(&folder, std::string(kHead) + kRingdown);
  std::string text = "t,tip_x,tip_z\n";
  for (int i = 0; i < kRows; ++i)
    text += std::to_string(0.005 * i) + "," + std::to_string(0.6 + 1e-6 * (i % 7)) + "," +
            std::to_string(0.1 + 0.01 * Tip(i)) + "\n";
  folder.Write("ringdown_small.csv", text);
  MeasurementSet set = folder.LoadGood();
  set.experiments[0].a.pose.p.z() = 0.5;
  Problems problems, warnings;
  CheckPlausibility(set, &problems, &warnings);
  EXPECT_NE(folder.Anonymous(problems).find("is it exchanged with 'tip_z'?"), std::string::npos)
      << folder.Anonymous(problems);
}

TEST(Plausibility, AMassInGrams) {
  // The cable of 0.25 m weighs 22.5 g.
  for (const auto& [mass, heavy] : {std::pair<const char*, bool>{"0.3", false}, {"5", true}}) {
    const Looks looks =
        Look(Same, Replaced(std::string(kHead), "experiments:",
                            std::string("  masses: [{s: 0.1, mass: ") + mass + "}]\nexperiments:") +
                       kRingdown);
    EXPECT_EQ(looks.problems, "");
    EXPECT_EQ(looks.warnings.find("is it in grams?") != std::string::npos, heavy) << looks.warnings;
  }
}

TEST(Plausibility, Outliers) {
  const Looks looks = Look([](int i, double x) { return i == 50 || i == 60 ? x + 0.01 * i : x; });
  EXPECT_EQ(looks.problems, "");
  EXPECT_NE(looks.warnings.find("ringdown_small.csv:62: tip_x: is 0.6"), std::string::npos)
      << looks.warnings;
  EXPECT_NE(looks.warnings.find("in 2 of 400 samples (0.5 %): an outlier?"), std::string::npos)
      << looks.warnings;
}

TEST(Plausibility, Gap) {
  const Looks looks = Look(Same, std::string(kHead) + kRingdown,
                           [](int i) { return 0.005 * i + (i >= 200 ? 0.5 : 0); });
  EXPECT_EQ(looks.problems, "");
  EXPECT_EQ(looks.warnings,
            "ringdown_small.csv:202: t: got no sample for 0.505 s, 101 times the usual period: a "
            "gap\n");
}

TEST(Plausibility, FewSamplesAndDegrees) {
  SetFolder folder;
  WriteAll(&folder, std::string(kHead) + kTorsion);
  folder.Write("torsion/pendulum.csv", "t,phi_dot,phi\n0,0,69\n1,-3,-66\n");
  Problems problems, warnings;
  CheckPlausibility(folder.LoadGood(), &problems, &warnings);
  EXPECT_EQ(folder.Anonymous(problems), "");
  EXPECT_EQ(folder.Anonymous(warnings),
            "torsion/pendulum.csv: got 2 samples, expected at least 8: too few to tell motion from "
            "noise\n"
            "torsion/pendulum.csv:2: phi: got 69 rad: is it in degrees?\n");
}

TEST(Plausibility, ClampsAndStartsOutOfReach) {
  const std::string set = Replaced(
      Replaced(std::string(kHead) + kRingdown, "b: free", "b: {pose: [0, 24, 0, 0, 0, 0, 1]}"),
      "position: [0.01, 0, 0.249]", "position: [10, 0, 249]");
  const Looks looks = Look(Same, set);
  EXPECT_EQ(looks.problems,
            "measurement.yaml:15: experiments[0].b: the clamps are 24 m apart, the cable is 0.25 m "
            "long: is it in mm?\n"
            "measurement.yaml:16: experiments[0].start.held: is 249 m from clamp a, the cable is "
            "0.25 m long: is it in mm?\n");
  EXPECT_EQ(looks.warnings, "");
}

TEST(Plausibility, GoodSetsOfEachKind) {
  SetFolder folder;
  WriteAll(&folder, AllSets());
  Problems problems, warnings;
  CheckPlausibility(folder.LoadGood(), &problems, &warnings);
  EXPECT_EQ(problems.ToString(), "");
}

}  // namespace
}  // namespace cosserat_cable
