// The motion in one or more bags, in the order of time: /tf, /tf_static and /joint_states, or
// topics of other names.
#pragma once

#include <sensor_msgs/JointState.h>
#include <tf2_msgs/TFMessage.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "cosserat_cable/input/problems.h"
#include "cosserat_cable/ros/motion_topics.h"

namespace cosserat_cable {

/// One message; exactly one of `tf` and `joints` is there.
struct BagMessage {
  std::int64_t time = 0;  ///< of recording [ns]
  std::string topic;
  boost::shared_ptr<ros::M_string> connection;  ///< as recorded, to be copied; so are the bytes
  std::vector<std::uint8_t> bytes;
  boost::shared_ptr<tf2_msgs::TFMessage> tf;
  bool is_static = false;
  boost::shared_ptr<sensor_msgs::JointState> joints;

  /// The node that published it; "" where the recording does not say.
  const std::string& publisher() const;
};

class BagFile;

class BagReader {
 public:
  /// Opens the bags. Each that is missing, unindexed, truncated, or no bag, is a problem; so are a
  /// topic of another type, and one of `topics` that is in none of them.
  BagReader(const std::vector<std::string>& paths, Problems* problems, MotionTopics topics = {});
  ~BagReader();

  /// Of the motion's messages over all bags [ns]; both 0 where there are none.
  std::int64_t begin_time() const { return begin_; }
  std::int64_t end_time() const { return end_; }
  /// Of all topics of the bags.
  const TopicContents& contents() const { return contents_; }
  const MotionTopics& topics() const { return topics_; }
  /// Motion messages by topic.
  const std::map<std::string, std::uint64_t>& counts() const { return counts_; }
  std::uint64_t count() const;

  /// Calls `visit` with each message recorded from `from` to `to` [ns]; earlier messages of
  /// /tf_static come first. With use_record_times the messages are stamped with them, and so are
  /// their bytes. Stops where it returns false. Throws BagFormatError, a
  /// std::runtime_error, where a bag turns out to be damaged.
  void ForEach(std::int64_t from, std::int64_t to,
               const std::function<bool(BagMessage)>& visit) const;

 private:
  MotionTopics topics_;
  TopicContents contents_;
  std::vector<std::unique_ptr<BagFile>> bags_;
  std::map<std::string, std::uint64_t> counts_;
  std::int64_t begin_ = 0, end_ = 0;
};

}  // namespace cosserat_cable
