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
// (default 5), or reads the bag in `bag`. Several windows or cables at once (rostest runs one test
// after another, and a recording is played once): a list `checks` of maps with the same keys; what
// stands beside the list holds for each of its entries that does not say otherwise. All bounds:
// apex_gate.h; `comparison` names a bag for max_rms_difference.
#include <gtest/gtest.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cosserat_cable/console/run_tool.h"
#include "cosserat_cable/ros/apex_gate.h"

namespace cosserat_cable {
namespace {

// Telemetry of a whole test may come faster than it is looked at [messages].
constexpr std::uint32_t kQueue = 100'000;
constexpr double kFirstMessageTimeout = 60;  // [s], for the node to start and the cables to settle

double ToNumber(XmlRpc::XmlRpcValue value, const std::string& key, Problems* problems) {
  if (value.getType() == XmlRpc::XmlRpcValue::TypeDouble) {
    const auto number = static_cast<double>(value);
    // A window may have no end; any other bound without one holds whatever happens.
    if (std::isnan(number) || (std::isinf(number) && key != "end"))
      problems->Add(
          "", 0, key,
          std::isnan(number) ? "got nan, expected a number" : "got inf, expected a finite number");
    return number;
  }
  if (value.getType() == XmlRpc::XmlRpcValue::TypeInt) return static_cast<int>(value);
  problems->Add("", 0, key, "expected a number");
  return 0;
}

struct Check {
  std::string cable;
  ApexBounds bounds;
};

using Telemetry = std::map<std::string, std::vector<ApexTelemetry>>;  // by cable

// Puts a map of parameters over `check`; keys that are none are problems unless `others` has them.
Check ReadCheck(XmlRpc::XmlRpcValue map, Check check, const std::set<std::string>& others,
                Problems* problems) {
  ApexBounds& bounds = check.bounds;
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
  std::vector<std::string> known = {"cable", "name", "axis"};
  for (const auto& [key, number] : numbers) known.push_back(key);
  for (auto& [key, value] : map) {
    if (numbers.count(key) > 0) {
      *numbers[key] = ToNumber(value, key, problems);
    } else if (key == "name" && value.getType() == XmlRpc::XmlRpcValue::TypeString) {
      bounds.name = static_cast<std::string>(value);
    } else if (key == "cable" && value.getType() == XmlRpc::XmlRpcValue::TypeString) {
      check.cable = static_cast<std::string>(value);
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
  return check;
}

// Until each cable's last window is over.
Telemetry Listen(const std::vector<Check>& checks, double silence) {
  using Clock = std::chrono::steady_clock;
  Telemetry telemetry;
  std::map<std::string, double> durations;
  for (const Check& check : checks) {
    double& duration = durations[check.cable];
    duration = std::max(duration, check.bounds.end);
  }
  Clock::time_point last = Clock::now();
  ros::NodeHandle node;
  std::vector<ros::Subscriber> subscribers;
  for (const auto& [cable, duration] : durations) {
    std::vector<ApexTelemetry>& messages = telemetry[cable];
    const boost::function<void(const ApexTelemetryConstPtr&)> take =
        [&messages, &last](const ApexTelemetryConstPtr& message) {
          // A recording that starts over is another run.
          if (messages.empty() || message->header.stamp > messages.back().header.stamp) {
            messages.push_back(*message);
          }
          last = Clock::now();
        };
    subscribers.push_back(node.subscribe<ApexTelemetry>("cables/" + cable + "/apex", kQueue, take));
  }
  const auto over = [&](const auto& entry) {
    const std::vector<ApexTelemetry>& messages = telemetry.at(entry.first);
    return !messages.empty() &&
           (messages.back().header.stamp - messages.front().header.stamp).toSec() > entry.second;
  };
  const auto any = [&] {
    return std::any_of(telemetry.begin(), telemetry.end(),
                       [](const auto& entry) { return !entry.second.empty(); });
  };
  while (ros::ok() && !std::all_of(durations.begin(), durations.end(), over)) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.05));
    const double quiet = std::chrono::duration<double>(Clock::now() - last).count();
    if (quiet > (any() ? silence : kFirstMessageTimeout)) break;
  }
  return telemetry;
}

TEST(ApexCheck, BoundsHold) {
  ros::NodeHandle parameters("~");
  Problems problems;
  XmlRpc::XmlRpcValue all;
  ASSERT_TRUE(parameters.getParam(parameters.getNamespace(), all)) << "no parameters are set";

  const Check common = ReadCheck(all, {}, {"bag", "comparison", "checks", "silence"}, &problems);
  std::vector<Check> checks;
  XmlRpc::XmlRpcValue list;
  if (parameters.getParam("checks", list)) {
    ASSERT_EQ(list.getType(), XmlRpc::XmlRpcValue::TypeArray) << "~checks is no list";
    for (int i = 0; i < list.size(); ++i) {
      ASSERT_EQ(list[i].getType(), XmlRpc::XmlRpcValue::TypeStruct)
          << "~checks has no map at " << i;
      checks.push_back(ReadCheck(list[i], common, {}, &problems));
    }
  } else {
    checks.push_back(common);
  }
  ASSERT_FALSE(checks.empty()) << "~checks is empty";
  for (const Check& check : checks) {
    if (check.cable.empty()) problems.Add("", 0, "cable", "missing: the name of a cable");
  }

  const auto comparison_path = parameters.param<std::string>("comparison", "");
  const auto bag = parameters.param<std::string>("bag", "");
  Telemetry comparison, telemetry;
  for (const Check& check : checks) {
    for (const auto& [path, messages] :
         {std::pair(comparison_path, &comparison), std::pair(bag, &telemetry)}) {
      if (path.empty() || messages->count(check.cable) > 0) continue;
      (*messages)[check.cable] = ReadApexTelemetry(path, check.cable, &problems);
    }
  }
  const double silence = parameters.param("silence", 5.0);
  if (!(silence > 0 && std::isfinite(silence)))
    problems.Add("", 0, "silence", "expected a positive number [s]");
  ASSERT_TRUE(problems.empty()) << problems.ToString();
  if (bag.empty()) telemetry = Listen(checks, silence);

  for (const auto& [cable, bounds] : checks) {
    const std::vector<ApexTelemetry>& messages = telemetry.at(cable);
    if (messages.empty()) {
      ADD_FAILURE() << "no telemetry of cable '" << cable << "'";
      continue;
    }
    const ApexVerdict verdict = Judge(messages, comparison[cable], bounds);
    for (const std::string& line : verdict.measured) std::cout << cable << ": " << line << "\n";
    for (const std::string& line : verdict.violations) ADD_FAILURE() << cable << ": " << line;
  }
}

}  // namespace
}  // namespace cosserat_cable

int main(int argc, char** argv) {
  return cosserat_cable::RunTool([&] {
    testing::InitGoogleTest(&argc, argv);
    ros::init(argc, argv, "apex_check");
    return RUN_ALL_TESTS();
  });
}
