#include "cosserat_cable/ros/bag_reader.h"

#include <ros/serialization.h>
#include <sys/stat.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <exception>
#include <utility>

#include "bag_file.h"
#include "bag_message_sizes.h"
#include "cosserat_cable/ros/conversions.h"

namespace cosserat_cable {
namespace {

bool IsSame(const std::string& topic, const std::string& other) {
  return WithoutSlash(topic) == WithoutSlash(other);
}

bool IsMotion(const std::string& topic, const MotionTopics& topics) {
  return IsSame(topic, topics.tf) || IsSame(topic, topics.tf_static()) ||
         IsSame(topic, topics.joint_states);
}

void CheckTypes(const std::string& path, const BagFile& bag, const MotionTopics& topics,
                Problems* problems) {
  for (const BagConnection& connection : bag.connections()) {
    const bool joints = IsSame(connection.topic, topics.joint_states);
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
  // Else the claimed size of a list would be allocated before it is read.
  if (!HoldsWhole<T>(*bytes)) throw BagFormatError("a message ends too early");
  ros::serialization::IStream stream(bytes->data(), static_cast<std::uint32_t>(bytes->size()));
  try {
    ros::serialization::deserialize(stream, *message);
  } catch (const ros::serialization::StreamOverrunException&) {
    throw BagFormatError("a message ends too early");
  }
  return message;
}

template <typename T>
void Serialize(const T& message, std::vector<std::uint8_t>* bytes) {
  bytes->resize(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(bytes->data(), static_cast<std::uint32_t>(bytes->size()));
  ros::serialization::serialize(stream, message);
}

// A bag that is made of this one is then as good as one that was stamped.
void StampWithRecordTime(BagMessage* message) {
  const ros::Time time = ToRosTime(message->time);
  if (message->joints) {
    message->joints->header.stamp = time;
    Serialize(*message->joints, &message->bytes);
  } else {
    for (auto& transform : message->tf->transforms) transform.header.stamp = time;
    Serialize(*message->tf, &message->bytes);
  }
}

void CheckTopics(const std::vector<std::string>& paths, const TopicContents& contents,
                 const MotionTopics& topics, Problems* problems) {
  const std::vector<std::string> absent = AbsentTopics(contents, topics);
  std::string all;
  for (const std::string& path : paths) all += (all.empty() ? "" : ", ") + path;
  for (const std::string& sentence : absent) problems->Add(all, sentence);
  if (absent.empty() && problems->empty()) return;
  for (const std::string& sentence : UnreadMotion(contents, topics)) problems->Add(all, sentence);
}

}  // namespace

const std::string& BagMessage::publisher() const {
  static const std::string kUnknown;
  if (!connection) return kUnknown;
  const auto found = connection->find("callerid");
  return found == connection->end() ? kUnknown : found->second;
}

BagReader::BagReader(const std::vector<std::string>& paths, Problems* problems, MotionTopics topics)
    : topics_(std::move(topics)) {
  Problems types;
  const auto is_motion = [this](const std::string& topic) { return IsMotion(topic, topics_); };
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
      auto bag = std::make_unique<BagFile>(path, is_motion);
      CheckTypes(path, *bag, topics_, &types);
      for (const auto& [topic, content] : bag->contents()) {
        const std::uint64_t before = contents_[topic].messages;
        contents_[topic] = content;
        contents_[topic].messages += before;
      }
      bags_.push_back(std::move(bag));
    } catch (const BagUnindexedError&) {
      problems->Add(path, "the bag has no index: run `rosbag reindex " + path + "`");
    } catch (const BagFormatError& error) {
      problems->Add(path, std::string("no bag, or a truncated one (") + error.what() +
                              "); `rosbag reindex " + path + "` may recover what is there");
    }
  }
  if (!bags_.empty()) CheckTopics(paths, contents_, topics_, &types);
  problems->Append(types);
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
    const bool is_static = IsSame(connection.topic, topics_.tf_static());
    if (entry.time > to || (entry.time < from && !is_static)) continue;
    BagMessage message;
    message.time = entry.time;
    message.topic = connection.topic;
    message.connection = connection.header;
    message.is_static = is_static;
    message.bytes = earliest->Read(entry);
    if (IsSame(message.topic, topics_.joint_states)) {
      message.joints = Deserialized<sensor_msgs::JointState>(&message.bytes);
    } else {
      message.tf = Deserialized<tf2_msgs::TFMessage>(&message.bytes);
    }
    if (topics_.use_record_times) StampWithRecordTime(&message);
    if (!visit(std::move(message))) return;
  }
}

}  // namespace cosserat_cable
