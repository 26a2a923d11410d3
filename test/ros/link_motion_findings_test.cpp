// What LinkMotion says of recordings that cannot be what they seem.
#include "link_motion_cases.h"

namespace cosserat_cable {
namespace {

using testing::BodyPose;
using testing::Drive;
using testing::FindKind;
using testing::Joints;
using testing::kPeriod;
using testing::kStart;
using testing::LinkMotionTest;
using testing::Says;
using testing::Shifted;
using testing::Transform;
using testing::Travel;

TEST_F(LinkMotionTest, OneBadStampIsLeftOutAndTold) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  for (const std::int64_t off : {10 * kSecond, -2 * kSecond, kPeriod - 1, kPeriod / 2 * 3}) {
    LinkMotion links(vehicle_, needed_, options_);
    for (int i = 0; i < 200; ++i) {
      const std::int64_t stamp = kStart + i * kPeriod;
      const double t = 1e-9 * static_cast<double>(i * kPeriod);
      links.Ingest(Transform("odom", "base", stamp + (i == 100 ? off : 0), BodyPose(t)), false);
      links.Ingest(Joints(stamp, Travel(t)));
    }
    links.Finish();
    EXPECT_EQ(links.clear_count(), 0u) << off;
    EXPECT_EQ(links.edges().at("base").samples, 199u) << off;
    ASSERT_EQ(links.warnings().counts().size(), 1u) << off;
    EXPECT_EQ(links.warnings().counts().at("sample with a bad stamp"), 1u) << off;
    EXPECT_TRUE(Says(links.warnings().Sentences(kStart), "frame 'base' by /tf"));
    EXPECT_TRUE(Says(links.warnings().Sentences(kStart), off > 0 ? "too late" : "too early"));
    // The body rolls on at 15 m/s.
    EXPECT_NEAR(links.Evaluate("base", kStart + 100 * kPeriod).X.p.x(), 15, 1e-3) << off;
    EXPECT_EQ(FindKind(links.MotionFindings("odom"), "jump"), nullptr) << off;
  }
}

TEST_F(LinkMotionTest, MessagesThatOvertakeEachOtherKeepTheirStamps) {
  LinkMotion links(vehicle_, needed_, options_);
  for (int i = 0; i < 200; ++i) {
    // The 100th and the next one change places.
    const int k = i == 100 ? 101 : i == 101 ? 100 : i;
    links.Ingest(Transform("odom", "base", kStart + k * kPeriod, BodyPose(0.01 * k)), false);
    links.Ingest(Joints(kStart + i * kPeriod, Travel(0.01 * i)));
  }
  links.Finish();
  EXPECT_EQ(links.edges().at("base").samples, 200u);
  EXPECT_TRUE(links.warnings().counts().empty());
}

TEST_F(LinkMotionTest, MessagesThatOvertakeEachOtherByFarAreRecordedLate) {
  LinkMotion links(vehicle_, needed_, options_);
  std::vector<std::pair<std::int64_t, int>> order;  // of recording
  for (int i = 0; i < 400; ++i) order.emplace_back(kStart + i * kPeriod + (i * 7 % 5) * kPeriod, i);
  std::sort(order.begin(), order.end());
  for (const auto& [recorded, i] : order)
    links.Ingest(Transform("odom", "base", kStart + i * kPeriod, BodyPose(0.01 * i)), false, "",
                 recorded);
  links.Finish();
  EXPECT_EQ(links.warnings().counts().count("sample with a bad stamp"), 0u);
}

TEST_F(LinkMotionTest, SamplesRepeatedBehindAGapAreCountedAsSuch) {
  LinkMotion links(vehicle_, needed_, options_);
  for (int i = 0; i < 100; ++i) {
    if (i == 50) continue;
    for (int n = 0; n < 2; ++n)
      links.Ingest(Transform("odom", "base", kStart + i * kPeriod, BodyPose(0.01 * i)), false);
  }
  links.Finish();
  EXPECT_EQ(links.edges().at("base").samples, 99u);
  ASSERT_EQ(links.warnings().counts().size(), 1u);
  EXPECT_EQ(links.warnings().counts().at("sample repeated with the same stamp"), 99u);
}

TEST_F(LinkMotionTest, AFirstStampThatIsWrongIsLeftOut) {
  LinkMotion links(vehicle_, needed_, options_);
  for (int i = 0; i < 100; ++i) {
    const std::int64_t now = kStart + i * kPeriod;
    const std::int64_t stamp = i == 0 ? 5'000'000'000 : now;
    links.Ingest(Transform("odom", "base", stamp, BodyPose(0.01 * i)), false, "", now);
    links.Ingest(Joints(now, Travel(0.01 * i)), "", now);
  }
  links.Finish();
  EXPECT_EQ(links.Start(), kStart);
  EXPECT_EQ(links.edges().at("base").first, kStart + kPeriod);
  std::int64_t begin = 0, ready = 0;
  ASSERT_TRUE(links.Range(&begin, &ready));
  EXPECT_EQ(begin, kStart + kPeriod);
  EXPECT_EQ(links.warnings().counts().at("sample with a bad stamp"), 1u);
  EXPECT_TRUE(links.MotionFindings("odom").empty());
  bool nothing = false;
  EXPECT_TRUE(links.CoverageFindings("odom", &nothing).empty());
}

TEST_F(LinkMotionTest, AClockThatGoesAtAnotherRateIsTold) {
  LinkMotion links(vehicle_, needed_, options_);
  for (int i = 0; i < 1000; ++i) {
    const std::int64_t now = kStart + i * kPeriod;
    links.Ingest(Transform("odom", "base", now, BodyPose(0.01 * i)), false, "", now);
    links.Ingest(Joints(now + i * kPeriod / 50, Travel(0.01 * i)), "", now);
  }
  links.Finish();
  const Findings findings = links.MotionFindings("odom");
  const Finding* drifts = FindKind(findings, "clock_drifts");
  ASSERT_NE(drifts, nullptr);
  EXPECT_EQ(drifts->subject, "/joint_states");
  // 2 % of the 10 s, between the middles of the first and the last eighth.
  EXPECT_NEAR(drifts->size, -0.02 * 10 * 7 / 8, 0.01);
}

TEST_F(LinkMotionTest, AnEdgeThatWasSentOnceLimitsTheRun) {
  LinkMotion links(vehicle_, needed_, options_);
  links.Ingest(Transform("map", "odom", kStart, Shifted(3)), false);
  Drive(&links, kStart, 400);
  links.Finish();
  bool nothing = false;
  const Findings findings = links.CoverageFindings("map", &nothing);
  EXPECT_TRUE(nothing);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].subject, "map -> odom");
  EXPECT_EQ(findings[0].topic, "/tf");
  EXPECT_EQ(findings[0].count, 1u);
  EXPECT_EQ(findings[0].worst, kStart);
  EXPECT_NEAR(findings[0].size, 3.99, 1e-9);
  EXPECT_NE(findings[0].remedy.find("/tf_static"), std::string::npos);
  EXPECT_NE(findings[0].remedy.find("--world-frame odom"), std::string::npos);
  EXPECT_TRUE(links.CoverageFindings("odom", &nothing).empty());
  EXPECT_FALSE(nothing);
}

TEST_F(LinkMotionTest, WhatComesBeforeTheFramesBelowItCountsToo) {
  LinkMotion links(vehicle_, needed_, options_);
  links.Ingest(Transform("map", "odom", kStart, Shifted(3)), false);
  Drive(&links, kStart, 50);
  links.Ingest(Transform("map", "odom", kStart + 49 * kPeriod, Shifted(3)), false);
  links.Finish();
  std::int64_t begin = 0, ready = 0;
  ASSERT_TRUE(links.Range(&begin, &ready));
  EXPECT_EQ(begin, kStart);
  EXPECT_EQ(ready, kStart + 49 * kPeriod);
}

// As the old static_transform_publisher does: stamped ahead, or by an interval behind.
TEST_F(LinkMotionTest, AConstantTransformHoldsForAsLongAsItIsSentAnyway) {
  for (const int ahead : {100, 50, -40}) {
    LinkMotion links(vehicle_, needed_, options_);
    for (int i = 0; i < 10; ++i) {
      const std::int64_t now = kStart + i * 100 * kPeriod;
      if (ahead > 0 || i > 0)
        links.Ingest(Transform("world", "odom", now + ahead * kPeriod, Shifted(3)), false);
      Drive(&links, now, 100);
    }
    links.Finish();
    bool nothing = false;
    EXPECT_TRUE(links.CoverageFindings("world", &nothing).empty()) << ahead;
    EXPECT_FALSE(nothing);
    const std::vector<ConstantEdge> constants = links.Constants("world");
    ASSERT_EQ(constants.size(), 1u) << ahead;
    EXPECT_EQ(constants[0].child, "odom");
    EXPECT_NEAR(constants[0].interval, 1, 1e-9);

    // With that known, the whole recording is followed.
    LinkMotionOptions options = options_;
    options.constants = constants;
    LinkMotion again(vehicle_, needed_, options);
    for (int i = 0; i < 10; ++i) {
      const std::int64_t now = kStart + i * 100 * kPeriod;
      if (i == 9) again.Ingest(Transform("world", "odom", now, Shifted(3)), false);
      Drive(&again, now, 100);
    }
    again.Finish();
    std::int64_t begin = 0, ready = 0;
    ASSERT_TRUE(again.Range(&begin, &ready));
    EXPECT_EQ(again.world(), "world");
    EXPECT_EQ(begin, kStart);
    EXPECT_EQ(ready, kStart + 999 * kPeriod);
    EXPECT_EQ(again.Evaluate("odom", kStart).X.p.x(), 3);
    EXPECT_EQ(again.LatestPose("world", "odom")->p.x(), 3);
  }
}

TEST_F(LinkMotionTest, ATransformThatMovesOrEndsEarlyDoesNotHold) {
  for (const bool moves : {true, false}) {
    LinkMotion links(vehicle_, needed_, options_);
    for (int i = 0; i < 10; ++i) {
      const std::int64_t now = kStart + i * 100 * kPeriod;
      if (moves ? i > 0 : i < 6)
        links.Ingest(Transform("world", "odom", now, Shifted(moves ? i : 3)), false);
      Drive(&links, now, 100);
    }
    links.Finish();
    EXPECT_TRUE(links.Constants("world").empty());
    bool nothing = false;
    EXPECT_EQ(links.CoverageFindings("world", &nothing).size(), 1u);
  }
}

TEST_F(LinkMotionTest, AnEdgeThatEndsEarlyLimitsTheRun) {
  LinkMotion links(vehicle_, needed_, options_);
  for (int i = 0; i < 4; ++i) {
    const std::int64_t stamp = kStart + i * 100 * kPeriod;
    if (i < 3) links.Ingest(Transform("map", "odom", stamp, Shifted(3)), false);
    Drive(&links, stamp, i < 3 ? 100 : 96);
  }
  links.Finish();
  bool nothing = false;
  const Findings findings = links.CoverageFindings("map", &nothing);
  EXPECT_FALSE(nothing);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_NEAR(findings[0].size, 1.95, 1e-9);
  EXPECT_NE(findings[0].what.find("the run has 2.000 s of 3.950 s"), std::string::npos)
      << findings[0].what;
  EXPECT_NE(findings[0].remedy.find("/tf_static"), std::string::npos);
}

TEST_F(LinkMotionTest, AClockThatWasSetBackIsToldInsteadOfJumps) {
  for (const double seconds : {0.05, 0.1, 0.3, 0.45}) {
    LinkMotion links(vehicle_, needed_, options_);
    const auto back = static_cast<std::int64_t>(seconds * 1e9);
    for (int i = 0; i < 600; ++i) {
      const std::int64_t now = kStart + i * kPeriod, stamp = now - (i > 250 ? back : 0);
      const double t = 0.01 * i;
      links.Ingest(Transform("odom", "base", stamp, BodyPose(t)), false, "", now);
      links.Ingest(Joints(now, Travel(t)), "", now);
    }
    links.Finish();
    const Findings findings = links.MotionFindings("odom");
    const Finding* set_back = FindKind(findings, "clock_set_back");
    ASSERT_NE(set_back, nullptr) << seconds;
    EXPECT_EQ(set_back->subject, "odom -> base");
    EXPECT_EQ(set_back->topic, "/tf");
    EXPECT_EQ(set_back->count, 1u);
    EXPECT_EQ(set_back->worst, kStart + 250 * kPeriod);
    EXPECT_NEAR(set_back->size, seconds, 1e-3);
    EXPECT_NE(set_back->remedy.find("--use-record-times"), std::string::npos);
    EXPECT_EQ(FindKind(findings, "jump"), nullptr) << seconds;
    EXPECT_EQ(FindKind(findings, "acceleration"), nullptr) << seconds;
    EXPECT_EQ(FindKind(findings, "clock_drifts"), nullptr) << seconds;
    EXPECT_TRUE(links.warnings().counts().empty()) << seconds;
  }
}

TEST_F(LinkMotionTest, AClockThatWasSetForwardByLessThanAGapIsTold) {
  for (const bool set : {true, false}) {
    LinkMotion links(vehicle_, needed_, options_);
    for (int i = 0; i < 600; ++i) {
      // Otherwise these messages are lost, and the next one comes early.
      if (!set && i > 250 && i < 270) continue;
      const std::int64_t now = kStart + i * kPeriod;
      const std::int64_t recorded = now + 5'000'000 + (i * 7 % 11) * 1'000'000;
      links.Ingest(
          Transform("odom", "base", now + (set && i > 250 ? 200'000'000 : 0), BodyPose(0.01 * i)),
          false, "", recorded);
      links.Ingest(Joints(now, Travel(0.01 * i)), "", recorded);
    }
    links.Finish();
    const Findings findings = links.MotionFindings("odom");
    const Finding* jump = FindKind(findings, "clock_jump");
    ASSERT_EQ(jump != nullptr, set);
    if (!jump) continue;
    EXPECT_EQ(jump->subject, "odom -> base");
    EXPECT_EQ(jump->worst, kStart + 250 * kPeriod);
    EXPECT_NEAR(jump->size, 0.2, 0.02);
    EXPECT_EQ(FindKind(findings, "clock_drifts"), nullptr);
  }
}

TEST_F(LinkMotionTest, MessagesThatComeTooLateInABatchAreNoClockThatWasSetBack) {
  LinkMotion links(vehicle_, needed_, options_);
  for (int i = 0; i < 400; ++i) {
    // The samples 200 to 209 come behind the samples 210 to 219.
    const int k = i >= 200 && i < 210 ? i + 10 : i >= 210 && i < 220 ? i - 10 : i;
    links.Ingest(Transform("odom", "base", kStart + k * kPeriod, BodyPose(0.01 * k)), false);
    links.Ingest(Joints(kStart + i * kPeriod, Travel(0.01 * i)));
  }
  // A second publisher that lags behind.
  LinkMotion two(vehicle_, needed_, options_);
  for (int i = 0; i < 400; ++i) {
    two.Ingest(Transform("odom", "base", kStart + i * kPeriod, BodyPose(0.01 * i)), false, "/a");
    if (i >= 30)
      two.Ingest(Transform("odom", "base", kStart + (i - 30) * kPeriod, BodyPose(0.01 * (i - 30))),
                 false, "/b");
    two.Ingest(Joints(kStart + i * kPeriod, Travel(0.01 * i)));
  }
  for (LinkMotion* each : {&links, &two}) {
    each->Finish();
    EXPECT_EQ(FindKind(each->MotionFindings("odom"), "clock_set_back"), nullptr);
    EXPECT_GT(each->warnings().counts().at("sample older than the one before it"), 5u);
  }
}

TEST_F(LinkMotionTest, TransformsThatAreAllUnusableAreMissed) {
  LinkMotion links(vehicle_, needed_, options_);
  for (int i = 0; i < 20; ++i) {
    tf2_msgs::TFMessage message = Transform("odom", "base", kStart + i * kPeriod, Pose());
    message.transforms[0].transform.rotation.w = i % 2 == 0 ? 0 : std::nan("");
    links.Ingest(message, false);
    links.Ingest(Joints(kStart + i * kPeriod, Travel(0.01 * i)));
  }
  EXPECT_TRUE(Says(links.Missing(),
                   "no transform of /tf can be used, of 20 (the first: 'odom' -> "
                   "'base', its quaternion has the length 0)"));
  // One that can is enough for a node to begin.
  links.Ingest(Transform("odom", "base", kStart + 20 * kPeriod, Pose()), false);
  EXPECT_TRUE(links.Missing().empty());
}

TEST_F(LinkMotionTest, BurstsAreToldOfTheirTopic) {
  LinkMotion links(vehicle_, needed_, options_);
  for (int i = 0; i < 400; ++i) {
    const std::int64_t sent = kStart + (i / 20) * 20 * kPeriod + (i % 20) * 1000;
    links.Ingest(Transform("odom", "base", sent, BodyPose(0.01 * i)), false, "", sent);
    links.Ingest(Joints(kStart + i * kPeriod, Travel(0.01 * i)));
  }
  links.Finish();
  const Findings findings = links.MotionFindings("odom");
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, "bursts");
  EXPECT_EQ(findings[0].subject, "odom -> base");
  EXPECT_EQ(findings[0].topic, "/tf");
}

TEST_F(LinkMotionTest, AnotherPoseAtTheSameStampIsToldAsStampOfSending) {
  for (const bool moves : {true, false}) {
    LinkMotion links(vehicle_, needed_, options_);
    for (int i = 0; i < 400; ++i)
      links.Ingest(Transform("odom", "base", kStart + (i / 10) * 10 * kPeriod,
                             BodyPose(moves ? 0.01 * i : 0)),
                   false);
    links.Finish();
    EXPECT_EQ(links.warnings().counts().at("sample repeated with the same stamp"), 360u);
    EXPECT_EQ(Says(links.warnings().Sentences(), "are poses stamped when they are sent"), moves);
  }
}

TEST_F(LinkMotionTest, ATopicOfAnotherClockIsTold) {
  constexpr std::int64_t kLate = 1'500'000'000;
  LinkMotion links(vehicle_, needed_, options_);
  for (int i = 0; i < 400; ++i) {
    const std::int64_t now = kStart + i * kPeriod;
    links.Ingest(Transform("odom", "base", now, BodyPose(0.01 * i)), false, "", now + 2'000'000);
    links.Ingest(Joints(now - kLate, Travel(0.01 * i)), "", now + 3'000'000);
  }
  links.Finish();
  EXPECT_EQ(links.Start(), kStart);
  const Findings findings = links.MotionFindings("odom");
  const Finding* off = FindKind(findings, "clock_off");
  ASSERT_NE(off, nullptr);
  EXPECT_EQ(off->subject, "/joint_states");
  EXPECT_NEAR(off->size, 1.501, 1e-6);
  EXPECT_NE(off->what.find("1.5 s behind"), std::string::npos);
  // By the stamps alone.
  bool nothing = false;
  const Findings coverage = links.CoverageFindings("odom", &nothing);
  ASSERT_EQ(coverage.size(), 1u);
  EXPECT_NE(coverage[0].remedy.find("begins and ends 1.5 s before odom -> base"), std::string::npos)
      << coverage[0].remedy;
}

TEST_F(LinkMotionTest, GapsAreToldWithTimeAndSize) {
  for (const bool clock : {false, true}) {
    LinkMotion links(vehicle_, needed_, options_);
    for (int i = 0; i < 400; ++i) {
      const std::int64_t now = kStart + (i + (i > 200 ? 80 : 0)) * kPeriod;
      const std::int64_t recorded = clock ? kStart + i * kPeriod : now;
      links.Ingest(Transform("odom", "base", now, BodyPose(0.01 * i)), false, "", recorded);
      links.Ingest(Joints(now, Travel(0.01 * i)), "", recorded);
    }
    links.Finish();
    const Findings findings = links.MotionFindings("odom");
    const Finding* gap = FindKind(findings, clock ? "clock_jump" : "gap");
    ASSERT_NE(gap, nullptr);
    EXPECT_EQ(gap->subject, "odom -> base");
    EXPECT_EQ(gap->count, 1u);
    EXPECT_EQ(gap->first, kStart + 200 * kPeriod);
    EXPECT_NEAR(gap->size, 0.81, 1e-9);
    EXPECT_EQ(FindKind(findings, "jump"), nullptr);
  }
}

TEST_F(LinkMotionTest, AFixedFrameThatIsElsewhereOnTfIsToldWithItsSize) {
  LinkMotion links(vehicle_, needed_, options_);
  Drive(&links, kStart, 10);
  Pose mount;
  mount.p.y() = 0.5;
  links.Ingest(Transform("strut", "carrier", kStart, mount), false);
  EXPECT_TRUE(links.warnings().counts().empty());
  mount.p.y() = 0.55;
  for (int i = 3; i < 10; ++i)
    links.Ingest(Transform("strut", "carrier", kStart + i * kPeriod, mount), false);
  const std::vector<std::string> sentences = links.warnings().Sentences(kStart);
  ASSERT_EQ(sentences.size(), 1u);
  for (const char* words :
       {"frame 'carrier' comes from two sources: 7", "the URDF is kept, /tf is ignored",
        "by up to 50 mm", "(0.030 s after the start)", "/tf_static"})
    EXPECT_TRUE(Says(sentences, words)) << sentences[0];
}

TEST_F(LinkMotionTest, AnotherParentThanTheUrdfsIsTold) {
  LinkMotion links(vehicle_, needed_, options_);
  links.Ingest(Transform("odom", "strut", kStart, Pose()), false);
  const std::vector<std::string> sentences = links.warnings().Sentences();
  ASSERT_EQ(sentences.size(), 1u);
  EXPECT_TRUE(Says(sentences, "frame 'strut' has another parent than in the URDF"));
  EXPECT_TRUE(Says(sentences, "the URDF has 'base' (joint 'travel')"));
  EXPECT_TRUE(Says(sentences, "is this the URDF"));
}

TEST_F(LinkMotionTest, ABodyThatMovesUnderAnotherNameIsTold) {
  LinkMotion links(vehicle_, needed_, options_);
  for (int i = 0; i < 400; ++i) {
    const std::int64_t now = kStart + i * kPeriod;
    links.Ingest(Transform("odom", "base_footprint", now, BodyPose(0.01 * i)), false);
    links.Ingest(Joints(now, Travel(0.01 * i)));
  }
  links.Finish();
  const Findings findings = links.MotionFindings("base");
  const Finding* unconnected = FindKind(findings, "unconnected");
  ASSERT_NE(unconnected, nullptr);
  EXPECT_EQ(unconnected->subject, "odom -> base_footprint");
  EXPECT_NE(unconnected->remedy.find("'base_footprint' to 'base'"), std::string::npos);

  LinkMotion connected(vehicle_, needed_, options_);
  Drive(&connected, kStart, 400);
  for (int i = 0; i < 400; ++i)
    connected.Ingest(Transform("odom", "trailer", kStart + i * kPeriod, BodyPose(0.01 * i)), false);
  connected.Finish();
  EXPECT_EQ(FindKind(connected.MotionFindings("odom"), "unconnected"), nullptr);
}

TEST_F(LinkMotionTest, WhatALeaderDoesIsNotSaidOfItsFollowersToo) {
  LinkMotion links(vehicle_, needed_, options_);
  for (int i = 0; i < 400; ++i)
    links.Ingest(Joints(kStart + i * kPeriod, Travel(0.01 * i) + (i == 200 ? 0.02 : 0)));
  links.Finish();
  std::string subjects;
  for (const Finding& finding : links.MotionFindings("base")) subjects += finding.subject + ";";
  EXPECT_EQ(subjects, "base -> strut;");
}

TEST_F(LinkMotionTest, APositionThatNoJointCanHaveIsLeftOut) {
  LinkMotion links(vehicle_, needed_, options_);
  links.Ingest(Joints(kStart, 1e300));
  const std::vector<std::string> sentences = links.warnings().Sentences();
  ASSERT_EQ(sentences.size(), 1u);
  EXPECT_TRUE(Says(sentences, "1e+300")) << sentences[0];
}

TEST_F(LinkMotionTest, FramesWithoutACommonRootAreNamedWithTheOption) {
  for (const bool is_node : {false, true}) {
    options_.is_node = is_node;
    LinkMotion links(vehicle_, needed_, options_);
    links.Ingest(Transform("odom", "base", kStart, Pose()), false);
    links.Ingest(Transform("lab", "strut", kStart, Pose()), false);
    const std::vector<std::string> missing = links.Missing();
    EXPECT_TRUE(Says(missing, "'carrier' is below 'lab', 'arm' and 1 more are below 'odom'"));
    EXPECT_TRUE(Says(missing, is_node ? "~world_frame: lab or odom" : "--world-frame lab or odom"));
  }
}

}  // namespace
}  // namespace cosserat_cable
