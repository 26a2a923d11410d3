// What an interrupted diagnosis leaves for the next one.
#include "../../src/diagnosis/fit_memory.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace cosserat_cable {
namespace {

namespace fs = std::filesystem;

class FitMemoryTest : public ::testing::Test {
 protected:
  void SetUp() override {
    char name[] = "/tmp/fit_memory_XXXXXX";
    folder_ = mkdtemp(name);
    set_.folder = folder_.string();
    Write("measurement.yaml", "format: 1\n");
    Write("swing.csv", "t,x\n0,1\n");
    set_.experiments.emplace_back();
    set_.experiments.back().record.file = "swing.csv";
  }
  void TearDown() override { fs::remove_all(folder_); }

  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  std::string File() const { return (folder_ / "fits.json").string(); }

  static FitPoint Point(double value) {
    FitPoint point;
    point.ok = point.at_minimum = true;
    Unknown unknown;
    unknown.name = "EI";
    point.unknowns = {unknown};
    point.values = Eigen::VectorXd::Constant(1, value);
    return point;
  }

  fs::path folder_;
  MeasurementSet set_;
};

TEST_F(FitMemoryTest, HasWhatAnotherOneFound) {
  FitMemory(File(), set_).Add("plain", Point(0.25));
  const FitMemory later(File(), set_);
  ASSERT_EQ(later.begun_with(), 1);
  const FitMemory::Fit* fit = later.Find("plain");
  ASSERT_TRUE(fit);
  EXPECT_TRUE(fit->at_minimum);
  EXPECT_EQ(fit->values.at("EI"), 0.25);
  EXPECT_FALSE(later.Find("another"));
}

TEST_F(FitMemoryTest, ForgetsAFileOfOtherRecords) {
  FitMemory(File(), set_).Add("plain", Point(0.25));
  Write("swing.csv", "t,x\n0,2\n");
  EXPECT_EQ(FitMemory(File(), set_).begun_with(), 0);
}

TEST_F(FitMemoryTest, TakesABrokenFileForNone) {
  Write("fits.json", "{\"set\": ");
  EXPECT_EQ(FitMemory(File(), set_).begun_with(), 0);
  // Whole, of this set, but of another form.
  FitMemory(File(), set_).Add("plain", Point(0.25));
  std::ifstream file(File());
  std::string text((std::istreambuf_iterator<char>(file)), {});
  const std::size_t place = text.find("0.25");
  ASSERT_NE(place, std::string::npos);
  Write("fits.json", text.replace(place, 4, "null"));
  EXPECT_EQ(FitMemory(File(), set_).begun_with(), 0);
}

TEST_F(FitMemoryTest, RemembersNothingWithoutAFileOrAfterForgetting) {
  FitMemory none("", set_);
  none.Add("plain", Point(1));
  EXPECT_EQ(none.begun_with(), 0);
  FitMemory memory(File(), set_);
  memory.Add("plain", Point(1));
  memory.Forget();
  EXPECT_FALSE(fs::exists(File()));
}

}  // namespace
}  // namespace cosserat_cable
