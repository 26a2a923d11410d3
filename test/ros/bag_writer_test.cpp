#include "cosserat_cable/ros/bag_writer.h"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <std_msgs/Float64.h>
#include <std_msgs/String.h>

#include <filesystem>

namespace cosserat_cable {
namespace {

std::string TemporaryPath(const char* name) {
  return (std::filesystem::path(testing::TempDir()) / name).string();
}

ros::Time At(int i) { return ros::Time(1000 + i / 100, i % 100 * 10'000'000); }

std_msgs::String Text(int i) {
  std_msgs::String message;
  message.data = std::to_string(i) + std::string(10'000, static_cast<char>('a' + i % 26));
  return message;
}

std_msgs::Float64 Number(int i) {
  std_msgs::Float64 message;
  message.data = 0.1 * i;
  return message;
}

TEST(BagWriterTest, RosbagReadsWhatIsWritten) {
  const std::string path = TemporaryPath("bag_writer_test.bag");
  std::filesystem::remove(path);
  constexpr int kMessages = 300;  // of 10 kB: several chunks
  {
    BagWriter writer(path);
    const BagWriter::Connection texts = writer.Connect<std_msgs::String>("/texts");
    for (int i = 0; i < kMessages; ++i) {
      writer.Write(texts, At(i), Text(i));
      // A connection that begins in a later chunk.
      if (i + 1 < kMessages) continue;
      const BagWriter::Connection numbers = writer.Connect<std_msgs::Float64>("/numbers");
      // Not in the order of time.
      for (const int k : {7, 3, 5}) writer.Write(numbers, At(k), Number(k));
    }
    EXPECT_FALSE(std::filesystem::exists(path));
    writer.Close();
  }
  const rosbag::Bag bag(path);
  int i = 0;
  for (const rosbag::MessageInstance& instance :
       rosbag::View(bag, rosbag::TopicQuery(std::vector<std::string>{"/texts"}))) {
    EXPECT_EQ(instance.getTime(), At(i));
    const auto message = instance.instantiate<std_msgs::String>();
    ASSERT_TRUE(message);
    ASSERT_EQ(message->data, Text(i).data);
    ++i;
  }
  EXPECT_EQ(i, kMessages);
  std::vector<double> numbers;
  for (const rosbag::MessageInstance& instance :
       rosbag::View(bag, rosbag::TopicQuery(std::vector<std::string>{"/numbers"})))
    numbers.push_back(instance.instantiate<std_msgs::Float64>()->data);
  EXPECT_EQ(numbers, (std::vector<double>{Number(3).data, Number(5).data, Number(7).data}));
}

TEST(BagWriterTest, CopiesKeepTheirConnection) {
  const std::string path = TemporaryPath("bag_writer_copy_test.bag");
  ros::M_string header = {{"topic", "/copied"},
                          {"type", "std_msgs/Float64"},
                          {"md5sum", ros::message_traits::MD5Sum<std_msgs::Float64>::value()},
                          {"message_definition", "float64 data\n"},
                          {"callerid", "/somebody"}};
  const double value = 42.5;
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(&value);
  {
    BagWriter writer(path);
    writer.Write(writer.Connect("/copied", header), At(1), {bytes, bytes + sizeof value});
  }  // closes
  const rosbag::Bag bag(path);
  rosbag::View view(bag);
  ASSERT_EQ(view.size(), 1u);
  EXPECT_EQ(view.begin()->getCallerId(), "/somebody");
  EXPECT_EQ(view.begin()->instantiate<std_msgs::Float64>()->data, value);
}

TEST(BagWriterTest, WithoutMessagesTheBagIsValid) {
  const std::string path = TemporaryPath("bag_writer_empty_test.bag");
  BagWriter(path).Close();
  EXPECT_EQ(rosbag::View(rosbag::Bag(path)).size(), 0u);
}

TEST(BagWriterTest, SaysWhichFileCannotBeMade) {
  try {
    BagWriter writer("/nowhere/at/all.bag");
    FAIL();
  } catch (const BagWriteError& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/at/all.bag"), std::string::npos);
  }
}

}  // namespace
}  // namespace cosserat_cable
