#include "cosserat_cable/console/run_tool.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>

#include "cosserat_cable/console/exit_code.h"

namespace cosserat_cable {
namespace {

void OpenIfClosed(int descriptor, const char* device, int mode) {
  if (fcntl(descriptor, F_GETFD) != -1) return;
  const int opened = open(device, mode);
  if (opened < 0 || opened == descriptor) return;
  dup2(opened, descriptor);
  close(opened);
}

}  // namespace

int RunTool(const std::function<int()>& work) {
  OpenIfClosed(STDIN_FILENO, "/dev/null", O_RDONLY);
  // What is printed there is lost, and that shows when it is written.
  OpenIfClosed(STDOUT_FILENO, "/dev/full", O_WRONLY);
  OpenIfClosed(STDERR_FILENO, "/dev/null", O_WRONLY);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  int code = kExitFailed;
  try {
    code = work();
  } catch (const std::bad_alloc&) {
    std::fputs("the memory does not suffice\n", stderr);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stopped: %s\n", error.what());
  }
  std::cout.flush();
  errno = 0;
  const bool flushed = std::fflush(stdout) == 0;
  if (flushed && std::cout.good() && std::ferror(stdout) == 0) return code;
  std::fprintf(stderr, "the standard output could not be written whole%s%s\n",
               errno == 0 ? "" : ": ", errno == 0 ? "" : std::strerror(errno));
  return code == kExitDone ? kExitFileTrouble : code;
}

}  // namespace cosserat_cable
