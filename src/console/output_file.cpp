#include "cosserat_cable/console/output_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>

namespace cosserat_cable {

void WriteWhole(const std::string& path, const std::string& text) {
  const std::string beside = path + ".active";
  const auto fail = [&] {
    const std::string why = std::strerror(errno);
    std::remove(beside.c_str());
    throw std::runtime_error(path + ": cannot be written: " + why);
  };
  std::FILE* file = std::fopen(beside.c_str(), "wb");
  if (!file) fail();
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  // A full disk may show only when the file is closed.
  if (std::fclose(file) != 0 || !written) fail();
  if (std::rename(beside.c_str(), path.c_str()) != 0) fail();
}

}  // namespace cosserat_cable
