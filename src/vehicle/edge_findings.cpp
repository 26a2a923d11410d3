// What an EdgeJudge tells of its samples.
#include <algorithm>
#include <cmath>

#include "cosserat_cable/input/number_text.h"
#include "edge_judge_impl.h"

namespace cosserat_cable {
namespace {

// A part of the blocks that is smaller is an event and no habit of the recording.
constexpr std::uint64_t kLeastBlocks = 2;
constexpr double kLeastShare = 0.05;
// An event that is no larger than this, in the largest acceleration of rough samples, is one of
// them.
constexpr double kFarBeyond = 3;
// An outlier or a bad stamp makes up to so many large accelerations and jumps.
constexpr std::uint64_t kEventsOfOne = 4;
// Of an encoder's step.
constexpr double kFlip = 1.5;
// A value that changes by one step of its grid and back with each sample accelerates by so much, in
// steps per interval squared.
constexpr double kToggles = 2;
// Smoothing takes nothing off a motion that is slower than its cutoff by this factor.
constexpr double kKeeps = 1.5;
// What smoothing may leave of the noise [m/s^2], [rad/s^2]: little beside gravity.
constexpr double kTolerableNoise = 0.5;

bool IsHabit(const MotionChannel::Tally& tally, std::uint64_t blocks) {
  return tally.count >= kLeastBlocks &&
         static_cast<double>(tally.count) >= kLeastShare * static_cast<double>(blocks);
}

// A frequency as people write it, at or below `value` [Hz].
double RoundFrequency(double value) {
  constexpr double kNearly = 1.02;  // 19.9 is 20
  const double decade = std::pow(10, std::floor(std::log10(kNearly * value)));
  const double leading = kNearly * value / decade;
  return decade * (leading >= 5 ? 5 : leading >= 2 ? 2 : 1);
}

}  // namespace

Finding EdgeJudge::Corrections(const std::string& subject, const std::string& topic) const {
  const MotionChannel* channel =
      impl_->Worse([](const auto& c) { return c.MovesByJumps(); },
                   [](const auto& c) { return c.largest_step().size / c.limits().jump; });
  Finding finding;
  if (channel) {
    finding = impl_->Start("jump", channel->largest_step());
    finding.first = finding.worst;
    finding.what = "moves by steps, of up to " + impl_->SizeText(channel, finding.size);
    finding.limit = channel->limits().jump;
  } else if ((channel =
                  impl_->Worse([this](const auto& c) { return impl_->MovesBySlides(c); },
                               [this](const auto& c) { return impl_->Slides(c).slides().size; }))) {
    const SlideJudge::Slides& slides = impl_->Slides(*channel).slides();
    finding = impl_->Start("slide", slides);
    finding.what =
        (slides.count == 1 ? std::string("slides by ")
                           : "slides " + std::to_string(slides.count) + " times, by up to ") +
        impl_->SizeText(channel, slides.size) + " within " + FormatRounded(slides.duration, 2) +
        " s, and rests otherwise";
  }
  finding.limit = channel->limits().jump;
  finding.unit = impl_->Unit(channel);
  finding.subject = subject;
  finding.topic = topic;
  return finding;
}

template <class Tally>
Finding EdgeJudge::Impl::Start(const char* kind, const Tally& tally) const {
  Finding finding;
  finding.kind = kind;
  finding.count = tally.count;
  finding.first = tally.first;
  finding.worst = tally.worst;
  finding.size = tally.size;
  return finding;
}

bool EdgeJudge::Impl::IsSingle(const MotionChannel& channel, std::uint64_t events) const {
  const OutlierJudge::Found& found = Singles(channel);
  return events <= kEventsOfOne * (found.outliers.count + found.stamps.count + found.begins.count +
                                   found.ends.count);
}

bool EdgeJudge::Impl::IsExplained(const MotionChannel& channel, double acceleration) const {
  double usual = 0;
  for (const MotionChannel::Tally* rough : {&channel.lateness(), &channel.noise()})
    if (IsHabit(*rough, channel.blocks())) usual = std::max(usual, rough->acceleration);
  return acceleration < kFarBeyond * usual;
}

bool EdgeJudge::Impl::IsEncoder(const MotionChannel& channel) const {
  const OutlierJudge::Found& found = Singles(channel);
  return (role == EdgeRole::kJoint && found.HasQuantum()) ||
         found.steps.size < kFlip * Quantum(channel);
}

bool EdgeJudge::Impl::IsEncoderFlips(const MotionChannel& channel) const {
  const OutlierJudge::Found& found = Singles(channel);
  return (IsEncoder(channel) && found.outliers.size < kFlip * found.steps.size) ||
         found.outliers.size < kFlip * Quantum(channel);
}

MotionChannel::Tally EdgeJudge::Impl::Jumps(const MotionChannel& channel) const {
  MotionChannel::Tally jumps = channel.jumps();
  if (Quantum(channel) == 0) jumps.Add(channel.grid_jumps());
  return jumps;
}

bool EdgeJudge::Impl::IsQuantisation(const MotionChannel& channel) const {
  return channel.noise().size < kToggles * Quantum(channel) / (Interval() * Interval());
}

bool EdgeJudge::Impl::Vibrates(const MotionChannel& channel) const {
  return IsHabit(channel.vibration(), channel.blocks()) &&
         channel.vibration().size > kToggles * Quantum(channel) / (Interval() * Interval());
}

void EdgeJudge::Impl::ReportJumps(Findings* findings) const {
  const MotionChannel* channel = Worse(
      [this](const auto& c) {
        const MotionChannel::Tally jumps = Jumps(c);
        return jumps.count > 0 && !IsSingle(c, jumps.count) && !IsExplained(c, jumps.acceleration);
      },
      [this](const auto& c) { return Jumps(c).size / c.limits().jump; });
  if (channel) {
    const MotionChannel::Tally jumps = Jumps(*channel);
    ReportJump(channel, Start("jump", jumps), channel->limits().jump, jumps.acceleration, findings);
    return;
  }
  // Smaller ones that stand out all the same.
  channel = Worse([this](const auto& c) { return Singles(c).steps.count > 0 && !IsEncoder(c); },
                  [this](const auto& c) { return Singles(c).steps.size / c.limits().jump; });
  if (!channel) return;
  const OutlierJudge::Tally& steps = Singles(*channel).steps;
  ReportJump(channel, Start("jump", steps), LimitsOfOne(role, channel == &translation).size,
             steps.acceleration, findings);
}

void EdgeJudge::Impl::ReportJump(const MotionChannel* channel, Finding finding, double limit,
                                 double acceleration, Findings* findings) const {
  finding.limit = limit;
  finding.unit = Unit(channel);
  const std::string size = SizeText(channel, finding.size);
  finding.what = finding.count == 1
                     ? "jumps by " + size
                     : "jumps " + std::to_string(finding.count) + " times, by up to " + size;
  finding.what +=
      " from one sample to the next (" + FormatRounded(acceleration) + " " + finding.unit + "/s^2)";
  finding.remedy =
      role == EdgeRole::kJoint
          ? "was its encoder reset, or are these outliers? cut the recording there (--start, "
            "--duration), or use --smooth HZ"
          : "is the pose reset, or corrected by a localisation? record a frame that moves smoothly";
  findings->push_back(std::move(finding));
}

void EdgeJudge::Impl::ReportOutliers(Findings* findings) const {
  const MotionChannel* channel =
      Worse([this](const auto& c) { return Singles(c).outliers.count > 0 && !IsEncoderFlips(c); },
            [this](const auto& c) { return Singles(c).outliers.size / c.limits().jump; });
  if (!channel) return;
  const OutlierJudge::Tally& outliers = Singles(*channel).outliers;
  Finding finding = Start("outlier", outliers);
  finding.limit = LimitsOfOne(role, channel == &translation).size;
  finding.unit = Unit(channel);
  const std::string size = SizeText(channel, finding.size);
  finding.what = finding.count == 1 ? "jumps by " + size + " and back at once"
                                    : "jumps " + std::to_string(finding.count) +
                                          " times and back at once, by up to " + size;
  finding.what += " (" + FormatRounded(outliers.acceleration) + " " + finding.unit +
                  "/s^2; the motion around it explains " + SizeText(channel, outliers.usual) + ")";
  finding.remedy =
      "is this an outlier of what measured it? take such samples out of the recording: a link does "
      "not move so, and --smooth HZ only spreads it";
  findings->push_back(std::move(finding));
}

void EdgeJudge::Impl::ReportEnds(Findings* findings) const {
  for (const bool begins : {true, false}) {
    const auto tally = [&](const MotionChannel& c) {
      return begins ? Singles(c).begins : Singles(c).ends;
    };
    const MotionChannel* channel =
        Worse([&](const auto& c) { return tally(c).count > 0; },
              [&](const auto& c) { return tally(c).size / c.limits().jump; });
    if (!channel) continue;
    const OutlierJudge::Tally found = tally(*channel);
    Finding finding = Start("outlier", found);
    finding.limit = LimitsOfOne(role, channel == &translation).size;
    finding.unit = Unit(channel);
    finding.what = std::string(begins ? "begins" : "ends") + " with " +
                   (found.length == 1 ? "a sample that is "
                                      : std::to_string(found.length) + " samples that are ") +
                   SizeText(channel, finding.size) + " off the course of the others";
    finding.remedy =
        begins ? "is it published before its pose is known? begin behind it by --start, or take "
                 "this out of the recording"
               : "does its publisher end with zeros? end before it by --duration, or take this out "
                 "of the recording";
    findings->push_back(std::move(finding));
  }
}

void EdgeJudge::Impl::ReportStamps(Findings* findings) const {
  const MotionChannel* channel =
      Worse([this](const auto& c) { return Singles(c).stamps.count > 0; },
            [this](const auto& c) { return Singles(c).stamps.size / c.limits().jump; });
  if (!channel) return;
  const OutlierJudge::Tally& stamps = Singles(*channel).stamps;
  Finding finding = Start("bad_stamp", stamps);
  finding.size = stamps.lateness;
  finding.limit = kTooClose * period();
  finding.unit = "s";
  finding.what = finding.count == 1
                     ? "has a sample with a bad stamp"
                     : "has " + std::to_string(finding.count) + " samples with bad stamps";
  finding.what += ", " + FormatRounded(1e3 * std::abs(stamps.lateness)) + " ms too " +
                  (stamps.lateness > 0 ? "late" : "early") + ": it is " +
                  SizeText(channel, stamps.size) + " off there, and on its way at an even time";
  finding.remedy = "stamp poses when they are measured, or take such samples out of the recording";
  findings->push_back(std::move(finding));
}

void EdgeJudge::Impl::ReportAccelerations(Findings* findings) const {
  // A jump is an acceleration too: it is told once.
  const MotionChannel* channel = Worse(
      [this](const auto& c) {
        return c.accelerations().count > 0 && Jumps(c).count == 0 && Singles(c).steps.count == 0 &&
               !IsSingle(c, c.accelerations().count) &&
               !IsExplained(c, c.accelerations().acceleration);
      },
      [](const auto& c) { return c.accelerations().size / c.limits().acceleration; });
  if (!channel) return;
  Finding finding = Start("acceleration", channel->accelerations());
  finding.limit = channel->limits().acceleration;
  finding.unit = Unit(channel) + std::string("/s^2");
  finding.what = "accelerates by up to " + FormatRounded(finding.size) + " " + finding.unit +
                 " between samples (" + std::to_string(finding.count) + " times more than " +
                 Printed("%g)", finding.limit);
  finding.remedy =
      "are these outliers, or do two publishers disagree? take them out of the recording, or "
      "--smooth HZ";
  findings->push_back(std::move(finding));
}

void EdgeJudge::Impl::ReportLateness(Findings* findings) const {
  const MotionChannel* channel =
      Worse([](const auto& c) { return IsHabit(c.lateness(), c.blocks()); },
            [](const auto& c) { return c.lateness().size / c.limits().lateness; });
  if (!channel) return;
  Finding finding = Start("late_stamps", channel->lateness());
  finding.limit = channel->limits().lateness;
  finding.unit = Unit(channel) + std::string("/s^2");
  finding.what = "accelerates by up to " + FormatRounded(channel->lateness().acceleration) + " " +
                 finding.unit + " between samples (" + FormatRounded(finding.size) +
                 " rms), and is smooth where its samples are counted out evenly: its stamps are "
                 "late by 0 to " +
                 FormatRounded(1e3 * channel->worst_lateness(), 2) + " ms";
  finding.remedy = "stamp poses when they are measured, or use --smooth " +
                   Printed("%g", RoundFrequency(0.2 / period())) +
                   ", which puts them back on a steady clock";
  findings->push_back(std::move(finding));
}

std::string EdgeJudge::Impl::SmoothText(const MotionChannel& channel, double noise) const {
  // White noise of positions, sigma^2 = a^2 h^4 / 6 in each sample, below a cutoff f:
  //   a_left = (2 pi)^2 f^2.5 sigma sqrt(2 h / 5).
  const double h = Interval();
  const double sigma = noise * h * h / std::sqrt(6.0);
  const double all =
      std::pow(kTolerableNoise / (4 * M_PI * M_PI * sigma * std::sqrt(0.4 * h)), 0.4);
  const double most = 0.2 / period();
  const double cutoff = RoundFrequency(std::min(all, most));
  const double motion = channel.vibration_frequency();
  if (cutoff >= kKeeps * motion || !Vibrates(channel))
    return "--smooth " + Printed("%g", cutoff) + " leaves little of it";
  const std::string moves = "it also vibrates at " + FormatRounded(motion, 2) + " Hz";
  if (kKeeps * motion > most)
    return moves + ", which --smooth HZ would take out too: measure it with less noise, or faster";
  return moves + ": --smooth " + FormatRounded(kKeeps * motion, 2) + " keeps that";
}

void EdgeJudge::Impl::ReportNoise(Findings* findings) const {
  const MotionChannel* channel =
      Worse([this](const auto& c) { return IsHabit(c.noise(), c.blocks()) && !IsQuantisation(c); },
            [](const auto& c) { return c.noise().size / c.limits().noise; });
  if (!channel) return;
  Finding finding = Start("noise", channel->noise());
  finding.limit = channel->limits().noise;
  finding.unit = Unit(channel) + std::string("/s^2");
  finding.what = "accelerates by " + FormatRounded(finding.size) + " " + finding.unit +
                 " rms back and forth from sample to sample";
  finding.remedy =
      "is it noise, are its stamps late, or does it vibrate faster than it was sampled? " +
      SmoothText(*channel, finding.size);
  findings->push_back(std::move(finding));
}

// Of a coarse sensor, where cables feel its steps.
void EdgeJudge::Impl::ReportQuantisation(Findings* findings) const {
  const auto matters = [this](const auto& c) {
    if (Quantum(c) == 0) return false;
    return (IsHabit(c.noise(), c.blocks()) && IsQuantisation(c)) || c.grid_jumps().count > 0;
  };
  const MotionChannel* channel =
      Worse(matters, [this](const auto& c) { return Quantum(c) / c.limits().jump; });
  if (!channel) return;
  const bool all_the_time = IsHabit(channel->noise(), channel->blocks());
  Finding finding = Start("quantisation", all_the_time ? channel->noise() : channel->grid_jumps());
  const double acceleration = all_the_time ? finding.size : channel->grid_jumps().acceleration;
  finding.size = Grid(*channel).LargestStep();
  finding.limit = channel->limits().noise * Interval() * Interval() / kToggles;
  finding.unit = Unit(channel);
  finding.what = "moves in steps of " + SizeText(channel, finding.size) +
                 ": it is quantised, and accelerates by " + FormatRounded(acceleration) + " " +
                 finding.unit + "/s^2" + (all_the_time ? " rms" : "") + " from step to step";
  finding.remedy = "record it with more digits, or a finer sensor; " +
                   SmoothText(*channel, std::max(acceleration, channel->limits().noise));
  findings->push_back(std::move(finding));
}

Findings EdgeJudge::Report(const std::string& subject, const std::string& topic) const {
  Findings findings;
  // A recording of less is judged by what there is.
  if (impl_->stride == 0) impl_->KeepWaiting();
  Impl whole = *impl_;
  whole.singles.JudgeRest();
  whole.course.Report(&findings);
  if (whole.bursts.IsBursts() && whole.moves) {
    // What else its motion shows comes of that.
    findings.assign(1, whole.bursts.Report());
    findings[0].subject = subject;
    findings[0].topic = topic;
    return findings;
  }
  whole.ReportJumps(&findings);
  whole.ReportOutliers(&findings);
  whole.ReportEnds(&findings);
  whole.ReportStamps(&findings);
  whole.ReportAccelerations(&findings);
  whole.ReportLateness(&findings);
  whole.ReportNoise(&findings);
  whole.ReportQuantisation(&findings);
  for (Finding& finding : findings) {
    finding.subject = subject;
    finding.topic = topic;
  }
  return findings;
}

}  // namespace cosserat_cable
