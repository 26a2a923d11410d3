// The few pieces of JSON that the summaries need.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace cosserat_cable {

/// Infinite values become null.
std::string JsonNumber(double value);
std::string JsonString(const std::string& text);
std::string JsonStrings(const std::vector<std::string>& texts);
std::string JsonVector(const Eigen::Vector3d& v);

}  // namespace cosserat_cable
