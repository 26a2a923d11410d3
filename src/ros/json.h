// The few pieces of JSON that the summaries need.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "cosserat_cable/vehicle/clamp_judge.h"
#include "cosserat_cable/vehicle/finding.h"

namespace cosserat_cable {

/// Infinite values become null.
std::string JsonNumber(double value);
std::string JsonString(const std::string& text);
std::string JsonStrings(const std::vector<std::string>& texts);
std::string JsonVector(const Eigen::Vector3d& v);
/// A list of objects; times in seconds.
std::string JsonFindings(const Findings& findings);
/// Entries to follow others: `, "clamps_first": ...`.
std::string JsonClamps(const ClampJudge::Range& clamps);

}  // namespace cosserat_cable
