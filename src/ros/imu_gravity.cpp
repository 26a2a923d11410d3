#include "imu_gravity.h"

#include <ros/serialization.h>
#include <sensor_msgs/Imu.h>

#include <algorithm>
#include <map>

#include "bag_file.h"
#include "cosserat_cable/input/gravity.h"
#include "cosserat_cable/ros/conversions.h"

namespace cosserat_cable {
namespace {

// Long enough for braking and rough ground to cancel, short enough to be read at once.
constexpr std::int64_t kSpan = 60'000'000'000;  // [ns]
// More say no more.
constexpr std::size_t kMostSamples = 3000;
// A mean of fewer is a moment.
constexpr std::size_t kFewestSamples = 10;

struct Felt {
  std::int64_t time;  // [ns]
  Eigen::Vector3d acceleration;
};

/// What one sensor felt, in its own axes.
struct Sensor {
  std::string frame;
  std::vector<Felt> samples;
};

std::map<std::string, Sensor> ReadSensors(const std::string& path, const BagReader& bags,
                                          const BagSurvey& survey) {
  const std::string md5sum = ros::message_traits::MD5Sum<sensor_msgs::Imu>::value();
  BagFile bag(path, [&](const std::string& topic) {
    const auto content = bags.contents().find(topic);
    return content != bags.contents().end() && content->second.md5sum == md5sum;
  });
  std::map<std::string, Sensor> sensors;
  std::vector<BagFile::Entry> entries;
  for (const BagFile::Entry& entry : bag.entries())
    if (entry.time >= survey.from && entry.time <= std::min(survey.to, survey.from + kSpan))
      entries.push_back(entry);
  const std::size_t stride = entries.size() / kMostSamples + 1;
  for (std::size_t i = 0; i < entries.size(); i += stride) {
    std::vector<std::uint8_t> bytes = bag.Read(entries[i]);
    sensor_msgs::Imu message;
    ros::serialization::IStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
    try {
      ros::serialization::deserialize(stream, message);
    } catch (const ros::serialization::StreamOverrunException&) {
      continue;
    }
    const auto& a = message.linear_acceleration;
    // As sensor_msgs/Imu says it: no such measurement.
    if (message.linear_acceleration_covariance[0] == -1) continue;
    Sensor& sensor = sensors[bag.connections()[entries[i].connection].topic];
    sensor.frame = message.header.frame_id;
    const std::int64_t stamp = ToNanoseconds(message.header.stamp);
    const bool by_record = bags.topics().use_record_times || stamp <= 0;
    sensor.samples.push_back({by_record ? entries[i].time : stamp, Eigen::Vector3d(a.x, a.y, a.z)});
  }
  return sensors;
}

/// The mean in the world, over the samples at whose times the frame's pose is known.
Eigen::Vector3d MeanInWorld(const Sensor& sensor, const std::string& frame, const BagReader& bags,
                            const VehicleModel& vehicle, const BagSurvey& survey,
                            const EngineOptions& options, std::size_t* count) {
  *count = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  LinkMotionOptions link_options = options.links;
  link_options.judge = false;
  link_options.world_frame = survey.world;
  link_options.constants = survey.constants;
  LinkMotion links(vehicle, {frame}, link_options);
  bags.ForEach(survey.from, std::min(survey.to, survey.from + kSpan), [&](const BagMessage& m) {
    if (m.tf) links.Ingest(*m.tf, m.is_static);
    if (m.joints) links.Ingest(*m.joints);
    return true;
  });
  links.Finish();
  std::int64_t begin = 0, ready = 0;
  const bool is_world = frame == survey.world;
  if (!is_world && (!links.Missing().empty() || !links.Range(&begin, &ready))) return sum;
  for (const Felt& felt : sensor.samples) {
    // Where the frame is fixed in the world every time will do.
    if (!is_world && (felt.time < begin || felt.time > ready)) continue;
    const Eigen::Vector3d a_W = links.Evaluate(frame, felt.time).X.q * felt.acceleration;
    if (!a_W.allFinite()) continue;
    sum += a_W;
    ++*count;
  }
  return *count > 0 ? Eigen::Vector3d(sum / static_cast<double>(*count)) : sum;
}

}  // namespace

std::vector<std::string> ImuGravityHints(const std::vector<std::string>& paths,
                                         const BagReader& bags, const VehicleModel& vehicle,
                                         const BagSurvey& survey, const EngineOptions& options) {
  std::vector<std::string> hints;
  const std::string md5sum = ros::message_traits::MD5Sum<sensor_msgs::Imu>::value();
  if (std::none_of(bags.contents().begin(), bags.contents().end(),
                   [&](const auto& content) { return content.second.md5sum == md5sum; })) {
    return hints;
  }
  const std::string prefix = WholePrefix(options.links.tf_prefix);
  for (const std::string& path : paths) {
    for (const auto& [topic, sensor] : ReadSensors(path, bags, survey)) {
      std::string frame = WithoutSlash(sensor.frame);
      if (!prefix.empty() && frame.compare(0, prefix.size(), prefix) == 0)
        frame = frame.substr(prefix.size());
      if (sensor.samples.size() < kFewestSamples) continue;
      const auto cannot = [&](const std::string& why) {
        hints.push_back("gravity cannot be held against " + topic + ": " + why);
      };
      if (frame.empty()) {
        cannot("its messages name no frame");
        continue;
      }
      std::size_t count = 0;
      const Eigen::Vector3d felt =
          MeanInWorld(sensor, frame, bags, vehicle, survey, options, &count);
      if (count < kFewestSamples) {
        cannot("its frame '" + frame + "' cannot be followed from '" + survey.world +
               "'; record its transform, or add it to the URDF");
        continue;
      }
      const std::string hint =
          GravityHint(options.gravity_W, survey.world, felt, "the mean of " + topic);
      if (!hint.empty()) hints.push_back(hint);
    }
  }
  return hints;
}

}  // namespace cosserat_cable
