#include "state_dump.h"

#include <yaml-cpp/yaml.h>

#include <string>

#include "cosserat_cable/ros/summary.h"

namespace cosserat_cable {
namespace {

constexpr int kRoundTripDigits = 17;

void Emit(const Pose& pose, YAML::Emitter* out) {
  *out << YAML::Flow << YAML::BeginSeq << pose.p.x() << pose.p.y() << pose.p.z() << pose.q.x()
       << pose.q.y() << pose.q.z() << pose.q.w() << YAML::EndSeq;
}

void Emit(const char* key, const Motion& motion, YAML::Emitter* out) {
  const auto vector = [out](const char* name, const Eigen::Vector3d& v) {
    *out << YAML::Key << name << YAML::Value << YAML::Flow << YAML::BeginSeq << v.x() << v.y()
         << v.z() << YAML::EndSeq;
  };
  *out << YAML::Key << key << YAML::Value << YAML::BeginMap << YAML::Key << "pose" << YAML::Value;
  Emit(motion.X, out);
  vector("velocity", motion.v);
  vector("angular_velocity", motion.omega);
  *out << YAML::EndMap;
}

}  // namespace

bool DumpState(const std::string& path, const CableSimulation& cable, const Surroundings& then,
               std::int64_t time, const std::string& world_frame, const Eigen::Vector3d& gravity_W,
               const std::string& message) {
  YAML::Emitter out;
  out.SetDoublePrecision(kRoundTripDigits);
  out << YAML::BeginMap;
  out << YAML::Key << "cable" << YAML::Value << cable.model().name;
  out << YAML::Key << "stamp_ns" << YAML::Value << time;
  out << YAML::Key << "message" << YAML::Value << message;
  out << YAML::Key << "world_frame" << YAML::Value << world_frame;
  out << YAML::Key << "gravity" << YAML::Value << YAML::Flow << YAML::BeginSeq << gravity_W.x()
      << gravity_W.y() << gravity_W.z() << YAML::EndSeq;
  out << YAML::Comment("m/s^2, in the world frame");
  out << YAML::Comment("poses: x y z qx qy qz qw in the world frame");
  Emit("clamp_a", then.a, &out);
  Emit("clamp_b", then.b, &out);
  out << YAML::Key << "last_good_nodes" << YAML::Value << YAML::BeginSeq;
  for (const Pose& node : cable.nodes()) Emit(node, &out);
  out << YAML::EndSeq << YAML::EndMap;
  return WriteTextFile(path, std::string(out.c_str()) + "\n");
}

}  // namespace cosserat_cable
