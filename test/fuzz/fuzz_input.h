// What a fuzz target reads: the bytes as a file, and the rule that holds for every reader.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "cosserat_cable/input/problems.h"

namespace cosserat_cable {

/// The bytes as a file in memory, for readers that do not look at its name.
class FuzzFile {
 public:
  FuzzFile(const std::uint8_t* data, std::size_t size) : descriptor_(memfd_create("fuzz", 0)) {
    if (descriptor_ < 0 || write(descriptor_, data, size) != static_cast<ssize_t>(size)) abort();
    path_ = "/proc/self/fd/" + std::to_string(descriptor_);
  }
  ~FuzzFile() { close(descriptor_); }
  FuzzFile(const FuzzFile&) = delete;
  FuzzFile& operator=(const FuzzFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  int descriptor_;
  std::string path_;
};

/// A folder of this process, for files that have a name.
inline const std::filesystem::path& FuzzFolder() {
  static const std::filesystem::path folder = [] {
    std::string name = (std::filesystem::temp_directory_path() / "fuzz_XXXXXX").string();
    if (!mkdtemp(name.data())) abort();
    return std::filesystem::path(name);
  }();
  return folder;
}

inline void WriteFuzzFile(const std::filesystem::path& path, const std::uint8_t* data,
                          std::size_t size) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (!file || std::fwrite(data, 1, size, file) != size || std::fclose(file) != 0) abort();
}

/// Each problem says what it is.
inline void RequireTold(const Problems& problems) {
  for (const Problem& problem : problems.all())
    if (problem.message.empty()) abort();
}

}  // namespace cosserat_cable
