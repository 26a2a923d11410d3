// For tests of the engine: a cable, a vehicle that shakes, and what is told of it.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "cosserat_cable/ros/cable_engine.h"
#include "cosserat_cable/ros/conversions.h"

namespace cosserat_cable {

inline constexpr std::int64_t kStart = 1'000'000'300'000;  // [ns], not on the grid of steps
inline constexpr std::int64_t kPeriod = 5'000'000;         // 200 Hz

class Recorder : public OutputSink {
 public:
  void Telemetry(const std::string& cable, const ApexTelemetry& message) override {
    telemetry[cable].push_back(message);
    order.push_back(ToNanoseconds(message.header.stamp));
  }
  void Markers(const std::string& cable, const visualization_msgs::MarkerArray& message) override {
    markers[cable].push_back(message);
    order.push_back(ToNanoseconds(message.markers.front().header.stamp));
  }
  void Diagnostics(const diagnostic_msgs::DiagnosticArray& message) override {
    diagnostics.push_back(message);
    order.push_back(ToNanoseconds(message.header.stamp));
  }
  std::map<std::string, std::vector<ApexTelemetry>> telemetry;
  std::map<std::string, std::vector<visualization_msgs::MarkerArray>> markers;
  std::vector<diagnostic_msgs::DiagnosticArray> diagnostics;
  std::vector<std::int64_t> order;  // stamps as they came
};

// An arch between two links of its own: the second can be torn away.
inline CableModel MakeCable(const std::string& name, const std::string& other_link) {
  CableModel cable;
  cable.name = name;
  cable.reference = cable.a.link = "base";
  cable.b.link = other_link;
  cable.b.X_LC.p = {0.1, 0, 0};
  cable.b.X_LC.q = Eigen::Quaterniond(0, 0, 1, 0);  // its tangent points down
  cable.length = 0.2;
  cable.diameter = 0.008;
  cable.mass_per_length = 0.15;
  cable.EI1 = cable.EI2 = 0.008;
  cable.GJ = 0.006;
  cable.EA = 16 * cable.EI1 / (cable.diameter * cable.diameter);
  cable.GA1 = cable.GA2 = cable.EA / 3;
  cable.eta_EI1 = cable.eta_EI2 = 1e-4;
  cable.eta_GJ = 5e-5;
  cable.eta_EA = 4 * cable.length / M_PI * std::sqrt(cable.mass_per_length * cable.EA);
  cable.eta_GA1 = cable.eta_GA2 = 2 * std::sqrt(cable.rhoI() * cable.GA1);
  cable.apex_s = cable.length / 2;
  cable.elements = 20;
  return cable;
}

class CableEngineTest : public testing::Test {
 protected:
  CableEngineTest() {
    char folder[] = "/tmp/cable_engine_test_XXXXXX";
    folder_ = mkdtemp(folder);
    options_.dump_directory = folder_;
    vehicle_.root = "base";
    vehicle_.links = {"base", "other"};
  }
  ~CableEngineTest() override { std::filesystem::remove_all(folder_); }

  // Shakes the base by 1 mm at 10 Hz; the other link is `tear` metres off it.
  void Feed(
      CableEngine* engine, std::int64_t from, int samples,
      const std::function<double(double)>& tear = [](double) { return 0.0; }) {
    for (int i = 0; i < samples; ++i) {
      const std::int64_t stamp = from + i * kPeriod;
      const double t = 1e-9 * static_cast<double>(stamp - kStart);
      tf2_msgs::TFMessage message;
      message.transforms.resize(2);
      message.transforms[0].header.frame_id = "odom";
      message.transforms[0].child_frame_id = "base";
      message.transforms[0].transform.translation.x = 0.001 * std::sin(2 * M_PI * 10 * t);
      message.transforms[1].header.frame_id = "base";
      message.transforms[1].child_frame_id = "other";
      message.transforms[1].transform.translation.x = tear(t);
      for (auto& transform : message.transforms) {
        transform.header.stamp = ToRosTime(stamp);
        transform.transform.rotation.w = 1;
      }
      if (upside_down_) {
        message.transforms[0].transform.rotation.w = 0;
        message.transforms[0].transform.rotation.x = 1;
      }
      engine->Ingest(message, false);
      engine->Advance(&out_);
    }
  }

  bool upside_down_ = false;  // half a turn about x
  std::string folder_;
  VehicleModel vehicle_;
  BodyMap bodies_;
  EngineOptions options_;
  Recorder out_;
};

}  // namespace cosserat_cable
