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

/// `smooth`: cutoff of the links' motion [Hz]; 0: none.
diagnostic_msgs::DiagnosticStatus InputDiagnostics(const LinkMotion& links, std::uint64_t resets,
                                                   const Findings& findings, double smooth);

/// Appends a key and its value.
void AddValue(const std::string& key, const std::string& value,
              diagnostic_msgs::DiagnosticStatus* status);
void AddValue(const std::string& key, double value, diagnostic_msgs::DiagnosticStatus* status);

}  // namespace cosserat_cable
