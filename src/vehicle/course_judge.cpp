#include "course_judge.h"

#include <algorithm>
#include <utility>

#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {
namespace {

// Long beside jitter, short beside a swing of a body on its springs [ns].
constexpr std::int64_t kPart = 100'000'000;
// A unit is wrong throughout: so many parts of the recording, and such a share of them.
constexpr std::uint64_t kFewestParts = 3;
constexpr double kShare = 0.1;

}  // namespace

void CourseJudge::Restart() { known_ = 0; }

void CourseJudge::Add(std::int64_t stamp, const Eigen::Vector3d& p) {
  const std::int64_t interval = stamp - last_.stamp;
  const double h = static_cast<double>(interval) * 1e-9;
  if (known_ > 0 && interval < kPart) return;
  if (known_ == 0 || h > max_gap_ + 1e-9 * static_cast<double>(kPart)) {
    last_ = {stamp, p, Eigen::Vector3d::Zero()};
    known_ = 1;
    return;
  }
  const Eigen::Vector3d v = (p - last_.p) / h;
  const double speed = v.norm(), acceleration = known_ > 1 ? (v - last_.v).norm() / h : 0;
  ++parts_;
  if (speed > limits_.speed || acceleration > limits_.acceleration) {
    if (beyond_++ == 0) first_ = stamp;
    if (speed > fastest_) worst_ = stamp;
    fastest_ = std::max(fastest_, speed);
    hardest_ = std::max(hardest_, acceleration);
  }
  last_ = {stamp, p, v};
  known_ = 2;
}

void CourseJudge::Report(Findings* findings) const {
  if (beyond_ < kFewestParts || static_cast<double>(beyond_) < kShare * static_cast<double>(parts_))
    return;
  Finding finding;
  finding.kind = "unit";
  finding.count = beyond_;
  finding.first = first_;
  finding.worst = worst_;
  finding.size = fastest_;
  finding.limit = limits_.speed;
  finding.unit = "m/s";
  finding.what = "moves at up to " + FormatRounded(fastest_) + " m/s and accelerates by " +
                 FormatRounded(hardest_) + " m/s^2, over tenths of a second: no vehicle does";
  finding.remedy = "are these millimetres or centimetres? publish metres";
  findings->push_back(std::move(finding));
}

}  // namespace cosserat_cable
