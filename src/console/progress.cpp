#include "cosserat_cable/console/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>

namespace cosserat_cable {
namespace {

constexpr std::chrono::milliseconds kRedraw(200);
constexpr int kBarWidth = 40;

}  // namespace

Progress::Progress(double total, std::string unit)
    : total_(total),
      unit_(std::move(unit)),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      last_(start_ - kRedraw) {}

Progress::~Progress() {
  if (terminal_) std::fputs("\r\033[K", stderr);
}

void Progress::Update(double done, const std::string& what) {
  const double fraction = total_ > 0 ? std::clamp(done / total_, 0.0, 1.0) : 1.0;
  const Clock::time_point now = Clock::now();
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const double left = fraction > 0 ? elapsed * (1 - fraction) / fraction : 0;
  const std::string appendix = what.empty() ? "" : ": " + what;
  if (terminal_) {
    if (now - last_ < kRedraw) return;
    last_ = now;
    const auto filled = static_cast<std::size_t>(fraction * kBarWidth);
    const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, '.');
    std::fprintf(stderr, "\r[%s] %5.1f of %.1f %s, %.0f s left%s \033[K", bar.c_str(), done, total_,
                 unit_.c_str(), left, appendix.c_str());
    return;
  }
  const int tenth = static_cast<int>(fraction * 10);
  if (tenth == last_tenth_) return;
  last_tenth_ = tenth;
  std::fprintf(stderr, "%3d %%: %.1f of %.1f %s, %.0f s left%s\n", 10 * tenth, done, total_,
               unit_.c_str(), left, appendix.c_str());
}

}  // namespace cosserat_cable
