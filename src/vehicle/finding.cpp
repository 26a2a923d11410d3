#include "cosserat_cable/vehicle/finding.h"

#include <cstdio>

namespace cosserat_cable {

std::string StampText(std::int64_t stamp, std::int64_t start) {
  char text[40];
  std::snprintf(text, sizeof text, "%lld.%03d s", static_cast<long long>(stamp / 1'000'000'000),
                static_cast<int>(stamp / 1'000'000 % 1000));
  if (start == 0) return text;
  return text + Printed(" (%.3f s after the start)", 1e-9 * static_cast<double>(stamp - start));
}

std::string Printed(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string Finding::ToString() const {
  std::string text = subject;
  if (!topic.empty() && topic != subject) text += " (" + topic + ")";
  text += " " + what;
  if (first != 0 && first != worst) text += "; first at " + StampText(first, start);
  if (worst != 0) text += (first != worst ? ", worst at " : ", at ") + StampText(worst, start);
  if (!remedy.empty()) text += ": " + remedy;
  return text;
}

}  // namespace cosserat_cable
