#include <gtest/gtest.h>

#include <cfloat>
#include <clocale>
#include <cmath>
#include <limits>
#include <random>

#include "cosserat_cable/input/number_spec.h"
#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {
namespace {

using Kind = NumberText::Kind;

TEST(ParseNumber, ReadsDecimals) {
  const std::pair<const char*, double> cases[] = {{"12", 12},    {"-0.5", -0.5}, {".5", 0.5},
                                                  {"1.", 1},     {"1e-3", 1e-3}, {"+2.5E+2", 250},
                                                  {"-.5e1", -5}, {"0", 0},       {"007", 7}};
  for (const auto& [text, value] : cases) {
    EXPECT_EQ(ParseNumber(text).kind, Kind::kFinite) << text;
    EXPECT_EQ(ParseNumber(text).value, value) << text;
  }
}

TEST(ParseNumber, KnowsWhatIsNotFinite) {
  for (const char* text :
       {"nan", ".nan", "NaN", ".NaN", "inf", "-.inf", "+inf", "Infinity", "1e400"}) {
    EXPECT_EQ(ParseNumber(text).kind, Kind::kNonFinite) << text;
  }
}

TEST(ParseNumber, RefusesWhatIsNoNumber) {
  for (const char* text : {"", "-", ".", "e5", "1e", "1e+", "0x10", "1_000", "1,5", "1.2.3", " 1",
                           "1 ", "200 mm", "one", "--1", "1-"}) {
    EXPECT_EQ(ParseNumber(text).kind, Kind::kNone) << text;
  }
}

TEST(FormatNumber, IsShortForShortNumbers) {
  EXPECT_EQ(FormatNumber(0.2), "0.2");
  EXPECT_EQ(FormatNumber(0.1 + 0.2), "0.30000000000000004");
  EXPECT_EQ(FormatNumber(-40), "-40");
  EXPECT_EQ(FormatNumber(1e-4), "0.0001");
}

TEST(FormatRounded, HasNoExponentWherePeopleWriteNone) {
  EXPECT_EQ(FormatRounded(0.123456), "0.123");
  EXPECT_EQ(FormatRounded(0.0001234), "0.000123");
  EXPECT_EQ(FormatRounded(999.6), "1000");
  EXPECT_EQ(FormatRounded(3514.2), "3510");
  EXPECT_EQ(FormatRounded(-249423), "-249000");
  EXPECT_EQ(FormatRounded(249423, 2), "250000");
  EXPECT_EQ(FormatRounded(999600), "1e+06");
  EXPECT_EQ(FormatRounded(1.5e8), "1.5e+08");
  EXPECT_EQ(FormatRounded(1.2e-5), "1.2e-05");
}

TEST(FormatLength, ChangesItsUnitWhereTheRoundedFigureDoes) {
  EXPECT_EQ(FormatLength(0.01234), "12.3 mm");
  EXPECT_EQ(FormatLength(0.9994), "999 mm");
  EXPECT_EQ(FormatLength(0.99976), "1 m");
  EXPECT_EQ(FormatLength(-1.2345), "-1.23 m");
  EXPECT_EQ(FormatLength(2500), "2500 m");
  EXPECT_EQ(FormatLength(0.99976, 4), "999.8 mm");
  EXPECT_EQ(FormatLength(0), "0 mm");
}

TEST(FormatNumber, ReadsBackToTheSameBits) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> mantissa(-10, 10), exponent(-300, 300);
  for (int i = 0; i < 2000; ++i) {
    const double value = mantissa(random) * std::pow(10, exponent(random));
    EXPECT_EQ(ParseNumber(FormatNumber(value)).value, value);
  }
  for (const double value : {DBL_MAX, DBL_MIN, DBL_TRUE_MIN, 1 / 3.0, -0.0}) {
    const double back = ParseNumber(FormatNumber(value)).value;
    EXPECT_EQ(back, value);
    EXPECT_EQ(std::signbit(back), std::signbit(value));
  }
}

TEST(NumberSpec, SaysWhatItExpects) {
  EXPECT_EQ(NumberSpec::Above(0, "m").AtMost(20).Expected(), "a number in (0, 20] [m]");
  EXPECT_EQ(NumberSpec::AtLeast(0, "m").Below(0.5).Expected(), "a number in [0, 0.5) [m]");
  EXPECT_EQ(NumberSpec::Above(0, "N m^2").Expected(), "a positive number [N m^2]");
  EXPECT_EQ(NumberSpec::AtLeast(0, "").Or("'critical'").Expected(), "a number >= 0 or 'critical'");
  EXPECT_EQ(NumberSpec::Above(-1, "").Expected(), "a number > -1");
  EXPECT_EQ(NumberSpec::Any("s").AtMost(3).Expected(), "a number <= 3 [s]");
  EXPECT_EQ(NumberSpec::Any("s").Expected(), "a finite number [s]");
}

TEST(NumberSpec, ContainsItsRange) {
  const NumberSpec open = NumberSpec::Above(0, "").Below(1);
  EXPECT_FALSE(open.Contains(0));
  EXPECT_TRUE(open.Contains(0.5));
  EXPECT_FALSE(open.Contains(1));
  const NumberSpec closed = NumberSpec::AtLeast(0, "").AtMost(1);
  EXPECT_TRUE(closed.Contains(0));
  EXPECT_TRUE(closed.Contains(1));
  EXPECT_FALSE(closed.Contains(std::nextafter(1.0, 2.0)));
  EXPECT_FALSE(NumberSpec::Any("").Contains(std::numeric_limits<double>::infinity()));
  EXPECT_FALSE(NumberSpec::Any("").Contains(std::numeric_limits<double>::quiet_NaN()));
}

TEST(NumberSpec, HintsOnlyAboveItsRange) {
  const NumberSpec spec = NumberSpec::Above(0, "m").AtMost(20).Hint("is it in mm?");
  EXPECT_EQ(spec.HintFor(200), ": is it in mm?");
  EXPECT_EQ(spec.HintFor(-1), "");
}

TEST(FormatNumber, HasNoMoreDigitsThanItNeeds) {
  const std::pair<double, const char*> cases[] = {
      {0, "0"},
      {0.1, "0.1"},
      {-2.5, "-2.5"},
      {1e6, "1e+06"},
      {1234567, "1234567"},
      {1e15, "1e+15"},
      {1e-5, "1e-05"},
      {0.1 + 0.2, "0.30000000000000004"},
      {1.0 / 3, "0.3333333333333333"},
      {4.94066e-324, "4.94066e-324"},
      {1.7976931348623157e308, "1.7976931348623157e+308"}};
  for (const auto& [value, text] : cases) EXPECT_EQ(FormatNumber(value), text);
}

}  // namespace
}  // namespace cosserat_cable
