#include "cosserat_cable/vehicle/clamp_judge.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cosserat_cable/input/number_text.h"
#include "unwound.h"

namespace cosserat_cable {
namespace {

constexpr double kRounding = 1e-6;  // of a length
// A full turn winds a cable up; nothing that steers or springs does that.
constexpr double kFullTurn = 2 * M_PI;
// A short thick cable is torn before: shear at its surface. Rubber is used up to about this.
constexpr double kMostShear = 0.2;

}  // namespace

double ClampJudge::MostTurn() const {
  return std::min(kFullTurn, kMostShear * 2 * length_ / diameter_);
}

void ClampJudge::Add(std::int64_t stamp, const Pose& X_WA, const Pose& X_WB) {
  const double distance = (X_WB.p - X_WA.p).norm();
  if (!range_.known) {
    range_.known = true;
    range_.first = range_.least = distance;
    range_.turn_at = stamp;
  }
  if (distance > range_.most) {
    range_.most = distance;
    range_.most_at = stamp;
  }
  range_.least = std::min(range_.least, distance);
  if (distance > (1 + kRounding) * length_ && too_far_++ == 0) first_too_far_ = stamp;

  const Eigen::Quaterniond q_AB = X_WA.q.conjugate() * X_WB.q;
  if (!has_start_) {
    has_start_ = true;
    start_ = q_AB;
    phi_.setZero();
    return;
  }
  phi_ = Unwound(start_.conjugate() * q_AB, phi_);
  const double turn = phi_.norm();
  if (turn > range_.turn) {
    range_.turn = turn;
    range_.turn_at = stamp;
  }
  if (turn > MostTurn() && too_turned_++ == 0) first_too_turned_ = stamp;
}

std::string ClampJudge::Describe() const {
  char text[160];
  if (range_.most - range_.least < kRounding * length_) {
    std::snprintf(text, sizeof text, "%.1f mm apart (%.0f %% of its length)", 1e3 * range_.most,
                  100 * range_.most / length_);
  } else {
    std::snprintf(text, sizeof text,
                  "%.1f to %.1f mm apart (%.0f to %.0f %% of its length, most at %s)",
                  1e3 * range_.least, 1e3 * range_.most, 100 * range_.least / length_,
                  100 * range_.most / length_, StampText(range_.most_at).c_str());
  }
  return text;
}

Findings ClampJudge::Report() const {
  Findings findings;
  Finding finding;
  finding.subject = "cable '" + cable_ + "'";
  if (too_far_ > 0) {
    finding.kind = "clamps_too_far";
    finding.what = "has its clamps up to " + Printed("%.1f mm apart, ", 1e3 * range_.most) +
                   Printed("%.1f %% of its length", 100 * range_.most / length_);
    finding.remedy = "are its length, its clamps and the recorded motion right?";
    finding.count = too_far_;
    finding.first = first_too_far_;
    finding.worst = range_.most_at;
    finding.size = range_.most;
    finding.limit = length_;
    finding.unit = "m";
    findings.push_back(finding);
  }
  if (too_turned_ > 0) {
    finding.kind = "clamps_turned";
    finding.what = "has its clamps turned against each other by up to " +
                   FormatRounded(range_.turn / (2 * M_PI)) + " turns from how they were first";
    finding.remedy = "does a clamp belong on a link that does not spin?";
    finding.count = too_turned_;
    finding.first = first_too_turned_;
    finding.worst = range_.turn_at;
    finding.size = range_.turn;
    finding.limit = MostTurn();
    finding.unit = "rad";
    findings.push_back(finding);
  }
  return findings;
}

}  // namespace cosserat_cable
