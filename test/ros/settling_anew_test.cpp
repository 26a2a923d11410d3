// Clocks that are set and frames that come and go: the cables settle anew where motion does not go
// on, once, and are told of it; a single wrong stamp changes nothing.
#include <algorithm>
#include <cmath>

#include "ros/cable_engine_case.h"

namespace cosserat_cable {
namespace {

constexpr std::int64_t kYears = 100'000'000'000'000'000;  // [ns], three of them

class SettlingAnew : public CableEngineTest {
 protected:
  static tf2_msgs::TFMessage Transforms(std::int64_t stamp,
                                        std::vector<std::pair<std::string, std::string>> edges) {
    tf2_msgs::TFMessage message;
    for (const auto& [parent, child] : edges) {
      geometry_msgs::TransformStamped transform;
      transform.header.frame_id = parent;
      transform.child_frame_id = child;
      transform.header.stamp = ToRosTime(stamp);
      transform.transform.rotation.w = 1;
      message.transforms.push_back(transform);
    }
    return message;
  }

  static bool Says(const std::vector<std::string>& news, const std::string& words) {
    return std::any_of(news.begin(), news.end(), [&](const std::string& sentence) {
      return sentence.find(words) != std::string::npos;
    });
  }

  // From `from` to `to` of the telemetry, every 5 ms.
  std::size_t Count(std::int64_t from, std::int64_t to) const {
    const auto& telemetry = out_.telemetry.at("c");
    return static_cast<std::size_t>(
        std::count_if(telemetry.begin(), telemetry.end(), [&](const ApexTelemetry& m) {
          const std::int64_t stamp = ToNanoseconds(m.header.stamp);
          return from <= stamp && stamp < to;
        }));
  }

  const std::vector<std::pair<std::string, std::string>> kAll = {{"odom", "base"},
                                                                 {"base", "other"}};
};

TEST_F(SettlingAnew, AClockThatIsSetForwardByYears) {
  CableEngine engine(vehicle_, bodies_, {MakeCable("c", "other")}, options_);
  Feed(&engine, kStart, 200);
  Feed(&engine, kStart + kYears, 200);
  engine.Finish();
  engine.Advance(&out_);
  const Summary summary = engine.MakeSummary();
  EXPECT_EQ(summary.resets, 1u);
  EXPECT_TRUE(Says(engine.TakeNews(), "time jumped forward by 1e+08 s"));
  // Two seconds less what the motion curves wait for before the step, and nothing between.
  EXPECT_LT(summary.simulated_time, 2.0);
  EXPECT_GT(summary.simulated_time, 1.8);
  EXPECT_EQ(Count(kStart + 1'000'000'000, kStart + kYears), 0u);
  EXPECT_GE(Count(kStart + kYears, kStart + 2 * kYears), 198u);
  EXPECT_FALSE(engine.AnyFailed());
}

// Also where an edge has too few samples for its rate to be known, and where the stamp is the last.
TEST_F(SettlingAnew, NotForOneMessageFarAhead) {
  for (const int at : {0, 1, 2, 3, 100, 199}) {
    out_ = Recorder();
    CableEngine engine(vehicle_, bodies_, {MakeCable("c", "other")}, options_);
    Feed(&engine, kStart, at);
    engine.Ingest(Transforms(kStart + kYears, kAll), false);
    engine.Advance(&out_);
    Feed(&engine, kStart + at * kPeriod, 200 - at);
    engine.Finish();
    engine.Advance(&out_);
    const Summary summary = engine.MakeSummary();
    EXPECT_LE(summary.simulated_time, 1.0) << at;
    EXPECT_GE(summary.simulated_time, 0.98) << at;
    EXPECT_EQ(Count(kStart + 1'000'000'000, 2 * kYears), 0u) << at;
    // The first of all stamps is the only one there is, until time runs backwards from it.
    EXPECT_EQ(summary.warnings.count(at == 0 ? "time ran backwards" : "sample with a bad stamp"),
              1u)
        << at;
  }
}

TEST_F(SettlingAnew, NotForAFrameThatIsSentOnceInAWhile) {
  options_.links.max_gap = 10;
  CableEngine engine(vehicle_, bodies_, {MakeCable("c", "other")}, options_);
  for (int i = 0; i <= 1500; ++i) {
    // base -> other once in 75 s, odom -> base ten times a second.
    auto edges = kAll;
    if (i % 750 != 0) edges.pop_back();
    engine.Ingest(Transforms(kStart + i * 100'000'000LL, edges), false);
  }
  engine.Advance(&out_);
  EXPECT_EQ(engine.MakeSummary().resets, 0u);
  EXPECT_EQ(engine.MakeSummary().warnings.count("time jumped forward"), 0u);
}

TEST_F(SettlingAnew, NotForAFrameAboveTheInertialOneThatComesLate) {
  CableEngine engine(vehicle_, bodies_, {MakeCable("c", "base")}, options_);
  Feed(&engine, kStart, 100);
  // Five metres off: no cable would survive that.
  auto late = Transforms(kStart + 100 * kPeriod, {{"map", "odom"}});
  late.transforms[0].transform.translation.x = 5;
  engine.Ingest(late, false);
  Feed(&engine, kStart + 100 * kPeriod, 100);
  engine.Finish();
  engine.Advance(&out_);
  EXPECT_EQ(engine.links().world(), "odom");
  EXPECT_TRUE(Says(engine.TakeNews(), "'odom', which stays the inertial frame"));
  EXPECT_EQ(engine.MakeSummary().resets, 0u);
  EXPECT_FALSE(engine.AnyFailed());
  EXPECT_GE(out_.telemetry.at("c").size(), 198u);
}

TEST_F(SettlingAnew, WhereTheVehiclesOwnMotionComesLate) {
  CableEngine engine(vehicle_, bodies_, {MakeCable("c", "other")}, options_);
  for (int i = 0; i < 300; ++i) {
    engine.Ingest(Transforms(kStart + i * kPeriod, {{"base", "other"}}), false);
    engine.Advance(&out_);
  }
  EXPECT_EQ(engine.links().world(), "base");
  EXPECT_TRUE(engine.started());
  Feed(&engine, kStart + 300 * kPeriod, 200);
  EXPECT_EQ(engine.links().world(), "odom");
  EXPECT_TRUE(Says(engine.TakeNews(), "moves in 'odom' from now on, not in 'base'"));
  EXPECT_EQ(engine.MakeSummary().resets, 1u);
  // Telemetry goes on in time.
  EXPECT_TRUE(std::is_sorted(out_.order.begin(), out_.order.end()));
  EXPECT_FALSE(engine.AnyFailed());
}

TEST_F(SettlingAnew, WhereATransformThatClosedALoopIsGone) {
  options_.links.is_node = true;
  CableEngine engine(vehicle_, bodies_, {MakeCable("c", "other")}, options_);
  engine.Ingest(Transforms(kStart, {{"base", "odom"}, {"base", "other"}}), false);
  // Two seconds later it is forgotten.
  Feed(&engine, kStart + kPeriod, 600);
  const auto news = engine.TakeNews();
  EXPECT_TRUE(Says(news, "'odom -> base' by /tf closes a loop of frames and is ignored"));
  EXPECT_TRUE(Says(news, "'base' -> 'odom' is sent no more, and 'odom' -> 'base' counts instead"));
  EXPECT_EQ(engine.links().world(), "odom");
  EXPECT_GE(Count(kStart + 2'500'000'000, kStart + 2'900'000'000), 80u);
  EXPECT_FALSE(engine.AnyFailed());
}

TEST_F(SettlingAnew, WhereAFrameHasAnotherParentForGood) {
  options_.links.is_node = true;
  CableEngine engine(vehicle_, bodies_, {MakeCable("c", "other")}, options_);
  Feed(&engine, kStart, 200);
  const auto moved = [&](int from, int to, bool both) {
    for (int i = from; i < to; ++i) {
      std::vector<std::pair<std::string, std::string>> edges = {{"base", "other"},
                                                                {"world", "base"}};
      if (both) edges.emplace_back("odom", "base");
      engine.Ingest(Transforms(kStart + i * kPeriod, edges), false);
      engine.Advance(&out_);
    }
  };
  // While both are sent, the first one counts, for however long.
  moved(200, 1000, true);
  EXPECT_EQ(engine.links().world(), "odom");
  EXPECT_EQ(engine.MakeSummary().resets, 0u);
  moved(1000, 1600, false);
  EXPECT_EQ(engine.links().world(), "world");
  EXPECT_EQ(engine.MakeSummary().resets, 1u);
  EXPECT_GE(Count(kStart + 7'500'000'000, kStart + 7'900'000'000), 80u);
}

// A step of years that no bound would catch can still be interrupted, and goes on where it was.
TEST_F(SettlingAnew, NotWhereAdvancingIsStopped) {
  CableEngine engine(vehicle_, bodies_, {MakeCable("c", "base")}, options_);
  for (int i = 0; i < 400; ++i)
    engine.Ingest(Transforms(kStart + i * kPeriod, {{"odom", "base"}}), false);
  int asked = 0;
  engine.Advance(&out_, [&asked] { return ++asked == 3; });
  EXPECT_EQ(asked, 3);
  EXPECT_LT(engine.now(), kStart + 200'000'000);
  engine.Finish();
  engine.Advance(&out_);
  EXPECT_EQ(out_.telemetry.at("c").size(), 399u);
  EXPECT_EQ(engine.MakeSummary().resets, 0u);
}

}  // namespace
}  // namespace cosserat_cable
