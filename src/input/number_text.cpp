#include "cosserat_cable/input/number_text.h"

#include <locale.h>
#include <stdlib.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <iomanip>
#include <limits>
#include <locale>
#include <set>
#include <sstream>

namespace cosserat_cable {
namespace {

locale_t Classic() {
  static const locale_t classic = newlocale(LC_ALL_MASK, "C", nullptr);
  return classic;
}

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

bool IsDecimalNumber(const std::string& text) {
  auto at = text.begin();
  const auto skip_sign = [&] {
    if (at != text.end() && (*at == '+' || *at == '-')) ++at;
  };
  const auto skip_digits = [&] {
    const auto from = at;
    at = std::find_if_not(at, text.end(), IsDigit);
    return at - from;
  };
  skip_sign();
  auto digits = skip_digits();
  if (at != text.end() && *at == '.') {
    ++at;
    digits += skip_digits();
  }
  if (digits == 0) return false;
  if (at != text.end() && (*at == 'e' || *at == 'E')) {
    ++at;
    skip_sign();
    if (skip_digits() == 0) return false;
  }
  return at == text.end();
}

bool IsNonFiniteWord(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (!text.empty() && (text[0] == '+' || text[0] == '-')) text.erase(0, 1);
  if (!text.empty() && text[0] == '.') text.erase(0, 1);
  static const std::set<std::string> words = {"nan", "inf", "infinity"};
  return words.count(text) > 0;
}

}  // namespace

NumberText ParseNumber(const std::string& text) {
  if (!IsDecimalNumber(text)) {
    return {IsNonFiniteWord(text) ? NumberText::Kind::kNonFinite : NumberText::Kind::kNone, 0};
  }
  // Plain strtod would expect a decimal comma in some places of the world; a stream takes several
  // times as long, which files of a million numbers feel.
  const double value = strtod_l(text.c_str(), nullptr, Classic());
  if (std::isinf(value)) return {NumberText::Kind::kNonFinite, 0};
  return {NumberText::Kind::kFinite, value};
}

std::string FormatRounded(double value, int digits) {
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  stream.precision(digits);
  stream << value;
  const std::string text = stream.str();
  const std::size_t exponent = text.find("e+0");
  if (exponent == std::string::npos || text[exponent + 3] >= '6') return text;
  stream.str("");
  stream << std::fixed << std::setprecision(0) << ParseNumber(text).value;
  return stream.str();
}

std::string FormatLength(double metres, int digits) {
  const double rounded = ParseNumber(FormatRounded(metres, digits)).value;
  return std::abs(rounded) < 1 ? FormatRounded(1e3 * metres, digits) + " mm"
                               : FormatRounded(metres, digits) + " m";
}

std::string FormatNumber(double value) {
  constexpr int kEnough = std::numeric_limits<double>::max_digits10, kFewest = 6;
  constexpr int kAlwaysKept = std::numeric_limits<double>::digits10;
  // What has few digits is its own text with more of them, without the zeros at the end. A stream
  // for each number of digits takes minutes for a file of ten million numbers.
  const locale_t before = uselocale(Classic());
  char text[40];
  // Numbers next to zero keep fewer digits.
  int digits = std::fpclassify(value) == FP_SUBNORMAL ? kFewest : kAlwaysKept;
  do {
    std::snprintf(text, sizeof text, "%.*e", digits - 1, value);
  } while (strtod_l(text, nullptr, Classic()) != value && ++digits < kEnough);
  if (digits == kAlwaysKept) {
    const char* end = std::strchr(text, 'e');
    while (end > text && digits > kFewest && *(end - 1) == '0') --end, --digits;
  }
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  uselocale(before);
  return text;
}

}  // namespace cosserat_cable
