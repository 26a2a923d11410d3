#include "cosserat_cable/ros/bag_reader.h"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <std_msgs/String.h>

#include <filesystem>

namespace cosserat_cable {
namespace {

std::string TemporaryPath(const std::string& name) {
  return (std::filesystem::path(testing::TempDir()) / name).string();
}

tf2_msgs::TFMessage Transform(double x) {
  tf2_msgs::TFMessage message;
  message.transforms.resize(1);
  message.transforms[0].header.frame_id = "odom";
  message.transforms[0].child_frame_id = "base";
  message.transforms[0].transform.translation.x = x;
  return message;
}

sensor_msgs::JointState Joints(double position) {
  sensor_msgs::JointState message;
  message.name = {"travel"};
  message.position = {position};
  return message;
}

class BagReaderCompression : public testing::TestWithParam<rosbag::compression::CompressionType> {};

TEST_P(BagReaderCompression, ReadsWhatRosbagWroteInTheOrderOfTime) {
  const std::string path = TemporaryPath("bag_reader_test.bag");
  const std::string other_path = TemporaryPath("bag_reader_other_test.bag");
  constexpr int kMessages = 500;
  {
    rosbag::Bag bag(path, rosbag::bagmode::Write), other(other_path, rosbag::bagmode::Write);
    bag.setCompression(GetParam());
    bag.setChunkThreshold(4000);  // many chunks
    bag.write("/tf_static", ros::Time(1), Transform(-1));
    std_msgs::String noise;
    for (int i = 0; i < kMessages; ++i) {
      // Recorded out of the order of time, in another order in each pair.
      bag.write("/tf", ros::Time(100 + (i ^ 1)), Transform(i ^ 1));
      other.write("/joint_states", ros::Time(100 + i, 1), Joints(i));
      bag.write("/noise", ros::Time(100 + i), noise);
    }
  }
  Problems problems;
  const BagReader reader({path, other_path}, &problems);
  EXPECT_TRUE(problems.empty()) << problems.ToString();
  EXPECT_EQ(reader.begin_time(), 1'000'000'000);
  EXPECT_EQ(reader.count(), 2u * kMessages + 1);
  EXPECT_EQ(reader.counts().at("/joint_states"), static_cast<unsigned>(kMessages));
  EXPECT_EQ(reader.counts().count("/noise"), 0u);

  constexpr std::int64_t kSecond = 1'000'000'000;
  constexpr int kFirst = 100, kLast = 300;  // messages, both of them included
  std::int64_t before = 0;
  std::vector<double> transforms, joints;
  reader.ForEach((100 + kFirst) * kSecond, (100 + kLast) * kSecond + 1, [&](BagMessage message) {
    EXPECT_GE(message.time, before);
    before = message.time;
    EXPECT_EQ(message.is_static, message.topic == "/tf_static");
    EXPECT_EQ(message.connection->at("type"),
              message.joints ? "sensor_msgs/JointState" : "tf2_msgs/TFMessage");
    if (message.tf) transforms.push_back(message.tf->transforms[0].transform.translation.x);
    if (message.joints) joints.push_back(message.joints->position[0]);
    return true;
  });
  std::vector<double> expected;
  for (int i = kFirst; i <= kLast; ++i) expected.push_back(i);
  EXPECT_EQ(joints, expected);
  expected.insert(expected.begin(), -1);  // the static one is from before
  EXPECT_EQ(transforms, expected);
}

INSTANTIATE_TEST_SUITE_P(Rosbag, BagReaderCompression,
                         testing::Values(rosbag::compression::Uncompressed,
                                         rosbag::compression::BZ2, rosbag::compression::LZ4));

TEST(BagReaderTest, SaysWhatIsNoBag) {
  const std::string path = TemporaryPath("bag_reader_empty_test.bag");
  fclose(fopen(path.c_str(), "w"));
  Problems problems;
  const BagReader reader({path, TemporaryPath("nowhere.bag")}, &problems);
  EXPECT_EQ(problems.all().size(), 2u);
  EXPECT_NE(problems.ToString().find("no bag"), std::string::npos);
}

}  // namespace
}  // namespace cosserat_cable
