#include "slide_judge.h"

#include <algorithm>

namespace cosserat_cable {
namespace {

// Speeds are taken over so long [s]: noise of fast samples evens out.
constexpr double kPart = 0.05;
// Of the usual speed; a slide is faster than that, and than the least size within a fifth of a
// second.
constexpr double kFaster = 4, kLeastTime = 0.2;
// The usual speed is that of the last seconds [s].
constexpr double kMemory = 1;
// Between two slides it rests for so long [s]; one that lasts longer is a journey.
constexpr double kRest = 0.3, kLongest = 1.1;

}  // namespace

void SlideJudge::Restart() {
  part_.setZero();
  part_time_ = 0;
  at_rest_ = -1;
  runs_ = false;
}

void SlideJudge::Add(const Eigen::Vector3d& d, double h, std::int64_t stamp) {
  part_ += d;
  part_time_ += h;
  if (part_time_ < kPart) return;
  AddPart(stamp);
  part_.setZero();
  part_time_ = 0;
}

void SlideJudge::AddPart(std::int64_t end) {
  const double speed = part_.norm() / part_time_;
  const std::int64_t begin = end - static_cast<std::int64_t>(part_time_ * 1e9);
  if (at_rest_ < 0) at_rest_ = speed;
  if (speed > kFaster * at_rest_ + size_ / kLeastTime) {
    if (!runs_) {
      runs_ = true;
      run_begin_ = begin;
      run_.setZero();
    }
    run_ += part_;
    run_end_ = end;
    if (static_cast<double>(run_end_ - run_begin_) * 1e-9 > kLongest) {
      travels_ = true;
      runs_ = false;
      at_rest_ = speed;
    }
    return;
  }
  if (runs_ && static_cast<double>(end - run_end_) * 1e-9 > kRest) CloseRun();
  at_rest_ += std::min(1.0, part_time_ / kMemory) * (speed - at_rest_);
}

void SlideJudge::CloseRun() {
  runs_ = false;
  const double size = run_.norm(), duration = static_cast<double>(run_end_ - run_begin_) * 1e-9;
  // Half of the time to set it in motion, half of it to stop it.
  if (size < size_ || 4 * size / (duration * duration) < acceleration_) return;
  if (slides_.count++ == 0) slides_.first = run_begin_;
  if (size <= slides_.size) return;
  slides_.worst = run_begin_;
  slides_.size = size;
  slides_.duration = duration;
}

}  // namespace cosserat_cable
