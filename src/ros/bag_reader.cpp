#include "cosserat_cable/ros/bag_reader.h"

#include <ros/serialization.h>
#include <sys/stat.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <exception>
#include <utility>

#include "bag_file.h"
#include "cosserat_cable/ros/conversions.h"

namespace cosserat_cable {
namespace {

bool IsStatic(const std::string& topic) { return WithoutSlash(topic) == "tf_static"; }

bool IsMotion(const std::string& topic) {
  const std::string name = WithoutSlash(topic);
  return name == "tf" || name == "tf_static" || name == "joint_states";
}

void CheckTypes(const std::string& path, const BagFile& bag, Problems* problems) {
  for (const BagConnection& connection : bag.connections()) {
    const bool joints = WithoutSlash(connection.topic) == "joint_states";
    const std::string expected = joints
                                     ? ros::message_traits::MD5Sum<sensor_msgs::JointState>::value()
                                     : ros::message_traits::MD5Sum<tf2_msgs::TFMessage>::value();
    if (connection.Field("md5sum") != expected) {
      problems->Add(path, 0, connection.topic,
                    "got messages of type " + connection.Field("type") + ", expected " +
                        (joints ? "sensor_msgs/JointState" : "tf2_msgs/TFMessage"));
    }
  }
}

// Their types were checked when the bags were opened.
template <typename T>
boost::shared_ptr<T> Deserialized(std::vector<std::uint8_t>* bytes) {
  auto message = boost::make_shared<T>();
  ros::serialization::IStream stream(bytes->data(), static_cast<std::uint32_t>(bytes->size()));
  try {
    ros::serialization::deserialize(stream, *message);
  } catch (const ros::serialization::StreamOverrunException&) {
    throw BagFormatError("a message ends too early");
  }
  return message;
}

}  // namespace

const std::string& BagMessage::publisher() const {
  static const std::string kUnknown;
  if (!connection) return kUnknown;
  const auto found = connection->find("callerid");
  return found == connection->end() ? kUnknown : found->second;
}

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
      auto bag = std::make_unique<BagFile>(path, IsMotion);
      CheckTypes(path, *bag, problems);
      bags_.push_back(std::move(bag));
    } catch (const BagUnindexedError&) {
      problems->Add(path, "the bag has no index: run `rosbag reindex " + path + "`");
    } catch (const BagFormatError& error) {
      problems->Add(path, std::string("no bag, or a truncated one (") + error.what() +
                              "); `rosbag reindex " + path + "` may recover what is there");
    }
  }
  for (const auto& bag : bags_) {
    if (bag->entries().empty()) continue;
    const std::int64_t begin = bag->entries().front().time;
    begin_ = begin_ == 0 ? begin : std::min(begin_, begin);
    end_ = std::max(end_, bag->entries().back().time);
    for (const BagConnection& connection : bag->connections()) counts_[connection.topic];
    for (const BagFile::Entry& entry : bag->entries())
      ++counts_[bag->connections()[entry.connection].topic];
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
  // Each bag's next message.
  std::vector<std::size_t> next(bags_.size(), 0);
  for (;;) {
    BagFile* earliest = nullptr;
    std::size_t* taken = nullptr;
    for (std::size_t i = 0; i < bags_.size(); ++i) {
      const auto& entries = bags_[i]->entries();
      if (next[i] == entries.size()) continue;
      if (earliest && earliest->entries()[*taken].time <= entries[next[i]].time) continue;
      earliest = bags_[i].get();
      taken = &next[i];
    }
    if (!earliest) return;
    const BagFile::Entry& entry = earliest->entries()[(*taken)++];
    const BagConnection& connection = earliest->connections()[entry.connection];
    const bool is_static = IsStatic(connection.topic);
    if (entry.time > to || (entry.time < from && !is_static)) continue;
    BagMessage message;
    message.time = entry.time;
    message.topic = connection.topic;
    message.connection = connection.header;
    message.is_static = is_static;
    message.bytes = earliest->Read(entry);
    if (WithoutSlash(message.topic) == "joint_states") {
      message.joints = Deserialized<sensor_msgs::JointState>(&message.bytes);
    } else {
      message.tf = Deserialized<tf2_msgs::TFMessage>(&message.bytes);
    }
    if (!visit(std::move(message))) return;
  }
}

}  // namespace cosserat_cable
