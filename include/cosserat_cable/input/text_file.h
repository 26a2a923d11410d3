// A text file that a user names, read whole.
#pragma once

#include <cstdint>
#include <string>

namespace cosserat_cable {

/// Far more than anybody writes by hand [bytes].
constexpr std::uint64_t kMostOfYaml = 32 * 1024 * 1024;
/// A record of ten million rows of ten columns [bytes].
constexpr std::uint64_t kMostOfCsv = std::uint64_t{2} * 1024 * 1024 * 1024;

struct TextFile {
  bool ok = false;
  std::string text;
  std::string is;   ///< what it is instead of a text: "a directory"; or
  std::string why;  ///< why it cannot be read: "No such file or directory"
};

/// Reads a file of at most so many bytes. Devices and pipes, which may have no end, are not read, and
/// what has bytes of zero no further than there (unless its first bytes say that it is UTF-16).
TextFile ReadTextFile(const std::string& path, std::uint64_t most);

}  // namespace cosserat_cable
