#include "burst_judge.h"

#include <algorithm>

#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {
namespace {

// An interval that is shorter than this part of the mean one is within a burst. Of intervals that
// are random, a third is; of two publishers that take turns, half is.
constexpr double kClose = 0.4, kShare = 0.62;
// One that is longer than this is a pause, even between bursts of three.
constexpr double kPause = 2;
constexpr std::uint64_t kFewestIntervals = 24, kFewestBursts = 3;
// Longer ones are holes of the recording and no part of the rhythm [ns].
constexpr std::int64_t kHole = 3'000'000'000;

double Seconds(std::int64_t time) { return static_cast<double>(time) * 1e-9; }

}  // namespace

void BurstJudge::Add(std::int64_t stamp) {
  const std::int64_t h = stamp - last_;
  if (has_last_ && h < kHole) {
    span_ += h;
    ++intervals_;
    const double mean = static_cast<double>(span_) / static_cast<double>(intervals_);
    if (static_cast<double>(h) < kClose * mean) {
      ++close_;
      length_ += h;
      if (++in_a_row_ == 2) {
        if (bursts_++ == 0) first_ = stamp - length_;
        in_bursts_ += 3;
      } else if (in_a_row_ > 2) {
        ++in_bursts_;
      }
      longest_ = std::max(longest_, length_);
    } else {
      in_a_row_ = 0;
      length_ = 0;
      // At the beginning the mean is still that within a burst.
      if (static_cast<double>(h) > kPause * mean) {
        between_ += h;
        ++pauses_;
      }
    }
  }
  has_last_ = true;
  last_ = stamp;
}

bool BurstJudge::IsBursts() const {
  return intervals_ >= kFewestIntervals && bursts_ >= kFewestBursts &&
         static_cast<double>(close_) > kShare * static_cast<double>(intervals_);
}

Finding BurstJudge::Report() const {
  Finding finding;
  finding.kind = "bursts";
  finding.count = bursts_;
  finding.first = finding.worst = first_;
  finding.size = Seconds(between_) / static_cast<double>(pauses_);
  finding.limit = Seconds(span_) / static_cast<double>(intervals_);
  finding.unit = "s";
  finding.what = "comes in " + std::to_string(bursts_) + " bursts, of some " +
                 std::to_string((in_bursts_ + bursts_ / 2) / bursts_) + " samples stamped within " +
                 FormatRounded(1e3 * Seconds(longest_)) + " ms, with " +
                 FormatRounded(finding.size) + " s" +
                 " between: these are times of sending, and all but the first of each burst are "
                 "too close together to count";
  finding.remedy = "stamp poses when they are measured, not when they are sent";
  return finding;
}

}  // namespace cosserat_cable
