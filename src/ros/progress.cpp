#include "progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

namespace cosserat_cable {
namespace {

constexpr std::chrono::milliseconds kRedraw(200);
constexpr int kBarWidth = 40;

}  // namespace

Progress::Progress(double total)
    : total_(total),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      last_(start_ - kRedraw) {}

Progress::~Progress() {
  if (terminal_) std::fputs("\r\033[K", stderr);
}

void Progress::Update(double done) {
  const double fraction = total_ > 0 ? std::clamp(done / total_, 0.0, 1.0) : 1.0;
  const Clock::time_point now = Clock::now();
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const double left = fraction > 0 ? elapsed * (1 - fraction) / fraction : 0;
  if (terminal_) {
    if (now - last_ < kRedraw) return;
    last_ = now;
    const auto filled = static_cast<std::size_t>(fraction * kBarWidth);
    const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, '.');
    std::fprintf(stderr, "\r[%s] %5.1f of %.1f s, %.0f s left \033[K", bar.c_str(), done, total_,
                 left);
    return;
  }
  const int tenth = static_cast<int>(fraction * 10);
  if (tenth == last_tenth_) return;
  last_tenth_ = tenth;
  std::fprintf(stderr, "%3d %%: %.1f of %.1f s simulated, %.0f s left\n", 10 * tenth, done, total_,
               left);
}

}  // namespace cosserat_cable
