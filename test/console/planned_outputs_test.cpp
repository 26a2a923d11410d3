#include "cosserat_cable/console/planned_outputs.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace cosserat_cable {
namespace {

namespace fs = std::filesystem;

class PlannedOutputsTest : public ::testing::Test {
 protected:
  PlannedOutputsTest() {
    fs::create_directories(folder_);
    for (const char* name : {"input.bag", "car.urdf", "old.json"}) std::ofstream(Path(name)) << "x";
  }
  ~PlannedOutputsTest() override { fs::remove_all(folder_); }

  std::string Path(const std::string& name) const { return (folder_ / name).string(); }
  std::string Said() const {
    Problems problems;
    outputs_.Check(&problems);
    return problems.ToString();
  }

  const fs::path folder_ =
      fs::temp_directory_path() / ("planned_outputs_" + std::to_string(getpid()));
  PlannedOutputs outputs_;
};

TEST_F(PlannedOutputsTest, AnOlderOutputMayBeReplaced) {
  outputs_.Reads(Path("input.bag"));
  outputs_.WritesFile(Path("old.json"), "json");
  outputs_.WritesFolder(Path("new/result"), "output", {"numbers.json"});
  EXPECT_EQ(Said(), "");
}

TEST_F(PlannedOutputsTest, WhatIsReadIsNeverWritten) {
  outputs_.Reads(Path("input.bag"));
  outputs_.Reads(Path("car.urdf"));
  fs::create_symlink(Path("car.urdf"), Path("link"));
  outputs_.WritesFile(Path("../" + folder_.filename().string() + "/input.bag"), "output");
  outputs_.WritesFile(Path("link"), "json");
  const std::string said = Said();
  EXPECT_NE(said.find("output: '" + Path("input.bag") + "' is read by this run"), std::string::npos)
      << said;
  EXPECT_NE(said.find("json: '" + Path("car.urdf") + "' is read by this run"), std::string::npos)
      << said;
}

TEST_F(PlannedOutputsTest, NorIsItByTheNameUnderWhichAFileIsWritten) {
  std::ofstream(Path("out.bag.active")) << "x";
  outputs_.Reads(Path("out.bag.active"));
  outputs_.WritesFile(Path("out.bag"), "output");
  EXPECT_NE(Said().find("would be lost"), std::string::npos) << Said();
}

TEST_F(PlannedOutputsTest, NorIsAnotherOutputByThatName) {
  outputs_.WritesFile(Path("out.bag"), "output");
  outputs_.WritesFile(Path("out.bag.active"), "json");
  EXPECT_NE(Said().find("json: is what --output writes, too"), std::string::npos) << Said();
}

TEST_F(PlannedOutputsTest, NorIsAHardLinkOrWhatIsKnownLater) {
  fs::create_hard_link(Path("car.urdf"), Path("hard"));
  outputs_.WritesFile(Path("hard"), "json");
  outputs_.WritesFolder(folder_.string(), "output", {"old.json"});
  EXPECT_EQ(Said(), "");
  Problems problems;
  outputs_.CheckReads({Path("car.urdf"), Path("old.json")}, &problems);
  const std::string said = problems.ToString();
  EXPECT_NE(said.find("json: '" + Path("car.urdf") + "' is read by this run"), std::string::npos);
  EXPECT_NE(said.find("output: '" + Path("old.json") + "' is read by this run"), std::string::npos);
  EXPECT_EQ(problems.all().size(), 2u);
}

TEST_F(PlannedOutputsTest, AFilesOfAFolderIsNoInputEither) {
  std::ofstream(Path("identified_cable.yaml")) << "x";
  outputs_.Reads(Path("identified_cable.yaml"));
  outputs_.WritesFolder(folder_.string(), "output", {"identified_cable.yaml"});
  EXPECT_NE(Said().find("would be lost"), std::string::npos) << Said();
}

TEST_F(PlannedOutputsTest, DevicesFoldersAndTwoOfOnePlaceAreTold) {
  outputs_.WritesFile("/dev/null", "output");
  outputs_.WritesFile(folder_.string(), "json");
  outputs_.WritesFile(Path("a.json"), "json");
  outputs_.WritesFile(Path("a.json"), "clamps");
  outputs_.WritesFile(Path("nowhere/a.json"), "json");
  outputs_.WritesFolder(Path("old.json"), "output", {});
  const std::string said = Said();
  for (const char* what :
       {"/dev/null: output: got a device or pipe", "json: got a folder, expected a file",
        "clamps: is what --json writes, too", "does not exist",
        "output: got a file, expected a folder"})
    EXPECT_NE(said.find(what), std::string::npos) << what << "\n" << said;
}

}  // namespace
}  // namespace cosserat_cable
