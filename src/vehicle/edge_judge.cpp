#include "cosserat_cable/vehicle/edge_judge.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "cosserat_cable/math/rotation.h"
#include "course_judge.h"
#include "motion_channel.h"
#include "outlier_judge.h"

namespace cosserat_cable {
namespace {

// Cables answer to less than some 50 Hz; samples closer together than this are thinned out [s].
constexpr double kBase = 0.008;
constexpr std::uint64_t kIntervalsToKnowTheRate = 8;
// A part of the blocks that is smaller is an event and no habit of the recording.
constexpr std::uint64_t kLeastBlocks = 2;
constexpr double kLeastShare = 0.05;
// An event that is no larger than this, in the largest acceleration of rough samples, is one of
// them.
constexpr double kFarBeyond = 3;
// Samples closer together than this part of the mean interval are no motion: the curve leaves one
// of them out, see PoseCurve.
constexpr double kTooClose = 0.25;
// An outlier or a bad stamp makes up to so many large accelerations and jumps.
constexpr std::uint64_t kEventsOfOne = 4;
// Of an encoder's step.
constexpr double kFlip = 1.5;
// A value that changes by one step of its grid and back with each sample accelerates by so much, in
// steps per interval squared.
constexpr double kToggles = 2;
// Smoothing takes nothing off a motion that is slower than its cutoff by this factor.
constexpr double kKeeps = 1.5;
// Rounding of poses that do not move [m], [rad].
constexpr double kStill = 1e-6;
// What smoothing may leave of the noise [m/s^2], [rad/s^2]: little beside gravity.
constexpr double kTolerableNoise = 0.5;

// Translations in m and m/s^2. A corrected frame has no business to move suddenly at all. A body
// that moves and stops within one interval at 2 g has no mass; a wheel's carrier can take 10 g.
// Crashes have 50 g, wheel carriers on bad roads 100; twice that is no recording of a vehicle.
MotionLimits TranslationLimits(EdgeRole role) {
  switch (role) {
    case EdgeRole::kAboveVehicle:
      return {1e-3, 0.1, 0.5, 0.5, 500};
    case EdgeRole::kBody:
      return {5e-3, 20, 5, 2, 500};
    case EdgeRole::kJoint:
      break;
  }
  return {5e-3, 100, 10, 5, 2000};
}

// Rotations in rad and rad/s^2: the same at half a metre from the axis.
MotionLimits RotationLimits(EdgeRole role) {
  switch (role) {
    case EdgeRole::kAboveVehicle:
      return {0.5e-3, 0.1, 1, 1, 1000};
    case EdgeRole::kBody:
      return {10e-3, 40, 10, 4, 1000};
    case EdgeRole::kJoint:
      break;
  }
  return {20e-3, 200, 20, 10, 4000};
}

// Of single samples that their neighbours do not explain: what a cable hardly answers to is no
// fault.
OutlierLimits LimitsOfOne(EdgeRole role, bool translation) {
  switch (role) {
    case EdgeRole::kAboveVehicle:
      return translation ? OutlierLimits{1e-3, 0.5} : OutlierLimits{1e-3, 1};
    case EdgeRole::kBody:
      return translation ? OutlierLimits{1e-3, 10} : OutlierLimits{2e-3, 20};
    case EdgeRole::kJoint:
      break;
  }
  return translation ? OutlierLimits{1e-3, 20} : OutlierLimits{3e-3, 50};
}

// Nothing on wheels goes faster, nor does its body take 20 g or its carriers 100 g for a tenth of a
// second.
CourseLimits CourseLimitsOf(EdgeRole role) {
  return role == EdgeRole::kJoint ? CourseLimits{50, 1000} : CourseLimits{150, 200};
}

// The rotation from one pose to the next, in the first one's axes.
Eigen::Vector3d Turn(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
  const Eigen::Quaterniond turn = from.conjugate() * to;
  constexpr double kSmall = 0.05;  // half the sine: the series is good to 1e-6 of it
  const double sine = turn.vec().squaredNorm();
  if (sine > kSmall * kSmall) return RotationLog(turn);
  return std::copysign(2 * (1 + sine / 6), turn.w()) * turn.vec();
}

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

struct EdgeJudge::Impl {
  Impl(EdgeRole the_role, double max_gap)
      : role(the_role),
        longest(max_gap),
        translation(TranslationLimits(role), max_gap),
        rotation(RotationLimits(role), max_gap),
        singles(LimitsOfOne(role, true), LimitsOfOne(role, false), max_gap),
        course(CourseLimitsOf(role), max_gap) {}

  EdgeRole role;
  double longest;
  MotionChannel translation, rotation;
  OutlierJudge singles;
  CourseJudge course;
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
  /// The step that a coarse sensor or rounding leaves; 0: none. Corrections may have one size too.
  double Quantum(const MotionChannel& channel) const {
    return role == EdgeRole::kAboveVehicle ? 0 : channel.step();
  }
  /// A joint's steps of one size are those of its encoder; so are outliers that are no larger.
  bool IsEncoder(const MotionChannel& channel) const {
    const OutlierJudge::Found& found = Singles(channel);
    return (role == EdgeRole::kJoint && found.HasQuantum()) ||
           found.steps.size < kFlip * Quantum(channel);
  }
  bool IsEncoderFlips(const MotionChannel& channel) const {
    const OutlierJudge::Found& found = Singles(channel);
    return (IsEncoder(channel) && found.outliers.size < kFlip * found.steps.size) ||
           found.outliers.size < kFlip * Quantum(channel);
  }
  /// Jumps that are no steps of a coarse sensor.
  MotionChannel::Tally Jumps(const MotionChannel& channel) const;
  /// Whether the noise is that of values which toggle between two steps.
  bool IsQuantisation(const MotionChannel& channel) const;
  /// Whether it vibrates fast, by more than its steps may look like.
  bool Vibrates(const MotionChannel& channel) const;
  double Interval() const { return period() * std::max(stride, 1); }
  /// How to smooth noise of so much acceleration [/s^2].
  std::string SmoothText(const MotionChannel& channel, double noise) const;
  /// Of a channel's events, or of single samples.
  template <class Tally>
  Finding Start(const char* kind, const Tally& tally) const;
  std::string SizeText(const MotionChannel* channel, double size) const {
    if (channel == &rotation) return Printed("%.3g deg", size * 180 / M_PI);
    return size < 1 ? Printed("%.3g mm", 1e3 * size) : Printed("%.3g m", size);
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

EdgeJudge::EdgeJudge(EdgeRole role, double max_gap)
    : impl_(std::make_unique<Impl>(role, max_gap)) {}
EdgeJudge::~EdgeJudge() = default;
EdgeJudge::EdgeJudge(EdgeJudge&&) noexcept = default;
EdgeJudge& EdgeJudge::operator=(EdgeJudge&&) noexcept = default;

EdgeRole EdgeJudge::role() const { return impl_->role; }
bool EdgeJudge::moves() const { return impl_->moves; }

bool EdgeJudge::MovesByJumps() const {
  const MotionChannel& p = impl_->translation;
  const MotionChannel& q = impl_->rotation;
  return p.MovesByJumps() || q.MovesByJumps();
}

Finding EdgeJudge::Corrections(const std::string& subject, const std::string& topic) const {
  const MotionChannel* channel =
      impl_->Worse([](const auto& c) { return c.MovesByJumps(); },
                   [](const auto& c) { return c.largest_step().size / c.limits().jump; });
  const MotionChannel::Tally& largest = channel->largest_step();
  Finding finding = impl_->Start("jump", largest);
  finding.first = finding.worst;
  finding.limit = channel->limits().jump;
  finding.unit = impl_->Unit(channel);
  finding.what = "moves by steps, of up to " + impl_->SizeText(channel, finding.size);
  finding.subject = subject;
  finding.topic = topic;
  return finding;
}

void EdgeJudge::Restart() {
  impl_->KeepWaiting();
  impl_->has_last = false;
  impl_->stride = 0;
  impl_->period_sum = 0;
  impl_->periods = 0;
  impl_->translation.Restart();
  impl_->rotation.Restart();
  impl_->singles.Restart();
  impl_->course.Restart();
}

void EdgeJudge::Finish() { impl_->singles.Finish(); }

void EdgeJudge::Add(std::int64_t stamp, const Pose& X_PC) { impl_->Add({stamp, X_PC}); }

void EdgeJudge::Impl::Add(const Sample& sample) {
  if (has_last) {
    const double h = Seconds(last.stamp, sample.stamp);
    if (periods >= kIntervalsToKnowTheRate && h < kTooClose * period()) return;
    const Eigen::Vector3d d = sample.X.p - last.X.p;
    const Eigen::Vector3d turn = Turn(last.X.q, sample.X.q);
    course.Add(sample.stamp, sample.X.p);
    translation.AddToGrid(d);
    rotation.AddToGrid(turn);
    moves = moves || d.squaredNorm() > kStill * kStill || turn.squaredNorm() > kStill * kStill;
    if (h <= longest) {
      period_sum += h;
      ++periods;
    }
    // Before the rate is known, intervals may be of two samples nearly at one time.
    if (periods >= kIntervalsToKnowTheRate) {
      translation.AddRaw(d, h, sample.stamp);
      rotation.AddRaw(turn, h, sample.stamp);
    }
    Keep(sample);
  }
  singles.Add(sample.stamp, sample.X);
  last = sample;
  has_last = true;
}

// Every so manieth sample: counted, not timed, for the stamps themselves are judged. The first ones
// wait until the rate is known.
void EdgeJudge::Impl::Keep(const Sample& sample) {
  if (stride == 0) {
    if (waiting.empty()) waiting.push_back(last);
    waiting.push_back(sample);
    const bool slow = periods == 0;  // nothing but gaps: every sample counts
    if (slow || periods >= kIntervalsToKnowTheRate) KeepWaiting();
    return;
  }
  if (++since_kept < stride) return;
  since_kept = 0;
  const double h = Seconds(last_kept.stamp, sample.stamp);
  translation.Add(sample.X.p - last_kept.X.p, h, sample.stamp);
  rotation.Add(Turn(last_kept.X.q, sample.X.q), h, sample.stamp);
  last_kept = sample;
}

void EdgeJudge::Impl::KeepWaiting() {
  if (waiting.empty()) return;
  stride = periods == 0 ? 1 : std::max(1, static_cast<int>(std::lround(kBase / period())));
  last_kept = waiting.front();
  since_kept = 0;
  for (std::size_t i = 1; i < waiting.size(); ++i) Keep(waiting[i]);
  waiting.clear();
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
      " from one sample to the next (" + Printed("%.3g ", acceleration) + finding.unit + "/s^2)";
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
  finding.what += " (" + Printed("%.3g ", outliers.acceleration) + finding.unit +
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
  finding.what += ", " + Printed("%.3g ms too ", 1e3 * std::abs(stamps.lateness)) +
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
  finding.what = "accelerates by up to " + Printed("%.3g ", finding.size) + finding.unit +
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
  finding.what = "accelerates by up to " + Printed("%.3g ", channel->lateness().acceleration) +
                 finding.unit + " between samples (" + Printed("%.3g", finding.size) +
                 " rms), and is smooth where its samples are counted out evenly: its stamps are "
                 "late by 0 to " +
                 Printed("%.2g ms", 1e3 * channel->worst_lateness());
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
  const std::string moves = "it also vibrates at " + Printed("%.2g Hz", motion);
  if (kKeeps * motion > most)
    return moves + ", which --smooth HZ would take out too: measure it with less noise, or faster";
  return moves + ": --smooth " + Printed("%.2g", kKeeps * motion) + " keeps that";
}

void EdgeJudge::Impl::ReportNoise(Findings* findings) const {
  const MotionChannel* channel =
      Worse([this](const auto& c) { return IsHabit(c.noise(), c.blocks()) && !IsQuantisation(c); },
            [](const auto& c) { return c.noise().size / c.limits().noise; });
  if (!channel) return;
  Finding finding = Start("noise", channel->noise());
  finding.limit = channel->limits().noise;
  finding.unit = Unit(channel) + std::string("/s^2");
  finding.what = "accelerates by " + Printed("%.3g ", finding.size) + finding.unit +
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
  finding.size = Quantum(*channel);
  finding.limit = channel->limits().noise * Interval() * Interval() / kToggles;
  finding.unit = Unit(channel);
  finding.what = "moves in steps of " + SizeText(channel, finding.size) +
                 ": it is quantised, and accelerates by " + Printed("%.3g ", acceleration) +
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
