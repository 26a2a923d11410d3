#include "cosserat_cable/input/text_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace cosserat_cable {
namespace {

// So much is looked at before more is read: a file of holes takes no memory [bytes].
constexpr std::size_t kBlock = 1024 * 1024;

bool IsUtf16(const std::string& text) {
  return text.compare(0, 2, "\xFF\xFE") == 0 || text.compare(0, 2, "\xFE\xFF") == 0;
}

void ReadOpened(int descriptor, std::uint64_t most, TextFile* file) {
  struct stat status {};
  if (fstat(descriptor, &status) != 0) {
    file->why = std::strerror(errno);
    return;
  }
  if (!S_ISREG(status.st_mode)) {
    file->is = S_ISDIR(status.st_mode) ? "a directory" : "a device or a pipe";
    return;
  }
  std::string& text = file->text;
  while (text.size() <= most) {
    const std::size_t had = text.size();
    text.resize(had + kBlock);
    const ssize_t count = read(descriptor, text.data() + had, kBlock);
    text.resize(had + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) file->why = std::strerror(errno);
    if (count == 0) file->ok = true;
    if (count <= 0) return;
    const std::size_t zero = text.find('\0', had);
    if (zero != std::string::npos && !IsUtf16(text)) {
      file->is = "a file whose byte " + std::to_string(zero) + " is zero";
      return;
    }
  }
  file->is = "a file of more than " + std::to_string(most) + " bytes";
}

}  // namespace

TextFile ReadTextFile(const std::string& path, std::uint64_t most) {
  TextFile file;
  // A pipe is not waited for.
  const int descriptor = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) {
    file.why = std::strerror(errno);
    return file;
  }
  ReadOpened(descriptor, most, &file);
  close(descriptor);
  if (!file.ok) file.text.clear();
  return file;
}

}  // namespace cosserat_cable
