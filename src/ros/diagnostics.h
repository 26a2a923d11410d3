// The engine's state as diagnostic messages. Nothing of the wall clock is in them: a replay is
// repeatable.
#pragma once

#include <diagnostic_msgs/DiagnosticStatus.h>

#include <cstdint>
#include <string>

#include "cosserat_cable/ros/link_motion.h"
#include "cosserat_cable/ros/summary.h"

namespace cosserat_cable {

diagnostic_msgs::DiagnosticStatus CableDiagnostics(const CableSummary& cable, bool failed,
                                                   const std::string& message, std::uint64_t held);

diagnostic_msgs::DiagnosticStatus InputDiagnostics(const LinkMotion& links, std::uint64_t resets);

/// A stamp [ns] as people read it: "1000.005 s".
std::string StampText(std::int64_t stamp);

/// Appends a key and its value.
void AddValue(const std::string& key, const std::string& value,
              diagnostic_msgs::DiagnosticStatus* status);
void AddValue(const std::string& key, double value, diagnostic_msgs::DiagnosticStatus* status);

}  // namespace cosserat_cable
