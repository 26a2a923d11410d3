#include "cosserat_cable/input/problems.h"

#include <gtest/gtest.h>

namespace cosserat_cable {
namespace {

TEST(Problem, LeavesOutWhatIsUnknown) {
  EXPECT_EQ((Problem{"a.yaml", 3, "cables[2].EI", "bad"}).ToString(),
            "a.yaml:3: cables[2].EI: bad");
  EXPECT_EQ((Problem{"a.yaml", 3, "", "bad"}).ToString(), "a.yaml:3: bad");
  EXPECT_EQ((Problem{"a.yaml", 0, "EI", "bad"}).ToString(), "a.yaml: EI: bad");
  EXPECT_EQ((Problem{"a.yaml", 0, "", "bad"}).ToString(), "a.yaml: bad");
  EXPECT_EQ((Problem{"", 0, "--dt", "bad"}).ToString(), "--dt: bad");
  EXPECT_EQ((Problem{"", 0, "", "bad"}).ToString(), "bad");
}

TEST(Problems, KeepTheirOrder) {
  Problems problems;
  EXPECT_TRUE(problems.empty());
  problems.Add("b.yaml", 7, "x", "one");
  problems.Add("a.yaml", "two");
  problems.Add(SourceMark{"b.yaml", 2, "y"}, "three");
  EXPECT_FALSE(problems.empty());
  EXPECT_EQ(problems.ToString(), "b.yaml:7: x: one\na.yaml: two\nb.yaml:2: y: three\n");
}

TEST(Problems, SortByLineWithinTheirFilesAndSayEachOnce) {
  Problems problems;
  problems.Add("b.yaml", 7, "x", "one");
  problems.Add("a.yaml", 5, "", "two");
  problems.Add("b.yaml", 2, "y", "three");
  problems.Add("b.yaml", 7, "x", "one");
  problems.Add("b.yaml", 2, "x", "four");
  problems.SortByLine();
  EXPECT_EQ(problems.ToString(),
            "b.yaml:2: y: three\nb.yaml:2: x: four\nb.yaml:7: x: one\na.yaml:5: two\n");
}

TEST(NearestWord, FindsWhatWasMeant) {
  const std::vector<std::string> keys = {"length", "diameter", "mass_per_length", "EI",
                                         "EI1",    "GJ",       "eta_EI",          "elements"};
  EXPECT_EQ(NearestWord("lenght", keys), "length");                     // swap
  EXPECT_EQ(NearestWord("diametr", keys), "diameter");                  // deletion
  EXPECT_EQ(NearestWord("mass_per_lengths", keys), "mass_per_length");  // insertion
  EXPECT_EQ(NearestWord("mass_per_lenth", keys), "mass_per_length");
  EXPECT_EQ(NearestWord("element", keys), "elements");
  EXPECT_EQ(NearestWord("ei", keys), "EI");  // case
  EXPECT_EQ(NearestWord("ETA_ei", keys), "eta_EI");
  EXPECT_EQ(NearestWord("EI3", keys), "EI");
  EXPECT_EQ(NearestWord("EJ", keys), "EI");
}

TEST(NearestWord, FindsFrames) {
  const std::vector<std::string> links = {"base_link", "fl_wheel", "fr_wheel", "rl_wheel"};
  EXPECT_EQ(NearestWord("fl_whel", links), "fl_wheel");
  EXPECT_EQ(NearestWord("/base_link", links), "base_link");
}

TEST(NearestWord, SaysNothingWhereNothingIsNear) {
  EXPECT_EQ(NearestWord("colour", {"length", "diameter"}), "");
  EXPECT_EQ(NearestWord("x", {"a", "b"}), "");
  EXPECT_EQ(NearestWord("", {"a", "EI"}), "");
  EXPECT_EQ(NearestWord("length", {}), "");
}

}  // namespace
}  // namespace cosserat_cable
