// Where the motion is recorded or published: names of topics, and what serves as time.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace cosserat_cable {

struct MotionTopics {
  std::string joint_states = "/joint_states";
  std::string tf = "/tf";         ///< static transforms: the same name with "_static" behind it
  bool use_record_times = false;  ///< of all messages, instead of their stamps

  std::string tf_static() const { return tf + "_static"; }
};

/// A topic of a recording.
struct TopicContent {
  std::string type;    ///< sensor_msgs/JointState
  std::string md5sum;  ///< of the type
  std::uint64_t messages = 0;
};
using TopicContents = std::map<std::string, TopicContent>;

/// A sentence for each topic that holds motion and is not read, with the option that reads it.
std::vector<std::string> UnreadMotion(const TopicContents& contents, const MotionTopics& topics);

/// Topics whose type is one of motion and that are not read. Only the types' names count.
std::vector<std::string> MotionTopicsBesides(const TopicContents& contents,
                                             const MotionTopics& topics);

/// A sentence for each topic that was asked for by another than its usual name and is not there,
/// with the nearest name.
std::vector<std::string> AbsentTopics(const TopicContents& contents, const MotionTopics& topics);

}  // namespace cosserat_cable
