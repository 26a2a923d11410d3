#include <algorithm>
#include <cmath>
#include <filesystem>

#include "ros/cable_engine_case.h"

namespace cosserat_cable {
namespace {

TEST_F(CableEngineTest, StampsAreOnTheGridAndReachTheEnd) {
  CableEngine engine(vehicle_, bodies_, {MakeCable("c", "base")}, options_);
  Feed(&engine, kStart, 201);
  engine.Finish();
  engine.Advance(&out_);
  const auto& telemetry = out_.telemetry.at("c");
  // Steps from 1000.001 to 1001.000 s, telemetry on multiples of 5 ms within.
  ASSERT_EQ(telemetry.size(), 200u);
  for (std::size_t i = 0; i < telemetry.size(); ++i) {
    const std::int64_t expected = 1'000'005'000'000 + static_cast<std::int64_t>(i) * 5'000'000;
    EXPECT_EQ(ToNanoseconds(telemetry[i].header.stamp), expected);
    EXPECT_EQ(telemetry[i].header.frame_id, "base");
    EXPECT_FALSE(telemetry[i].held);
  }
  EXPECT_EQ(out_.markers.at("c").size(), 30u);
  EXPECT_EQ(engine.now(), 1'001'000'000'000);
  EXPECT_FALSE(engine.AnyFailed());
}

TEST_F(CableEngineTest, SameInputSameBits) {
  std::vector<std::vector<ApexTelemetry>> runs;
  for (int run = 0; run < 2; ++run) {
    out_ = Recorder();
    CableEngine engine(vehicle_, bodies_, {MakeCable("c", "base")}, options_);
    Feed(&engine, kStart, 60);
    runs.push_back(out_.telemetry.at("c"));
  }
  EXPECT_EQ(runs[0], runs[1]);
}

TEST_F(CableEngineTest, ThreadsChangeNothing) {
  // Nine cables of two kinds: groups of up to five, and a failure in the midst of them.
  std::vector<CableModel> cables;
  for (int i = 0; i < 9; ++i) {
    cables.push_back(MakeCable("c" + std::to_string(i), i == 5 ? "other" : "base"));
    if (i % 2 == 1) cables.back().elements = 24;
    cables.back().mass_per_length *= 1 + 0.1 * i;
  }
  std::vector<Recorder> runs;
  for (const int threads : {1, 2, 7}) {
    out_ = Recorder();
    options_.threads = threads;
    CableEngine engine(vehicle_, bodies_, cables, options_);
    Feed(&engine, kStart, 300, [](double t) { return t < 0.7 ? 0.0 : 1e5 * (t - 0.7); });
    engine.Finish();
    engine.Advance(&out_);
    EXPECT_TRUE(engine.AnyFailed());
    runs.push_back(out_);
  }
  for (const Recorder& run : runs) {
    EXPECT_EQ(run.telemetry, runs.front().telemetry);
    EXPECT_EQ(run.diagnostics, runs.front().diagnostics);
    EXPECT_EQ(run.markers, runs.front().markers);
    EXPECT_EQ(run.order, runs.front().order);
    EXPECT_TRUE(std::is_sorted(run.order.begin(), run.order.end()));
  }
  EXPECT_GT(runs.front().order.size(), 9u * 100);
}

TEST_F(CableEngineTest, MarkersMayBeLeftOut) {
  CableEngine engine(vehicle_, bodies_, {MakeCable("c", "base")}, options_);
  engine.SendMarkers(false);
  Feed(&engine, kStart, 101);
  EXPECT_TRUE(out_.markers.empty());
  const std::size_t telemetry = out_.telemetry.at("c").size();
  EXPECT_GE(telemetry, 90u);  // the last samples wait for later ones
  engine.SendMarkers(true);
  Feed(&engine, kStart + 101 * kPeriod, 100);
  // 30 Hz over half a second, and what the motion curve had kept waiting.
  EXPECT_NEAR(static_cast<double>(out_.markers.at("c").size()), 16, 1);
  EXPECT_GT(out_.telemetry.at("c").size(), telemetry + 90);
}

TEST_F(CableEngineTest, RunningBackwardsSettlesAnew) {
  CableEngine engine(vehicle_, bodies_, {MakeCable("c", "base")}, options_);
  Feed(&engine, kStart, 300);
  const std::size_t first_run = out_.telemetry.at("c").size();
  Feed(&engine, kStart, 300);
  const auto& telemetry = out_.telemetry.at("c");
  ASSERT_EQ(telemetry.size(), 2 * first_run);
  for (std::size_t i = 0; i < first_run; ++i) {
    EXPECT_EQ(telemetry[i], telemetry[first_run + i]) << i;
  }
  EXPECT_EQ(engine.MakeSummary().resets, 1u);
}

TEST_F(CableEngineTest, GapsAreFlagged) {
  CableEngine engine(vehicle_, bodies_, {MakeCable("c", "other")}, options_);
  Feed(&engine, kStart, 41);
  Feed(&engine, kStart + 700'000'000, 41);
  engine.Finish();
  engine.Advance(&out_);
  std::size_t held = 0;
  for (const ApexTelemetry& m : out_.telemetry.at("c")) held += m.held ? 1 : 0;
  // The gap lasts 0.5 s: from 0.2003 to 0.7003 s at 200 Hz.
  EXPECT_EQ(held, 100u);
  // The other link stands still in the base, before and after: only odom -> base has a gap.
  EXPECT_EQ(engine.MakeSummary().gaps, 1u);
}

TEST_F(CableEngineTest, AFailedCableStopsAndTheOthersGoOn) {
  CableEngine engine(vehicle_, bodies_, {MakeCable("torn", "other"), MakeCable("whole", "base")},
                     options_);
  // Away at 1e5 m/s, which no cable survives.
  Feed(&engine, kStart, 400, [](double t) { return t < 1 ? 0.0 : 1e5 * (t - 1); });
  const Summary summary = engine.MakeSummary();
  EXPECT_TRUE(engine.AnyFailed());
  EXPECT_FALSE(summary.cables[0].failure.empty());
  EXPECT_TRUE(summary.cables[1].failure.empty());
  EXPECT_LT(out_.telemetry.at("torn").size(), out_.telemetry.at("whole").size());
  EXPECT_EQ(out_.diagnostics.back().status[1].level, diagnostic_msgs::DiagnosticStatus::ERROR);
  EXPECT_EQ(out_.diagnostics.back().status[2].level, diagnostic_msgs::DiagnosticStatus::OK);
  EXPECT_FALSE(std::filesystem::is_empty(folder_));
  EXPECT_EQ(out_.markers.at("torn").back().markers[0].action, visualization_msgs::Marker::DELETE);
  for (const auto& [name, messages] : out_.telemetry) {
    for (const ApexTelemetry& m : messages) EXPECT_TRUE(std::isfinite(m.position_x)) << name;
  }
}

TEST_F(CableEngineTest, AVehicleUpsideDownIsTold) {
  const auto kinds_told = [&](bool judge) {
    options_.links.judge = judge;
    out_.diagnostics.clear();
    CableEngine engine(vehicle_, bodies_, {MakeCable("c", "base")}, options_);
    Feed(&engine, kStart, 401);
    std::string told;
    for (const Finding& finding : engine.AllFindings()) told += finding.kind + " ";
    std::string console;
    for (const std::string& news : engine.TakeNews()) console += news + "\n";
    bool in_diagnostics = false;
    for (const auto& value : out_.diagnostics.back().status.front().values)
      in_diagnostics |= value.value.find("hangs upside down") != std::string::npos;
    const bool expected = told.find("upside_down") != std::string::npos;
    EXPECT_EQ(in_diagnostics, expected);
    EXPECT_EQ(console.find("hangs upside down") != std::string::npos, expected) << console;
    return told;
  };
  EXPECT_EQ(kinds_told(true).find("upside_down"), std::string::npos);
  upside_down_ = true;
  EXPECT_NE(kinds_told(true).find("upside_down"), std::string::npos);
  // Where the recording was judged before, it is told already.
  EXPECT_EQ(kinds_told(false).find("upside_down"), std::string::npos);
  options_.gravity_W = {0, 0, 9.81};
  EXPECT_EQ(kinds_told(true).find("upside_down"), std::string::npos);
}

TEST_F(CableEngineTest, AFailedCableSettlesAnewWhereThatIsAskedFor) {
  options_.settle_again = 1;
  CableEngine engine(vehicle_, bodies_, {MakeCable("torn", "other"), MakeCable("whole", "base")},
                     options_);
  // Away at 1e5 m/s for a moment, and back again: at 0.5 s, and at 2 s.
  Feed(&engine, kStart, 1500, [](double t) {
    return t > 0.5 && t < 0.6 ? 1e5 * (t - 0.5) : t > 2 && t < 2.1 ? 1e5 * (t - 2) : 0.0;
  });
  engine.Finish();
  engine.Advance(&out_);
  const auto times = [&] {
    std::vector<double> seconds;
    for (const ApexTelemetry& m : out_.telemetry.at("torn"))
      seconds.push_back(1e-9 * static_cast<double>(ToNanoseconds(m.header.stamp) - kStart));
    return seconds;
  }();
  // A second after it failed, two seconds after it failed again.
  std::vector<double> begins = {times.front()};
  for (std::size_t i = 1; i < times.size(); ++i)
    if (times[i] - times[i - 1] > 0.1) begins.push_back(times[i]);
  ASSERT_EQ(begins.size(), 3u);
  EXPECT_NEAR(begins[1], 1.5, 0.1);
  EXPECT_NEAR(begins[2], 4, 0.1);
  EXPECT_GT(times.back(), 7.4);
  EXPECT_EQ(out_.telemetry.at("whole").size(), 1499u);
  EXPECT_TRUE(engine.Stopped().empty());
  // What has happened stays told.
  EXPECT_TRUE(engine.AnyFailed());
  EXPECT_FALSE(engine.MakeSummary().cables[0].failure.empty());
}

TEST_F(CableEngineTest, OptionsOutOfRangeAreListed) {
  options_.dt = 1;
  options_.amplitude_window = NAN;
  options_.markers.curvature_scale = -1;
  // dt also makes the rates too high.
  EXPECT_EQ(options_.Check().size(), 5u);
  EXPECT_TRUE(EngineOptions().Check().empty());
}

}  // namespace
}  // namespace cosserat_cable
