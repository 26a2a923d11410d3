#include "cosserat_cable/console/interrupt.h"

#include <csignal>

namespace cosserat_cable {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void OnSignal(int) { interrupted = 1; }

}  // namespace

void CatchInterrupts() {
  std::signal(SIGINT, OnSignal);
  std::signal(SIGTERM, OnSignal);
  // The terminal is gone, unless nohup said that this does not matter.
  if (std::signal(SIGHUP, OnSignal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
}

bool Interrupted() { return interrupted != 0; }

}  // namespace cosserat_cable
