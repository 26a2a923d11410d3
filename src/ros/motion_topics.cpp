#include "cosserat_cable/ros/motion_topics.h"

#include <sensor_msgs/JointState.h>
#include <tf2_msgs/TFMessage.h>

#include <set>

#include "cosserat_cable/input/problems.h"
#include "cosserat_cable/ros/conversions.h"

namespace cosserat_cable {
namespace {

const std::string kStatic = "_static";

bool EndsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.npos, end) == 0;
}

std::string Described(const std::string& topic, const TopicContent& content) {
  return "there is " + topic + " (" + content.type + ", " + std::to_string(content.messages) +
         (content.messages == 1 ? " message)" : " messages)");
}

bool IsJointState(const TopicContent& content) {
  return content.md5sum == ros::message_traits::MD5Sum<sensor_msgs::JointState>::value();
}

// Also of tf/tfMessage, which has the same fields.
bool IsTf(const TopicContent& content) {
  return content.md5sum == ros::message_traits::MD5Sum<tf2_msgs::TFMessage>::value();
}

}  // namespace

std::vector<std::string> UnreadMotion(const TopicContents& contents, const MotionTopics& topics) {
  const std::set<std::string> read = {WithoutSlash(topics.joint_states), WithoutSlash(topics.tf),
                                      WithoutSlash(topics.tf_static())};
  std::vector<std::string> sentences;
  for (const auto& [topic, content] : contents) {
    if (read.count(WithoutSlash(topic)) > 0 || content.messages == 0) continue;
    if (IsJointState(content)) {
      sentences.push_back(Described(topic, content) + ": --joint-states " + topic + " reads it");
    } else if (IsTf(content)) {
      const bool is_static = EndsWith(topic, kStatic);
      const std::string base = is_static ? topic.substr(0, topic.size() - kStatic.size()) : topic;
      if (is_static && contents.count(base) > 0) continue;  // said there
      const bool both = !is_static && contents.count(topic + kStatic) > 0;
      sentences.push_back(Described(topic, content) + ": --tf " + base + " reads it" +
                          (both ? ", and " + topic + kStatic : ""));
    }
  }
  return sentences;
}

std::vector<std::string> MotionTopicsBesides(const TopicContents& contents,
                                             const MotionTopics& topics) {
  const std::set<std::string> read = {WithoutSlash(topics.joint_states), WithoutSlash(topics.tf),
                                      WithoutSlash(topics.tf_static())};
  const std::set<std::string> types = {"sensor_msgs/JointState", "tf2_msgs/TFMessage",
                                       "tf/tfMessage"};
  std::vector<std::string> names;
  for (const auto& [topic, content] : contents)
    if (types.count(content.type) > 0 && read.count(WithoutSlash(topic)) == 0)
      names.push_back(topic);
  return names;
}

std::vector<std::string> AbsentTopics(const TopicContents& contents, const MotionTopics& topics) {
  const MotionTopics usual;
  std::set<std::string> there;
  std::vector<std::string> joint_topics, tf_topics;
  for (const auto& [topic, content] : contents) {
    there.insert(WithoutSlash(topic));
    if (IsJointState(content)) joint_topics.push_back(topic);
    if (IsTf(content) && !EndsWith(topic, kStatic)) tf_topics.push_back(topic);
  }
  std::vector<std::string> sentences;
  const auto check = [&](const std::string& name, const std::string& usual_name,
                         const std::string& option, const std::vector<std::string>& candidates) {
    if (name == usual_name || there.count(WithoutSlash(name)) > 0) return;
    const std::string nearest = NearestWord(name, candidates);
    sentences.push_back(option + ": got '" + name + "', expected a topic of the recording" +
                        (nearest.empty() ? "" : ": did you mean '" + nearest + "'?"));
  };
  check(topics.joint_states, usual.joint_states, "joint-states", joint_topics);
  // Static transforms alone may be all that is recorded.
  if (there.count(WithoutSlash(topics.tf_static())) == 0)
    check(topics.tf, usual.tf, "tf", tf_topics);
  return sentences;
}

}  // namespace cosserat_cable
