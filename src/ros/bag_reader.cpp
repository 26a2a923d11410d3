#include "cosserat_cable/ros/bag_reader.h"

#include <ros/serialization.h>
#include <rosbag/view.h>
#include <sys/stat.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <exception>
#include <utility>

#include "cosserat_cable/ros/conversions.h"

namespace cosserat_cable {
namespace {

bool IsStatic(const std::string& topic) { return WithoutSlash(topic) == "tf_static"; }

bool IsMotion(const std::string& topic) {
  const std::string name = WithoutSlash(topic);
  return name == "tf" || name == "tf_static" || name == "joint_states";
}

bool IsMoving(const rosbag::ConnectionInfo* connection) {
  return IsMotion(connection->topic) && !IsStatic(connection->topic);
}

bool IsStaticConnection(const rosbag::ConnectionInfo* connection) {
  return IsStatic(connection->topic);
}

bool IsMotionConnection(const rosbag::ConnectionInfo* connection) {
  return IsMotion(connection->topic);
}

void CheckTypes(const std::string& path, const rosbag::Bag& bag, Problems* problems) {
  rosbag::View view(bag, IsMotionConnection);
  for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
    const bool joints = WithoutSlash(connection->topic) == "joint_states";
    const std::string expected = joints
                                     ? ros::message_traits::MD5Sum<sensor_msgs::JointState>::value()
                                     : ros::message_traits::MD5Sum<tf2_msgs::TFMessage>::value();
    if (connection->md5sum != expected) {
      problems->Add(path, 0, connection->topic,
                    "got messages of type " + connection->datatype + ", expected " +
                        (joints ? "sensor_msgs/JointState" : "tf2_msgs/TFMessage"));
    }
  }
}

// Their types were checked when the bags were opened.
template <typename T>
boost::shared_ptr<T> Deserialized(std::vector<std::uint8_t>* bytes) {
  auto message = boost::make_shared<T>();
  ros::serialization::IStream stream(bytes->data(), static_cast<std::uint32_t>(bytes->size()));
  ros::serialization::deserialize(stream, *message);
  return message;
}

}  // namespace

BagReader::BagReader(const std::vector<std::string>& paths, Problems* problems) {
  for (const std::string& path : paths) {
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) {
      problems->Add(path, "no such bag");
      continue;
    }
    if (!S_ISREG(status.st_mode)) {
      problems->Add(path, "not a file");
      continue;
    }
    try {
      auto bag = std::make_unique<rosbag::Bag>(path);
      CheckTypes(path, *bag, problems);
      bags_.push_back(std::move(bag));
    } catch (const rosbag::BagUnindexedException&) {
      problems->Add(path, "the bag has no index: run `rosbag reindex " + path + "`");
    } catch (const std::exception& error) {
      problems->Add(path, std::string("no bag, or a truncated one (") + error.what() +
                              "); `rosbag reindex " + path + "` may recover what is there");
    }
  }
  for (const auto& bag : bags_) {
    rosbag::View view(*bag, IsMotionConnection);
    if (view.size() == 0) continue;
    const std::int64_t begin = ToNanoseconds(view.getBeginTime());
    const std::int64_t end = ToNanoseconds(view.getEndTime());
    begin_ = begin_ == 0 ? begin : std::min(begin_, begin);
    end_ = std::max(end_, end);
    for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
      const std::string topic = connection->topic;
      if (counts_.count(topic) > 0) continue;
      counts_[topic] = 0;
    }
  }
  for (auto& [topic, count] : counts_) {
    for (const auto& bag : bags_) {
      const std::string& name = topic;
      count += rosbag::View(*bag, [&name](const rosbag::ConnectionInfo* connection) {
                 return connection->topic == name;
               }).size();
    }
  }
}

BagReader::~BagReader() = default;

std::uint64_t BagReader::count() const {
  std::uint64_t sum = 0;
  for (const auto& [topic, count] : counts_) sum += count;
  return sum;
}

void BagReader::ForEach(std::int64_t from, std::int64_t to,
                        const std::function<bool(BagMessage)>& visit) const {
  rosbag::View view;
  const ros::Time first = ToRosTime(std::max(from, begin_));
  const ros::Time last = ToRosTime(std::min(to, end_));
  for (const auto& bag : bags_) {
    view.addQuery(*bag, IsMoving, first, last);
    view.addQuery(*bag, IsStaticConnection, ros::TIME_MIN, last);
  }
  for (const rosbag::MessageInstance& instance : view) {
    BagMessage message;
    message.time = ToNanoseconds(instance.getTime());
    message.topic = instance.getTopic();
    message.connection = instance.getConnectionHeader();
    message.is_static = IsStatic(message.topic);
    message.bytes.resize(instance.size());
    ros::serialization::OStream copy(message.bytes.data(), instance.size());
    instance.write(copy);
    if (WithoutSlash(message.topic) == "joint_states") {
      message.joints = Deserialized<sensor_msgs::JointState>(&message.bytes);
    } else {
      message.tf = Deserialized<tf2_msgs::TFMessage>(&message.bytes);
    }
    if (!visit(std::move(message))) return;
  }
}

}  // namespace cosserat_cable
