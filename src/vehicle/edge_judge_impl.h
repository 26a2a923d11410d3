// What an EdgeJudge keeps: how samples come in is in edge_judge.cpp, what is told of them in
// edge_findings.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "burst_judge.h"
#include "cosserat_cable/input/number_text.h"
#include "cosserat_cable/vehicle/edge_judge.h"
#include "course_judge.h"
#include "motion_channel.h"
#include "outlier_judge.h"
#include "slide_judge.h"
#include "step_grid.h"

namespace cosserat_cable {

struct EdgeJudge::Impl {
  Impl(EdgeRole the_role, double max_gap);

  /// Samples closer together than this part of the mean interval are no motion: the curve leaves
  /// one of them out, see PoseCurve.
  static constexpr double kTooClose = 0.25;

  EdgeRole role;
  double longest;
  MotionChannel translation, rotation;
  StepGrid angles;  ///< roll, pitch and yaw [rad]
  OutlierJudge singles;
  CourseJudge course;
  BurstJudge bursts;
  SlideJudge translation_slides, rotation_slides;  ///< of what is above the vehicle
  bool moves = false;

  struct Sample {
    std::int64_t stamp = 0;
    Pose X;
  };
  bool has_last = false;
  Sample last, last_kept;
  double period_sum = 0;
  std::uint64_t periods = 0;
  int stride = 0;               // 0: not known yet
  std::vector<Sample> waiting;  // until it is
  int since_kept = 0;

  static OutlierLimits LimitsOfOne(EdgeRole role, bool translation);
  static double Seconds(std::int64_t from, std::int64_t to) {
    return static_cast<double>(to - from) * 1e-9;
  }
  double period() const { return periods > 0 ? period_sum / static_cast<double>(periods) : 0; }
  void Add(const Sample& sample);
  void Keep(const Sample& sample);
  void KeepWaiting();

  /// The channel in which the tally is the farthest beyond `limit`; null where there is none.
  template <class Count, class Excess>
  const MotionChannel* Worse(const Count& count, const Excess& excess) const {
    const MotionChannel* worse = nullptr;
    for (const MotionChannel* channel : {&translation, &rotation})
      if (count(*channel) && (!worse || excess(*channel) > excess(*worse))) worse = channel;
    return worse;
  }
  const char* Unit(const MotionChannel* channel) const {
    return channel == &translation ? "m" : "rad";
  }
  /// Whether what makes all samples rough explains this event too.
  bool IsExplained(const MotionChannel& channel, double acceleration) const;
  /// Whether single samples explain so many events.
  bool IsSingle(const MotionChannel& channel, std::uint64_t events) const;
  const OutlierJudge::Found& Singles(const MotionChannel& channel) const {
    return &channel == &translation ? singles.translation() : singles.rotation();
  }
  /// Turns about one axis have a grid of their own, those about several have one in their angles.
  const StepGrid& Grid(const MotionChannel& channel) const {
    return &channel == &rotation && angles.Step() > 0 ? angles : channel.grid();
  }
  /// The step that a coarse sensor or rounding leaves; 0: none. Corrections may have one size too.
  double Quantum(const MotionChannel& channel) const {
    return role == EdgeRole::kAboveVehicle ? 0 : Grid(channel).Step();
  }
  /// A joint's steps of one size are those of its encoder; so are outliers that are no larger.
  bool IsEncoder(const MotionChannel& channel) const;
  bool IsEncoderFlips(const MotionChannel& channel) const;
  /// Jumps that are no steps of a coarse sensor.
  MotionChannel::Tally Jumps(const MotionChannel& channel) const;
  /// Whether the noise is that of values which toggle between two steps.
  bool IsQuantisation(const MotionChannel& channel) const;
  /// Whether it vibrates fast, by more than its steps may look like.
  bool Vibrates(const MotionChannel& channel) const;
  double Interval() const { return period() * std::max(stride, 1); }
  const SlideJudge& Slides(const MotionChannel& channel) const {
    return &channel == &translation ? translation_slides : rotation_slides;
  }
  /// Whether it rests but for short slides of this channel.
  bool MovesBySlides(const MotionChannel& channel) const {
    return Slides(channel).slides().count > 0 && !translation_slides.travels() &&
           !rotation_slides.travels();
  }
  /// More than once: one block may be an event.
  bool IsRough(const MotionChannel& channel) const { return channel.rough().count > 1; }
  /// How to smooth noise of so much acceleration [/s^2].
  std::string SmoothText(const MotionChannel& channel, double noise) const;
  /// Of a channel's events, or of single samples.
  template <class Tally>
  Finding Start(const char* kind, const Tally& tally) const;
  std::string SizeText(const MotionChannel* channel, double size) const {
    return channel == &rotation ? FormatRounded(size * 180 / M_PI) + " deg" : FormatLength(size);
  }
  void ReportOutliers(Findings* findings) const;
  void ReportEnds(Findings* findings) const;
  void ReportStamps(Findings* findings) const;
  void ReportJump(const MotionChannel* channel, Finding finding, double limit, double acceleration,
                  Findings* findings) const;
  void ReportJumps(Findings* findings) const;
  void ReportAccelerations(Findings* findings) const;
  void ReportLateness(Findings* findings) const;
  void ReportNoise(Findings* findings) const;
  void ReportQuantisation(Findings* findings) const;
};

}  // namespace cosserat_cable
