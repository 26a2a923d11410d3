#include "instruction_trace.h"

#include <stdexcept>

#if defined(__x86_64__) && defined(__linux__)
#include <signal.h>
#include <sys/ptrace.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstddef>

namespace cosserat_cable::bench {
namespace {

/// Waits until the child stops; false: it ended.
bool Stopped(pid_t child, int* signal) {
  int status = 0;
  if (waitpid(child, &status, 0) != child || !WIFSTOPPED(status)) return false;
  *signal = WSTOPSIG(status);
  return true;
}

[[noreturn]] void BeTraced(const std::function<void()>& prepare,
                           const std::function<void()>& work) {
  try {
    prepare();
    if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr)) _exit(1);
    raise(SIGSTOP);  // from here
    work();
    raise(SIGSTOP);  // to here
    _exit(0);
  } catch (...) {
    _exit(1);
  }
}

}  // namespace

std::map<std::uint64_t, std::uint64_t> TraceInstructions(const std::function<void()>& prepare,
                                                         const std::function<void()>& work) {
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot fork");
  if (child == 0) BeTraced(prepare, work);
  std::map<std::uint64_t, std::uint64_t> times;
  int signal = 0;
  if (!Stopped(child, &signal) || signal != SIGSTOP)
    throw std::runtime_error("cannot trace: not permitted, or the work failed");
  do {
    const long address = ptrace(PTRACE_PEEKUSER, child, offsetof(user_regs_struct, rip), nullptr);
    ++times[static_cast<std::uint64_t>(address)];
    if (ptrace(PTRACE_SINGLESTEP, child, nullptr, nullptr) || !Stopped(child, &signal))
      throw std::runtime_error("the traced work failed");
  } while (signal == SIGTRAP);
  ptrace(PTRACE_CONT, child, nullptr, nullptr);
  waitpid(child, nullptr, 0);
  if (signal != SIGSTOP) throw std::runtime_error("the traced work failed");
  return times;
}

}  // namespace cosserat_cable::bench

#else

namespace cosserat_cable::bench {

std::map<std::uint64_t, std::uint64_t> TraceInstructions(const std::function<void()>&,
                                                         const std::function<void()>&) {
  throw std::runtime_error("instructions are only counted on x86-64 under Linux");
}

}  // namespace cosserat_cable::bench

#endif
