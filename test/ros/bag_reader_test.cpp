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

TEST(BagReader, ReadsTopicsOfOtherNames) {
  const std::string path = TemporaryPath("bag_reader_topics_test.bag");
  {
    rosbag::Bag bag(path, rosbag::bagmode::Write);
    for (int i = 0; i < 5; ++i) {
      bag.write("/rover1/joint_states", ros::Time(100 + i), Joints(i));
      bag.write("/rover1/tf", ros::Time(100 + i), Transform(i));
      bag.write("/rover2/joint_states", ros::Time(100 + i), Joints(-i));
    }
    bag.write("/rover1/tf_static", ros::Time(100), Transform(7));
  }
  Problems problems;
  const BagReader plain({path}, &problems);
  EXPECT_EQ(plain.count(), 0u);
  const std::vector<std::string> unread = UnreadMotion(plain.contents(), plain.topics());
  ASSERT_EQ(unread.size(), 3u);
  EXPECT_EQ(unread[0],
            "there is /rover1/joint_states (sensor_msgs/JointState, 5 messages): --joint-states "
            "/rover1/joint_states reads it");
  EXPECT_NE(unread[1].find("--tf /rover1/tf reads it, and /rover1/tf_static"), std::string::npos);

  MotionTopics topics;
  topics.joint_states = "/rover1/joint_states";
  topics.tf = "/rover1/tf";
  const BagReader reader({path}, &problems, topics);
  EXPECT_EQ(reader.count(), 11u);
  int statics = 0;
  reader.ForEach(reader.begin_time(), reader.end_time(), [&](const BagMessage& message) {
    if (message.joints) {
      EXPECT_GE(message.joints->position[0], 0);
    }
    statics += message.is_static ? 1 : 0;
    return true;
  });
  EXPECT_EQ(statics, 1);
  EXPECT_TRUE(problems.empty()) << problems.ToString();

  topics.joint_states = "/rover1/joint_state";
  const BagReader misspelt({path}, &problems, topics);
  EXPECT_NE(problems.ToString().find("did you mean '/rover1/joint_states'?"), std::string::npos)
      << problems.ToString();
}

TEST(BagReader, StampsWithRecordTimesOnRequest) {
  const std::string path = TemporaryPath("bag_reader_times_test.bag");
  {
    rosbag::Bag bag(path, rosbag::bagmode::Write);
    sensor_msgs::JointState stamped = Joints(1);
    stamped.header.stamp = ros::Time(5);
    bag.write("/joint_states", ros::Time(100), Joints(0));  // no stamp
    bag.write("/joint_states", ros::Time(101), stamped);    // of another clock
    bag.write("/tf", ros::Time(102), Transform(2));
  }
  MotionTopics topics;
  topics.use_record_times = true;
  Problems problems;
  const BagReader reader({path}, &problems, topics);
  std::vector<std::uint32_t> stamps;
  reader.ForEach(reader.begin_time(), reader.end_time(), [&](BagMessage message) {
    if (message.tf) {
      stamps.push_back(message.tf->transforms[0].header.stamp.sec);
      return true;
    }
    stamps.push_back(message.joints->header.stamp.sec);
    // The copy says the same.
    sensor_msgs::JointState copy;
    ros::serialization::IStream stream(message.bytes.data(),
                                       static_cast<std::uint32_t>(message.bytes.size()));
    ros::serialization::deserialize(stream, copy);
    EXPECT_EQ(copy.header.stamp, message.joints->header.stamp);
    EXPECT_EQ(copy.position, message.joints->position);
    return true;
  });
  EXPECT_EQ(stamps, (std::vector<std::uint32_t>{100, 101, 102}));
}

}  // namespace
}  // namespace cosserat_cable
