// A rostest node: holds a cable's telemetry to bounds. In any package's .test file:
//
//     <test test-name="front_hose" pkg="cosserat_cable" type="apex_check" time-limit="60">
//       <param name="cable" value="brake_hose_fl"/>
//       <param name="start" value="2"/>  <param name="end" value="18"/>
//       <param name="peak_to_peak_max" value="0.060"/>
//       <param name="min_clearance" value="0.002"/>
//     </test>
//
// It listens to cables/CABLE/apex until the window is over or nothing comes for `silence` seconds
// (default 5), or reads the bag in `bag`. Several windows: a list `checks` of maps with the same
// keys. All bounds: apex_gate.h; `comparison` names a bag for max_rms_difference.
#include <gtest/gtest.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <algorithm>
#include <chrono>
#include <set>

#include "cosserat_cable/ros/apex_gate.h"

namespace cosserat_cable {
namespace {

// Telemetry of a whole test may come faster than it is looked at [messages].
constexpr std::uint32_t kQueue = 100'000;
constexpr double kFirstMessageTimeout = 60;  // [s], for the node to start and the cables to settle

double ToNumber(XmlRpc::XmlRpcValue value, const std::string& key, Problems* problems) {
  if (value.getType() == XmlRpc::XmlRpcValue::TypeDouble) return static_cast<double>(value);
  if (value.getType() == XmlRpc::XmlRpcValue::TypeInt) return static_cast<int>(value);
  problems->Add("", 0, key, "expected a number");
  return 0;
}

// Reads the bounds out of a map of parameters; keys that are none are problems unless `others` has
// them.
ApexBounds ReadBounds(XmlRpc::XmlRpcValue map, const std::set<std::string>& others,
                      Problems* problems) {
  ApexBounds bounds;
  std::map<std::string, double*> numbers = {{"start", &bounds.start},
                                            {"end", &bounds.end},
                                            {"peak_to_peak_min", &bounds.peak_to_peak_min},
                                            {"peak_to_peak_max", &bounds.peak_to_peak_max},
                                            {"min_clearance", &bounds.min_clearance},
                                            {"max_penetration", &bounds.max_penetration},
                                            {"max_curvature", &bounds.max_curvature},
                                            {"max_contact_force", &bounds.max_contact_force},
                                            {"max_interval", &bounds.max_interval},
                                            {"max_rms_difference", &bounds.max_rms_difference}};
  std::vector<std::string> known = {"name", "axis"};
  for (const auto& [key, number] : numbers) known.push_back(key);
  for (auto& [key, value] : map) {
    if (numbers.count(key) > 0) {
      *numbers[key] = ToNumber(value, key, problems);
    } else if (key == "name" && value.getType() == XmlRpc::XmlRpcValue::TypeString) {
      bounds.name = static_cast<std::string>(value);
    } else if (key == "axis" && value.getType() == XmlRpc::XmlRpcValue::TypeString) {
      const auto axis = static_cast<std::string>(value);
      if (axis != "x" && axis != "y" && axis != "z" && axis != "principal") {
        problems->Add("", 0, key, "got '" + axis + "', expected x, y, z or principal");
      } else {
        bounds.axis = axis.front();
      }
    } else if (others.count(key) == 0) {
      const std::string nearest = NearestWord(key, known);
      problems->Add("", 0, key,
                    "unknown" + (nearest.empty() ? "" : ", did you mean '" + nearest + "'?"));
    }
  }
  return bounds;
}

std::vector<ApexTelemetry> Listen(const std::string& cable, double duration, double silence) {
  using Clock = std::chrono::steady_clock;
  std::vector<ApexTelemetry> messages;
  Clock::time_point last = Clock::now();
  ros::NodeHandle node;
  const auto subscriber = node.subscribe<ApexTelemetry>(
      "cables/" + cable + "/apex", kQueue, [&](const ApexTelemetryConstPtr& message) {
        // A recording that starts over is another run.
        if (messages.empty() || message->header.stamp > messages.back().header.stamp) {
          messages.push_back(*message);
        }
        last = Clock::now();
      });
  while (ros::ok()) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.05));
    const double quiet = std::chrono::duration<double>(Clock::now() - last).count();
    if (quiet > (messages.empty() ? kFirstMessageTimeout : silence)) break;
    if (!messages.empty() &&
        (messages.back().header.stamp - messages.front().header.stamp).toSec() > duration) {
      break;
    }
  }
  return messages;
}

TEST(ApexCheck, BoundsHold) {
  ros::NodeHandle parameters("~");
  Problems problems;
  const std::set<std::string> others = {"cable", "bag", "comparison", "checks", "silence"};
  XmlRpc::XmlRpcValue all;
  ASSERT_TRUE(parameters.getParam(parameters.getNamespace(), all)) << "no parameters are set";
  std::string cable;
  ASSERT_TRUE(parameters.getParam("cable", cable)) << "parameter ~cable is missing";

  std::vector<ApexBounds> checks;
  XmlRpc::XmlRpcValue list;
  if (parameters.getParam("checks", list)) {
    ASSERT_EQ(list.getType(), XmlRpc::XmlRpcValue::TypeArray) << "~checks is no list";
    for (int i = 0; i < list.size(); ++i) checks.push_back(ReadBounds(list[i], {}, &problems));
    ReadBounds(all, others, &problems);
  } else {
    checks.push_back(ReadBounds(all, others, &problems));
  }
  double duration = 0;
  for (const ApexBounds& bounds : checks) duration = std::max(duration, bounds.end);

  const auto comparison_path = parameters.param<std::string>("comparison", "");
  const auto bag = parameters.param<std::string>("bag", "");
  std::vector<ApexTelemetry> comparison;
  if (!comparison_path.empty()) {
    comparison = ReadApexTelemetry(comparison_path, cable, &problems);
  }
  std::vector<ApexTelemetry> messages;
  if (!bag.empty()) messages = ReadApexTelemetry(bag, cable, &problems);
  ASSERT_TRUE(problems.empty()) << problems.ToString();
  if (bag.empty()) messages = Listen(cable, duration, parameters.param("silence", 5.0));
  ASSERT_FALSE(messages.empty()) << "no telemetry of cable '" << cable << "'";

  for (const ApexBounds& bounds : checks) {
    const ApexVerdict verdict = Judge(messages, comparison, bounds);
    for (const std::string& line : verdict.measured) std::cout << cable << ": " << line << "\n";
    for (const std::string& line : verdict.violations) ADD_FAILURE() << cable << ": " << line;
  }
}

}  // namespace
}  // namespace cosserat_cable

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "apex_check");
  return RUN_ALL_TESTS();
}
