// The few pieces of JSON that the summaries need.
#pragma once

#include <string>

namespace cosserat_cable {

/// Infinite values become null.
std::string JsonNumber(double value);
std::string JsonString(const std::string& text);

}  // namespace cosserat_cable
