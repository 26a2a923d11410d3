// What a recording says that cannot be: the one form in which the check, the replay, their JSON
// files and the live node's diagnostics tell of it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace cosserat_cable {

/// A contradiction of the recording with itself, with the vehicle or with a cable. It is a warning:
/// the run goes on with what was recorded.
struct Finding {
  std::string kind;         ///< for programs: "jump", "late_stamps", "joint_limit", ...
  std::string subject;      ///< "map -> odom", "joint 'travel'", "cable 'hose'"
  std::string topic;        ///< where it was recorded; may be empty
  std::string what;         ///< the end of a sentence that begins with the subject
  std::string remedy;       ///< an advice, or a question; may be empty
  std::uint64_t count = 0;  ///< of samples, or of times
  std::int64_t first = 0;   ///< stamp [ns]
  std::int64_t worst = 0;   ///< stamp of the largest one [ns]
  double size = 0;          ///< of the largest one, in `unit`
  double limit = 0;         ///< from which on it is one, in `unit`
  std::string unit;
  std::int64_t start = 0;  ///< stamp at which the recording begins [ns]; 0: not known

  /// "map -> odom (/tf) jumps by up to 100 mm, at 105.000 s: take ...".
  std::string ToString() const;
};

using Findings = std::vector<Finding>;

/// A stamp [ns] as people read it: "1000.005 s", and with the recording's begin `start`, unless
/// that is 0: "1000.005 s (0.005 s after the start)".
std::string StampText(std::int64_t stamp, std::int64_t start = 0);

/// `format` for one number, as printf has it.
std::string Printed(const char* format, double value);

}  // namespace cosserat_cable
