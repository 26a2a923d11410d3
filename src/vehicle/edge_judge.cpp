#include "cosserat_cable/vehicle/edge_judge.h"

#include <algorithm>
#include <cmath>

#include "cosserat_cable/math/rotation.h"
#include "edge_judge_impl.h"

namespace cosserat_cable {
namespace {

// Cables answer to less than some 50 Hz; samples closer together than this are thinned out [s].
constexpr double kBase = 0.008;
constexpr std::uint64_t kIntervalsToKnowTheRate = 8;
// Rounding of poses that do not move [m], [rad].
constexpr double kStill = 1e-6;

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

// Of roll, pitch and yaw.
Eigen::Vector3d ChangeOfAngles(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
  const auto angles = [](const Eigen::Quaterniond& q) {
    const double w = q.w(), x = q.x(), y = q.y(), z = q.z();
    return Eigen::Vector3d(std::atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
                           std::asin(std::clamp(2 * (w * y - z * x), -1.0, 1.0)),
                           std::atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)));
  };
  const Eigen::Vector3d change = angles(to) - angles(from);
  return {std::remainder(change.x(), 2 * M_PI), change.y(), std::remainder(change.z(), 2 * M_PI)};
}

}  // namespace

// Of single samples that their neighbours do not explain: what a cable hardly answers to is no
// fault.
OutlierLimits EdgeJudge::Impl::LimitsOfOne(EdgeRole role, bool translation) {
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

EdgeJudge::Impl::Impl(EdgeRole the_role, double max_gap)
    : role(the_role),
      longest(max_gap),
      translation(TranslationLimits(role), max_gap),
      rotation(RotationLimits(role), max_gap),
      singles(LimitsOfOne(role, true), LimitsOfOne(role, false), max_gap),
      course(CourseLimitsOf(role), max_gap),
      translation_slides(translation.limits().jump, translation.limits().jump_acceleration),
      rotation_slides(rotation.limits().jump, rotation.limits().jump_acceleration) {}

EdgeJudge::EdgeJudge(EdgeRole role, double max_gap)
    : impl_(std::make_unique<Impl>(role, max_gap)) {}
EdgeJudge::~EdgeJudge() = default;
EdgeJudge::EdgeJudge(EdgeJudge&&) noexcept = default;
EdgeJudge& EdgeJudge::operator=(EdgeJudge&&) noexcept = default;

EdgeRole EdgeJudge::role() const { return impl_->role; }
bool EdgeJudge::moves() const { return impl_->moves; }

bool EdgeJudge::IsCorrected() const {
  const MotionChannel& p = impl_->translation;
  const MotionChannel& q = impl_->rotation;
  return p.MovesByJumps() || q.MovesByJumps() || impl_->MovesBySlides(p) || impl_->MovesBySlides(q);
}

bool EdgeJudge::IsRough() const {
  return impl_->IsRough(impl_->translation) || impl_->IsRough(impl_->rotation);
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
  impl_->bursts.Restart();
  impl_->translation_slides.Restart();
  impl_->rotation_slides.Restart();
}

void EdgeJudge::Finish() { impl_->singles.Finish(); }

void EdgeJudge::Add(std::int64_t stamp, const Pose& X_PC) { impl_->Add({stamp, X_PC}); }

void EdgeJudge::Impl::Add(const Sample& sample) {
  bursts.Add(sample.stamp);
  if (has_last) {
    const double h = Seconds(last.stamp, sample.stamp);
    if (periods >= kIntervalsToKnowTheRate && h < kTooClose * period()) return;
    const Eigen::Vector3d d = sample.X.p - last.X.p;
    const Eigen::Vector3d turn = Turn(last.X.q, sample.X.q);
    course.Add(sample.stamp, sample.X.p);
    if (role == EdgeRole::kAboveVehicle) {
      translation_slides.Add(d, h, sample.stamp);
      rotation_slides.Add(turn, h, sample.stamp);
    }
    translation.AddToGrid(d);
    rotation.AddToGrid(turn);
    angles.Add(ChangeOfAngles(last.X.q, sample.X.q));
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

}  // namespace cosserat_cable
