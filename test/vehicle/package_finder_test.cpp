#include "cosserat_cable/vehicle/package_finder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace cosserat_cable {
namespace {

namespace fs = std::filesystem;

class PackageFinderTest : public testing::Test {
 protected:
  PackageFinderTest() {
    std::string pattern = "/tmp/cosserat_cable_test_XXXXXX";
    folder_ = mkdtemp(&pattern[0]);
    if (const char* path = std::getenv("ROS_PACKAGE_PATH")) path_before_ = path;
    setenv("ROS_PACKAGE_PATH", "", 1);
  }
  ~PackageFinderTest() override {
    setenv("ROS_PACKAGE_PATH", path_before_.c_str(), 1);
    fs::remove_all(folder_);
  }

  std::string MakePackage(const std::string& path, const std::string& name) const {
    const fs::path package = folder_ / path;
    fs::create_directories(package);
    std::ofstream(package / "package.xml")
        << "<?xml version=\"1.0\"?>\n<package format=\"3\">\n  <name>" << name
        << "</name>\n</package>\n";
    return package.string();
  }
  std::string At(const std::string& path) const { return (folder_ / path).string(); }
  void SetPath(const std::string& path) const { setenv("ROS_PACKAGE_PATH", path.c_str(), 1); }

 private:
  fs::path folder_;
  std::string path_before_;
};

TEST_F(PackageFinderTest, LooksUpwards) {
  const std::string car = MakePackage("ws/car", "car");
  fs::create_directories(At("ws/car/urdf/deep"));
  EXPECT_EQ(FindPackagesFrom(At("ws/car/urdf/deep"))("car"), car);
  EXPECT_EQ(FindPackagesFrom(car)("car"), car);
  EXPECT_EQ(FindPackagesFrom(car)("truck"), "");
  EXPECT_EQ(FindPackagesFrom(At("ws"))("car"), "");
}

TEST_F(PackageFinderTest, LooksInThePath) {
  const std::string direct = MakePackage("a/direct", "direct");
  const std::string one = MakePackage("b/one", "one");
  const std::string two = MakePackage("b/group/folder_named_otherwise", "two");
  MakePackage("b/group/group/three", "three");
  MakePackage("b/one/nested", "nested");
  SetPath(At("nowhere") + ":" + direct + "::" + At("b"));
  const PackageFinder find = FindPackagesFrom(At(""));
  EXPECT_EQ(find("direct"), direct);
  EXPECT_EQ(find("one"), one);
  EXPECT_EQ(find("two"), two);
  EXPECT_EQ(find("three"), "") << "three levels down";
  EXPECT_EQ(find("nested"), "") << "packages do not nest";
}

TEST_F(PackageFinderTest, TheNameCountsNotTheFolder) {
  MakePackage("b/car", "truck");
  SetPath(At("b"));
  EXPECT_EQ(FindPackagesFrom(At(""))("car"), "");
  std::ofstream(At("b/car/package.xml")) << "<package><name>";  // cut off
  EXPECT_EQ(FindPackagesFrom(At(""))("truck"), "");
}

}  // namespace
}  // namespace cosserat_cable
