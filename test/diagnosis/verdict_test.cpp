// The verdict from sums of squares alone: each rule on numbers made for it.
#include "../../src/diagnosis/verdict.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cosserat_cable {
namespace {

constexpr double kSamples = 1000;

/// A contender that leaves `times` the noise's variance.
Contender Leaves(std::vector<std::string> causes, double times, int parameters = 1) {
  Contender one;
  one.causes = std::move(causes);
  one.parameters = parameters;
  one.adequacy.chi2 = times * kSamples;
  one.adequacy.expected = kSamples;
  one.adequacy.sd = std::sqrt(2 * kSamples);
  one.adequacy.adequate = times < 1.1;
  return one;
}

/// Differences as the sums of squares have them, with a standard error of this part of each.
Judgement JudgeWith(const std::vector<Contender>& contenders, double relative_error = 0.1) {
  const DifferenceBetween difference = [&](int worse, int better) {
    Difference d;
    d.value = contenders[worse].adequacy.chi2 - contenders[better].adequacy.chi2;
    d.se = relative_error * std::abs(d.value);
    d.most_per_sample = d.value / kSamples;
    return d;
  };
  return Judge(contenders, difference, difference);
}

TEST(VerdictTest, NoneWhereThePlainModelLeavesNoise) {
  const Judgement found = JudgeWith({Leaves({}, 1.0, 0), Leaves({"air_drag"}, 0.99)});
  EXPECT_EQ(found.verdict, Verdict::kNone);
  EXPECT_EQ(found.best, 0);
  EXPECT_NE(found.rejected[1].find("chance"), std::string::npos);
}

TEST(VerdictTest, NamedWhereOneLeavesNoiseAndTheOthersDoNot) {
  const Judgement found =
      JudgeWith({Leaves({}, 5, 0), Leaves({"air_drag"}, 1.01), Leaves({"external_damping"}, 2.5)});
  EXPECT_EQ(found.verdict, Verdict::kNamed);
  EXPECT_EQ(found.best, 1);
  EXPECT_NE(found.rejected[2].find("62.5 %"), std::string::npos) << found.rejected[2];
}

TEST(VerdictTest, AFaintFaultIsNeitherNamedNorARival) {
  Contender tilt = Leaves({"sensor"}, 1.0);
  tilt.faint = true;
  const Judgement alone = JudgeWith({Leaves({}, 5, 0), tilt});
  EXPECT_EQ(alone.verdict, Verdict::kUnexplained);
  EXPECT_EQ(alone.best, 0);
  EXPECT_NE(alone.rejected[1].find("too small"), std::string::npos);
  const Judgement beside = JudgeWith({Leaves({}, 5, 0), tilt, Leaves({"air_drag"}, 1.01)});
  EXPECT_EQ(beside.verdict, Verdict::kNamed);
  EXPECT_EQ(beside.best, 2);
}

TEST(VerdictTest, AmbiguousWhereTwoLeaveTheSame) {
  const Judgement found = JudgeWith(
      {Leaves({}, 5, 0), Leaves({"air_drag"}, 1.000), Leaves({"external_damping"}, 1.002)});
  EXPECT_EQ(found.verdict, Verdict::kAmbiguous);
  EXPECT_EQ(found.rivals, std::vector<int>{2});
}

TEST(VerdictTest, ARivalThatDiffersInOneStretchOnlyIsNotExcluded) {
  const std::vector<Contender> contenders = {Leaves({}, 5, 0), Leaves({"air_drag"}, 1.00),
                                             Leaves({"external_damping"}, 1.05)};
  EXPECT_EQ(JudgeWith(contenders, 0.1).verdict, Verdict::kNamed);
  EXPECT_EQ(JudgeWith(contenders, 0.5).verdict, Verdict::kAmbiguous);
}

TEST(VerdictTest, TheSimplerOfTwoThatContainEachOtherWins) {
  const Judgement found = JudgeWith({Leaves({}, 5, 0), Leaves({"clamp_friction"}, 1.000, 3),
                                     Leaves({"clamp_compliance"}, 1.010, 1)});
  EXPECT_EQ(found.verdict, Verdict::kNamed);
  EXPECT_EQ(found.best, 2);
  EXPECT_NE(found.rejected[1].find("contains the simpler"), std::string::npos);
}

TEST(VerdictTest, TheLargerWinsWhereItExplainsMore) {
  const Judgement found = JudgeWith({Leaves({}, 5, 0), Leaves({"clamp_friction"}, 1.00, 3),
                                     Leaves({"clamp_compliance"}, 1.8, 1)});
  EXPECT_EQ(found.verdict, Verdict::kNamed);
  EXPECT_EQ(found.best, 1);
}

TEST(VerdictTest, UnexplainedWhereTheBestLeavesMuch) {
  const Judgement found =
      JudgeWith({Leaves({}, 9, 0), Leaves({"air_drag"}, 4), Leaves({"maxwell"}, 6)});
  EXPECT_EQ(found.verdict, Verdict::kUnexplained);
  EXPECT_TRUE(found.rivals.empty());
}

TEST(VerdictTest, UnexplainedWhereNothingHelps) {
  const Judgement found = JudgeWith({Leaves({}, 9, 0), Leaves({"air_drag"}, 8.99)});
  EXPECT_EQ(found.verdict, Verdict::kUnexplained);
  EXPECT_EQ(found.best, 0);
}

TEST(VerdictTest, ALawThatIsRightInKindIsNamed) {
  // 98 % of a misfit of 50 noise variances; its rival explains 80 %.
  const Judgement found =
      JudgeWith({Leaves({}, 51, 0), Leaves({"section_friction"}, 2.0), Leaves({"air_drag"}, 11)});
  EXPECT_EQ(found.verdict, Verdict::kNamed);
  EXPECT_EQ(found.best, 1);
}

TEST(VerdictTest, TwoCausesAreNamedOnlyWhereEachIsNeeded) {
  const std::vector<Contender> needed = {Leaves({}, 20, 0), Leaves({"air_drag"}, 6),
                                         Leaves({"drift"}, 9),
                                         Leaves({"air_drag", "drift"}, 1.0, 2)};
  EXPECT_EQ(JudgeWith(needed).verdict, Verdict::kNamed);
  EXPECT_EQ(JudgeWith(needed).best, 3);
  const std::vector<Contender> spare = {Leaves({}, 20, 0), Leaves({"air_drag"}, 1.03),
                                        Leaves({"air_drag", "drift"}, 1.0, 2)};
  EXPECT_EQ(JudgeWith(spare).verdict, Verdict::kNamed);
  EXPECT_EQ(JudgeWith(spare).best, 1);
}

TEST(VerdictTest, OnlyLawsOfTheCableMayDifferInForm) {
  const auto verdict = [](std::vector<std::string> causes) {
    return JudgeWith({Leaves({}, 200, 0), Leaves(std::move(causes), 3)}).verdict;
  };
  EXPECT_EQ(verdict({"nonlinear_stiffness"}), Verdict::kNamed);
  EXPECT_EQ(verdict({"clock"}), Verdict::kUnexplained);
  EXPECT_EQ(verdict({"contact", "bend_twist_coupling"}), Verdict::kUnexplained);
  EXPECT_EQ(verdict({"contact", "section_friction"}), Verdict::kNamed);
}

TEST(VerdictTest, TwoCausesThatLeaveMuchOfWhatOneLeavesExplainNothing) {
  const auto with_both_leaving = [](double one, double both) {
    return JudgeWith({Leaves({}, 17, 0), Leaves({"air_drag"}, one), Leaves({"drift"}, 15),
                      Leaves({"air_drag", "drift"}, both, 2)});
  };
  EXPECT_EQ(with_both_leaving(1.8, 1.3).verdict, Verdict::kUnexplained);
  EXPECT_EQ(with_both_leaving(4, 1.25).verdict, Verdict::kNamed);
  EXPECT_EQ(with_both_leaving(4, 1.25).best, 3);
  // One that is right in kind stands, whatever a second one takes of what it leaves.
  EXPECT_EQ(with_both_leaving(1.4, 1.2).verdict, Verdict::kNamed);
  EXPECT_EQ(with_both_leaving(1.4, 1.2).best, 1);
}

TEST(VerdictTest, WhatPredictsNoBetterIsNotBesideNoise) {
  const std::vector<Contender> contenders = {Leaves({}, 1.09, 0), Leaves({"sensor"}, 0.97, 3)};
  EXPECT_EQ(JudgeWith(contenders).verdict, Verdict::kNamed);
  const DifferenceBetween fitted = [&](int worse, int better) {
    const double value = contenders[worse].adequacy.chi2 - contenders[better].adequacy.chi2;
    return Difference{value, 1.0, value / kSamples};
  };
  const DifferenceBetween predicted = [&](int worse, int better) {
    return Difference{-fitted(worse, better).value, 1.0};
  };
  EXPECT_EQ(Judge(contenders, fitted, predicted).verdict, Verdict::kNone);
}

TEST(VerdictTest, WhatIsSmallBesideTheNoiseIsNotNamedHoweverSignificant) {
  const std::vector<Contender> contenders = {Leaves({}, 1.04, 0), Leaves({"sensor"}, 0.97, 1)};
  const Judgement everywhere = JudgeWith(contenders);
  EXPECT_EQ(everywhere.verdict, Verdict::kNone);
  EXPECT_NE(everywhere.rejected[1].find("7 % of the noise's variance"), std::string::npos)
      << everywhere.rejected[1];
  const DifferenceBetween in_one_record = [&](int worse, int better) {
    const double value = contenders[worse].adequacy.chi2 - contenders[better].adequacy.chi2;
    return Difference{value, 1.0, 20 * value / kSamples};
  };
  EXPECT_EQ(Judge(contenders, in_one_record, in_one_record).verdict, Verdict::kNamed);
}

TEST(VerdictTest, ContainingIsByCauseAndByPart) {
  EXPECT_TRUE(Contains({"clamp_friction"}, {"clamp_compliance"}));
  EXPECT_TRUE(Contains({"air_drag", "clamp_friction"}, {"air_drag", "clamp_compliance"}));
  EXPECT_TRUE(Contains({"air_drag", "drift"}, {"drift"}));
  EXPECT_TRUE(Contains({"air_drag"}, {}));
  EXPECT_FALSE(Contains({"clamp_compliance"}, {"clamp_friction"}));
  EXPECT_FALSE(Contains({"air_drag"}, {"air_drag"}));
  EXPECT_FALSE(Contains({"air_drag"}, {"air_drag", "drift"}));
}

}  // namespace
}  // namespace cosserat_cable
