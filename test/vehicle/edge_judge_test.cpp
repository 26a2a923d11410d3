#include "cosserat_cable/vehicle/edge_judge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace cosserat_cable {
namespace {

constexpr double kStart = 100;    // [s]
constexpr double kMaxGap = 0.25;  // [s]

std::int64_t Stamp(double seconds) {
  return static_cast<std::int64_t>(std::llround(seconds * 1e9));
}

Pose At(double x, double yaw = 0) {
  Pose pose;
  pose.p.x() = x;
  pose.q = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
  return pose;
}

struct Run {
  double rate;
  double seconds = 10;
  std::function<Pose(double)> pose;                    // of the time of measurement [s]
  std::function<double()> delay = [] { return 0.0; };  // of the stamp [s]
};

EdgeJudge Judged(EdgeRole role, const Run& run) {
  EdgeJudge judge(role, kMaxGap);
  const int count = static_cast<int>(run.seconds * run.rate);
  for (int i = 0; i <= count; ++i) {
    const double t = i / run.rate;
    judge.Add(Stamp(kStart + t + run.delay()), run.pose(t));
  }
  return judge;
}

Findings Found(EdgeRole role, const Run& run) {
  return Judged(role, run).Report("odom -> base_link", "/tf");
}

std::string Kinds(const Findings& findings) {
  std::string kinds;
  for (const Finding& finding : findings) kinds += (kinds.empty() ? "" : " ") + finding.kind;
  return kinds;
}

// ---- What is no fault -------------------------------------------------------------------------

TEST(EdgeJudge, SteadyMotionIsFine) {
  EXPECT_EQ(Kinds(Found(EdgeRole::kBody, {100, 10, [](double t) { return At(10 * t); }})), "");
}

TEST(EdgeJudge, AWheelsCarrierOnABadRoadIsFine) {
  // 10 g at 12 Hz, sampled 200 and 50 times a second.
  const auto hop = [](double t) { return At(0.0176 * std::sin(2 * M_PI * 12 * t)); };
  EXPECT_EQ(Kinds(Found(EdgeRole::kJoint, {200, 10, hop})), "");
  EXPECT_EQ(Kinds(Found(EdgeRole::kJoint, {50, 10, hop})), "");
}

TEST(EdgeJudge, AHardLandingIsFine) {
  // Falls at 4 m/s and is stopped within 20 ms, 20 g, then sways.
  const auto land = [](double t) {
    const double u = t - 5;
    if (u < 0) return At(-4 * u);
    return At(-0.04 * (1 - std::exp(-u / 0.01)) * std::cos(8 * u));
  };
  EXPECT_EQ(Kinds(Found(EdgeRole::kBody, {100, 10, land})), "");
}

TEST(EdgeJudge, EncoderStepsAreFine) {
  constexpr double kStep = 0.2e-3;  // [m]
  const auto quantised = [](double t) {
    return At(kStep * std::round(0.05 * std::sin(2 * M_PI * 1.5 * t) / kStep));
  };
  for (const double rate : {100.0, 500.0, 1000.0})
    EXPECT_EQ(Kinds(Found(EdgeRole::kJoint, {rate, 10, quantised})), "") << rate;
}

TEST(EdgeJudge, UnevenStampsThatAreRightAreFine) {
  // Measured when it was stamped, at uneven times.
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uneven(0, 0.002);
  EdgeJudge judge(EdgeRole::kBody, kMaxGap);
  for (int i = 0; i < 1000; ++i) {
    const double t = 0.01 * i + uneven(random);
    judge.Add(Stamp(kStart + t), At(10 * t));
  }
  EXPECT_EQ(Kinds(judge.Report("", "")), "");
}

TEST(EdgeJudge, LostSamplesOfSteadyMotionAreFine) {
  EdgeJudge judge(EdgeRole::kBody, kMaxGap);
  for (int i = 0; i < 1000; ++i)
    if (i % 7 != 0) judge.Add(Stamp(kStart + 0.01 * i), At(0.1 * i));
  EXPECT_EQ(Kinds(judge.Report("", "")), "");
}

// ---- Faults -----------------------------------------------------------------------------------

TEST(EdgeJudge, StampsOfPublishingAreLate) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> late(0, 0.002);
  const Findings findings = Found(EdgeRole::kBody, {100, 10, [](double t) { return At(10 * t); },
                                                    [&] { return late(random); }});
  ASSERT_EQ(Kinds(findings), "late_stamps");
  // Velocities off by 10 m/s * 2 ms / 10 ms, one after the other.
  EXPECT_GT(findings[0].size, 100);
  EXPECT_NE(findings[0].what.find("late by 0 to 2"), std::string::npos) << findings[0].what;
  EXPECT_NE(findings[0].remedy.find("--smooth"), std::string::npos);
  EXPECT_EQ(findings[0].topic, "/tf");
}

TEST(EdgeJudge, BurstsAreCalledSo) {
  for (const EdgeRole role : {EdgeRole::kBody, EdgeRole::kJoint}) {
    for (const double between : {0.1, 0.2, 0.5}) {
      for (const double apart : {1e-6, 1e-4, 1e-3}) {
        EdgeJudge judge(role, kMaxGap);
        for (int i = 0; i < 500; ++i) {
          const double measured = i * between / 10, sent = (i / 10) * between + (i % 10) * apart;
          judge.Add(Stamp(kStart + sent), At(3 * measured));
        }
        judge.Finish();
        const Findings findings = judge.Report("odom -> base_link", "/tf");
        ASSERT_EQ(Kinds(findings), "bursts") << between << " " << apart;
        EXPECT_NEAR(findings[0].size, between - 9 * apart, 1e-3);
        EXPECT_NE(findings[0].what.find("some 10 samples"), std::string::npos) << findings[0].what;
      }
    }
  }
}

TEST(EdgeJudge, TwoPublishersThatTakeTurnsAreNoBursts) {
  EdgeJudge judge(EdgeRole::kBody, kMaxGap);
  for (int i = 0; i < 1000; ++i) {
    judge.Add(Stamp(kStart + 0.01 * i), At(0.03 * i));
    judge.Add(Stamp(kStart + 0.01 * i + 1e-4), At(0.03 * i));
  }
  EXPECT_EQ(Kinds(judge.Report("", "")), "");
}

TEST(EdgeJudge, LateStampsOfATurnAreToldToo) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> late(0, 0.003);
  const Findings findings = Found(EdgeRole::kBody, {200, 10, [](double t) { return At(0, 2 * t); },
                                                    [&] { return late(random); }});
  ASSERT_EQ(Kinds(findings), "late_stamps");
  EXPECT_EQ(findings[0].unit, "rad/s^2");
}

TEST(EdgeJudge, NoiseIsTold) {
  std::mt19937 random(4);
  std::normal_distribution<double> noise(0, 1e-3);
  const Findings findings =
      Found(EdgeRole::kBody, {100, 10, [&](double t) { return At(2 * t + noise(random)); }});
  ASSERT_EQ(Kinds(findings), "noise");
  // sqrt(6) sigma / h^2 = 24.5 m/s^2; blocks of 32 scatter, and the worst one is told.
  EXPECT_GT(findings[0].size, 20);
  EXPECT_LT(findings[0].size, 40);
}

TEST(EdgeJudge, AJumpIsToldWithTimeAndSize) {
  const Findings findings =
      Found(EdgeRole::kBody, {50, 10, [](double t) { return At(2 * t + (t > 4.999 ? 0.1 : 0)); }});
  ASSERT_EQ(Kinds(findings), "jump");
  EXPECT_EQ(findings[0].count, 1u);
  EXPECT_NEAR(findings[0].size, 0.1, 1e-9);
  EXPECT_EQ(findings[0].worst, Stamp(kStart + 5));
}

TEST(EdgeJudge, OneSampleFarOffIsTold) {
  // At 500 Hz, where only every fourth sample is looked at for jumps.
  const Findings findings =
      Found(EdgeRole::kJoint, {500, 10, [](double t) {
                                 const bool off = std::abs(t - 3.002) < 1e-6;
                                 return At(0.02 * std::sin(6 * t) + (off ? 0.03 : 0));
                               }});
  ASSERT_EQ(Kinds(findings), "outlier");
  EXPECT_EQ(findings[0].worst, Stamp(kStart + 3.002));
  EXPECT_NEAR(findings[0].size, 0.03, 1e-3);
}

// ---- Single samples, however small ------------------------------------------------------------

// A body over a rough road: heave of 1.3 Hz, wheel hop of 12 Hz.
double Rough(double t) {
  return 0.03 * std::sin(2 * M_PI * 1.3 * t) + 2e-3 * std::sin(2 * M_PI * 12 * t + 1) +
         1e-3 * std::sin(2 * M_PI * 7.7 * t);
}

TEST(EdgeJudge, ASmallSpikeOfOneSampleIsToldWithTimeAndSize) {
  for (const EdgeRole role : {EdgeRole::kBody, EdgeRole::kJoint}) {
    for (const int length : {1, 2}) {
      const Findings findings = Found(role, {100, 10, [&](double t) {
                                               const int i = static_cast<int>(std::lround(100 * t));
                                               const bool off = i >= 432 && i < 432 + length;
                                               return At(Rough(t) + (off ? 0.009 : 0));
                                             }});
      ASSERT_EQ(Kinds(findings), "outlier") << length;
      EXPECT_EQ(findings[0].count, 1u);
      EXPECT_EQ(findings[0].first, Stamp(kStart + 4.32));
      EXPECT_NEAR(findings[0].size, 0.009, 0.002);
      EXPECT_NE(findings[0].what.find("and back at once"), std::string::npos) << findings[0].what;
    }
  }
}

TEST(EdgeJudge, SpikesOfARotationAreToldToo) {
  const Findings findings =
      Found(EdgeRole::kJoint, {100, 10, [](double t) {
                                 const int i = static_cast<int>(std::lround(100 * t));
                                 return At(0, 5 * t + (i % 300 == 299 ? 0.05 : 0));
                               }});
  ASSERT_EQ(Kinds(findings), "outlier");
  EXPECT_EQ(findings[0].count, 3u);
  EXPECT_EQ(findings[0].unit, "rad");
  EXPECT_NEAR(findings[0].size, 0.05, 1e-3);
}

TEST(EdgeJudge, ASmallStepIsToldWithTimeAndSize) {
  const Findings findings = Found(
      EdgeRole::kBody, {100, 10, [](double t) { return At(2 * t + (t > 4.999 ? 0.004 : 0)); }});
  ASSERT_EQ(Kinds(findings), "jump");
  EXPECT_EQ(findings[0].worst, Stamp(kStart + 5));
  EXPECT_NEAR(findings[0].size, 0.004, 1e-6);
}

TEST(EdgeJudge, BlowsAndStartsAreNoSpikes) {
  // A bump stop turns the motion round within 20 ms; a joint starts and stops at once.
  const auto blow = [](double t) {
    const double u = t - 5;
    if (u < -0.01) return At(u);
    return At(u < 0.01 ? -0.01 + 50 * (u * u - 1e-4) : -u);
  };
  const auto starts = [](double t) { return At(t < 5.003 ? 0 : std::min(0.1 * (t - 5.003), 0.1)); };
  for (const EdgeRole role : {EdgeRole::kBody, EdgeRole::kJoint}) {
    for (const double rate : {50.0, 100.0, 200.0, 500.0}) {
      EXPECT_EQ(Kinds(Found(role, {rate, 10, blow})), "") << rate;
      EXPECT_EQ(Kinds(Found(role, {rate, 10, starts})), "") << rate;
    }
  }
}

TEST(EdgeJudge, StepsOfACoarseEncoderAreNoJumpsAndNoOutliers) {
  std::mt19937 random(8);
  std::normal_distribution<double> noise(0, 2e-4);
  for (const double step : {0.001, 0.002}) {
    const auto coarse = [&](double t) {
      const double x = 0.03 * std::sin(2 * M_PI * 0.1 * t) + noise(random);
      return At(step * std::round(x / step), 3 * step * std::round(x / step));
    };
    for (const double rate : {50.0, 100.0, 500.0}) {
      const std::string kinds = Kinds(Found(EdgeRole::kJoint, {rate, 30, coarse}));
      EXPECT_TRUE(kinds.empty() || kinds == "quantisation") << kinds << " " << step << " " << rate;
    }
  }
}

TEST(EdgeJudge, ACoarseSensorIsCalledQuantised) {
  std::mt19937 random(9);
  std::normal_distribution<double> noise(0, 1);
  for (const EdgeRole role : {EdgeRole::kBody, EdgeRole::kJoint}) {
    for (const double rate : {50.0, 100.0, 200.0, 500.0}) {
      for (const double millimetres : {1.0, 2.0, 5.0}) {
        // 1 mm and 0.1 deg, and coarser: slowly moving, around one step, and at rest but for noise.
        const double step = 1e-3 * millimetres, turn = 0.1 * millimetres * M_PI / 180;
        const auto on_grid = [&](double x) {
          return At(step * std::round(x), turn * std::round(x));
        };
        const std::vector<std::function<Pose(double)>> motions = {
            [&](double t) { return on_grid(30 * std::sin(2 * M_PI * 0.2 * t)); },
            [&](double t) { return on_grid(30 * std::sin(2 * M_PI * 2 * t)); },
            [&](double t) { return on_grid(0.3 + 0.3 * std::sin(2 * M_PI * 0.2 * t)); },
            [&](double) { return on_grid(0.4 + 0.1 * noise(random)); }};
        for (std::size_t i = 0; i < motions.size(); ++i) {
          const std::string kinds = Kinds(Found(role, {rate, 20, motions[i]}));
          EXPECT_TRUE(kinds.empty() || kinds == "quantisation")
              << kinds << ", motion " << i << " at " << rate << " Hz in " << millimetres << " mm";
        }
      }
    }
  }
}

TEST(EdgeJudge, QuantisationIsToldWithItsStepAndWhatTakesItOut) {
  const Findings findings =
      Found(EdgeRole::kBody,
            {100, 20, [](double t) { return At(2e-3 * std::round(15 * std::sin(12 * t))); }});
  ASSERT_EQ(Kinds(findings), "quantisation");
  EXPECT_NEAR(findings[0].size, 2e-3, 1e-9);
  EXPECT_NE(findings[0].what.find("in steps of 2 mm"), std::string::npos) << findings[0].what;
  EXPECT_NE(findings[0].remedy.find("--smooth "), std::string::npos) << findings[0].remedy;
}

TEST(EdgeJudge, AnglesThatAreQuantisedOneByOneAreSeen) {
  // Roll, pitch and yaw in steps of 0.1 deg, as an attitude sensor has them.
  const auto rounded = [](double angle) {
    constexpr double kStep = 0.1 * M_PI / 180;
    return kStep * std::round(angle / kStep);
  };
  const auto attitude = [&](double t) {
    Pose pose = At(3 * t);
    pose.q = Eigen::AngleAxisd(rounded(0.2 * t), Eigen::Vector3d::UnitZ()) *
             Eigen::AngleAxisd(rounded(0.02 * std::sin(9 * t)), Eigen::Vector3d::UnitY()) *
             Eigen::AngleAxisd(rounded(0.03 * std::sin(8 * t)), Eigen::Vector3d::UnitX());
    return pose;
  };
  const Findings findings = Found(EdgeRole::kBody, {100, 10, attitude});
  ASSERT_EQ(Kinds(findings), "quantisation");
  EXPECT_NE(findings[0].what.find("in steps of 0.1 deg"), std::string::npos) << findings[0].what;
}

TEST(EdgeJudge, AJumpOfACoarseSensorIsStillAJump) {
  const Findings findings =
      Found(EdgeRole::kBody, {50, 20, [](double t) {
                                const double x = 0.03 * std::sin(1.3 * t) + (t > 7.999 ? 0.1 : 0);
                                return At(1e-3 * std::round(1e3 * x));
                              }});
  ASSERT_FALSE(findings.empty());
  EXPECT_EQ(findings[0].kind, "jump");
  EXPECT_EQ(findings[0].count, 1u);
  EXPECT_EQ(findings[0].worst, Stamp(kStart + 8));
  // Off by one step at most.
  EXPECT_NEAR(findings[0].size, 0.1, 1.1e-3);
}

TEST(EdgeJudge, AUniformMotionIsNotQuantised) {
  // It stands still, goes off, and jumps by a step and a half of what looks like its grid.
  const auto goes = [](double t) { return At((t < 3 ? 0 : t - 3) + (t > 6.999 ? 0.015 : 0)); };
  EXPECT_EQ(Kinds(Found(EdgeRole::kBody, {100, 10, goes})), "jump");
}

// ---- The first samples and the last ones ------------------------------------------------------

// 10 s of driving over a rough road; `wrong`: of the first samples, or of the last ones.
template <class Wrong>
Findings BadEnd(EdgeRole role, double rate, int samples, bool at_the_end, const Wrong& wrong) {
  EdgeJudge judge(role, kMaxGap);
  const int count = static_cast<int>(10 * rate);
  for (int i = 0; i < count; ++i) {
    const double t = i / rate;
    const Pose right = At(5 + 3 * t + Rough(t), 0.3);
    const bool is_wrong = at_the_end ? i >= count - samples : i < samples;
    judge.Add(Stamp(kStart + t), is_wrong ? wrong(right) : right);
  }
  judge.Finish();
  return judge.Report("odom -> base_link", "/tf");
}

TEST(EdgeJudge, TheFirstAndLastSamplesAreJudgedToo) {
  const auto zeros = [](const Pose&) { return Pose(); };
  const auto off = [](Pose pose) {
    pose.p.y() += 0.03;
    return pose;
  };
  const auto turned = [](Pose pose) {
    pose.q = Eigen::Quaterniond::Identity();
    return pose;
  };
  for (const EdgeRole role : {EdgeRole::kBody, EdgeRole::kJoint}) {
    for (const double rate : {50.0, 100.0, 200.0, 500.0}) {
      for (const int samples : {1, 2, 3}) {
        for (const bool at_the_end : {false, true}) {
          const double t = at_the_end ? 10 - samples / rate : 0;
          for (const auto& findings : {BadEnd(role, rate, samples, at_the_end, zeros),
                                       BadEnd(role, rate, samples, at_the_end, off),
                                       BadEnd(role, rate, samples, at_the_end, turned)}) {
            ASSERT_EQ(Kinds(findings), "outlier") << rate << " " << samples << " " << at_the_end;
            EXPECT_EQ(findings[0].worst, Stamp(kStart + t));
            EXPECT_NE(findings[0].what.find(at_the_end ? "ends with" : "begins with"),
                      std::string::npos);
            EXPECT_NE(findings[0].remedy.find(at_the_end ? "--duration" : "--start"),
                      std::string::npos);
          }
          EXPECT_NEAR(BadEnd(role, rate, samples, at_the_end, off)[0].size, 0.03, 0.005);
        }
      }
    }
  }
}

TEST(EdgeJudge, AMotionMayBeginAndEndAtOnce) {
  for (const EdgeRole role : {EdgeRole::kBody, EdgeRole::kJoint}) {
    for (const double rate : {50.0, 100.0, 500.0}) {
      for (const double part : {0.0, 0.3, 0.6, 0.9}) {
        // It is set in motion within the first interval, and stopped within the last one.
        EdgeJudge judge(role, kMaxGap);
        const double begin = part / rate, end = 10 - part / rate;
        for (int i = 0; i <= static_cast<int>(10 * rate); ++i) {
          const double t = i / rate;
          judge.Add(Stamp(kStart + t), At(std::clamp(t, begin, end)));
        }
        judge.Finish();
        EXPECT_EQ(Kinds(judge.Report("", "")), "") << rate << " " << part;
      }
    }
  }
}

// ---- Vibrations -------------------------------------------------------------------------------

TEST(EdgeJudge, FastVibrationsAreNoNoiseAndNoJumps) {
  for (const EdgeRole role : {EdgeRole::kBody, EdgeRole::kJoint}) {
    for (const double rate : {100.0, 125.0, 150.0, 200.0, 500.0}) {
      for (const double f : {20.0, 30.0, 35.0, 40.0}) {
        const auto sine = [&](double t) { return At(3 * t + 3e-3 * std::sin(2 * M_PI * f * t)); };
        const auto turns = [&](double t) { return At(0, 6e-3 * std::sin(2 * M_PI * f * t)); };
        EXPECT_EQ(Kinds(Found(role, {rate, 10, sine})), "") << f << " at " << rate;
        EXPECT_EQ(Kinds(Found(role, {rate, 10, turns})), "") << f << " at " << rate;
      }
      // From 10 to 40 Hz within 20 s, and two at once.
      const auto chirp = [](double t) {
        return At(2e-3 * std::sin(2 * M_PI * (10 * t + 0.75 * t * t)));
      };
      const auto both = [](double t) {
        return At(1e-3 * std::sin(2 * M_PI * 31 * t) + 1e-3 * std::sin(2 * M_PI * 37 * t));
      };
      EXPECT_EQ(Kinds(Found(role, {rate, 20, chirp})), "") << rate;
      EXPECT_EQ(Kinds(Found(role, {rate, 10, both})), "") << rate;
    }
  }
}

TEST(EdgeJudge, SmoothingThatIsAdvisedKeepsAVibration) {
  // 35 Hz for the first 5 s, then noise.
  std::mt19937 random(10);
  std::normal_distribution<double> noise(0, 1e-3);
  const auto both = [&](double t) {
    return At(t < 5 ? 3e-3 * std::sin(2 * M_PI * 35 * t) : noise(random));
  };
  const Findings slow = Found(EdgeRole::kBody, {100, 10, both});
  ASSERT_EQ(Kinds(slow), "noise");
  EXPECT_NE(slow[0].remedy.find("vibrates at 35 Hz, which --smooth HZ would take out too"),
            std::string::npos)
      << slow[0].remedy;
  const Findings fast = Found(EdgeRole::kBody, {500, 10, both});
  ASSERT_EQ(Kinds(fast), "noise");
  EXPECT_NE(fast[0].remedy.find("--smooth 5"), std::string::npos) << fast[0].remedy;
  EXPECT_NE(fast[0].remedy.find("keeps that"), std::string::npos) << fast[0].remedy;
}

TEST(EdgeJudge, ExcursionsOfAnyLengthAreTold) {
  for (const EdgeRole role : {EdgeRole::kBody, EdgeRole::kJoint})
    for (int length = 1; length <= 10; ++length) {
      const double size = role == EdgeRole::kBody ? 0.01 : 0.03;
      const Findings findings = Found(role, {200, 10, [&](double t) {
                                               const int i = static_cast<int>(std::lround(200 * t));
                                               const bool off = i >= 832 && i < 832 + length;
                                               return At(Rough(t) + (off ? size : 0));
                                             }});
      ASSERT_FALSE(findings.empty()) << length;
      EXPECT_NEAR(findings[0].size, size, 0.1 * size) << length;
    }
}

TEST(EdgeJudge, MillimetresForMetresAreTold) {
  for (const double rate : {20, 50, 200}) {
    // 5 m/s, and a heave of 20 mm at 1.5 Hz.
    const auto ride = [](double t) { return At(5 * t + 0.02 * std::sin(2 * M_PI * 1.5 * t)); };
    const auto heave = [](double t) { return At(20 * std::sin(2 * M_PI * 1.5 * t)); };
    EXPECT_EQ(Kinds(Found(EdgeRole::kBody, {rate, 10, ride})), "");
    const auto ride_in_mm = [&](double t) { return At(1e3 * ride(t).p.x()); };
    for (const auto& wrong : std::vector<std::function<Pose(double)>>{ride_in_mm, heave}) {
      const Findings findings = Found(EdgeRole::kBody, {rate, 10, wrong});
      ASSERT_FALSE(findings.empty()) << rate;
      EXPECT_EQ(findings[0].kind, "unit") << rate;
      EXPECT_NE(findings[0].remedy.find("millimetres"), std::string::npos);
    }
  }
}

TEST(EdgeJudge, HolesAreNoBadStamps) {
  EdgeJudge judge(EdgeRole::kJoint, kMaxGap);
  for (int i = 0; i < 1000; ++i)
    if (i < 500 || i > 505) judge.Add(Stamp(kStart + 0.005 * i), At(Rough(0.005 * i)));
  EXPECT_EQ(Kinds(judge.Report("", "")), "");
}

TEST(EdgeJudge, NoiseHasNoSpikes) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, 3e-4);
  const Findings findings =
      Found(EdgeRole::kJoint, {100, 600, [&](double t) { return At(Rough(t) + noise(random)); }});
  EXPECT_EQ(Kinds(findings), "");
}

TEST(EdgeJudge, OneBadStampIsCalledSo) {
  for (const double off : {-0.004, 0.004, 0.007}) {
    EdgeJudge judge(EdgeRole::kBody, kMaxGap);
    for (int i = 0; i < 1000; ++i) {
      const double t = 0.01 * i;
      judge.Add(Stamp(kStart + t + (i == 500 ? off : 0)), At(10 * t));
    }
    const Findings findings = judge.Report("", "");
    ASSERT_EQ(Kinds(findings), "bad_stamp") << off;
    EXPECT_EQ(findings[0].count, 1u);
    EXPECT_EQ(findings[0].worst, Stamp(kStart + 5 + off));
    EXPECT_NEAR(findings[0].size, off, 1e-4);
  }
}

TEST(EdgeJudge, TwoSamplesNearlyAtOneTimeAreNoJump) {
  EdgeJudge judge(EdgeRole::kBody, kMaxGap);
  for (int i = 0; i < 1000; ++i) {
    judge.Add(Stamp(kStart + 0.01 * i), At(0.1 * i));
    if (i == 500) judge.Add(Stamp(kStart + 0.01 * i) + 1, At(0.1 * i + 0.05));
  }
  EXPECT_EQ(Kinds(judge.Report("", "")), "");
}

// ---- Corrections ------------------------------------------------------------------------------

TEST(EdgeJudge, ACorrectionIsCorrectedAtAnyRate) {
  const auto corrected = [](double t) { return At(7 + (t > 4.95 ? 0.1 : 0)); };
  for (const double rate : {1.0, 10.0, 50.0}) {
    const EdgeJudge judge = Judged(EdgeRole::kAboveVehicle, {rate, 10, corrected});
    EXPECT_TRUE(judge.IsCorrected()) << rate;
    EXPECT_EQ(Kinds(judge.Report("", "")), "jump") << rate;
  }
}

TEST(EdgeJudge, ACorrectionOfTheHeadingCountsToo) {
  EXPECT_TRUE(Judged(EdgeRole::kAboveVehicle,
                     {10, 10, [](double t) { return At(0, t > 4.95 ? 0.005 : 0); }})
                  .IsCorrected());
}

TEST(EdgeJudge, APlatformDoesNotMoveByJumps) {
  const auto ship = [](double t) { return At(5 * t + 0.5 * std::sin(t), 0.1 * std::sin(0.8 * t)); };
  EXPECT_FALSE(Judged(EdgeRole::kAboveVehicle, {10, 20, ship}).IsCorrected());
  EXPECT_FALSE(
      Judged(EdgeRole::kAboveVehicle, {10, 20, [](double) { return At(3); }}).IsCorrected());
}

}  // namespace
}  // namespace cosserat_cable
