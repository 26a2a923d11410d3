#include "csv_writer.h"

#include <cmath>
#include <limits>
#include <locale>
#include <stdexcept>

#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {
namespace {

constexpr int kAlwaysExact = std::numeric_limits<double>::digits10;
constexpr int kEnough = std::numeric_limits<double>::max_digits10;

bool ReadsBack(const std::string& name) {
  return !name.empty() && name.find_first_of(",\"\r\n") == std::string::npos &&
         name.front() != ' ' && name.back() != ' ';
}

}  // namespace

CsvText::CsvText(const std::vector<std::string>& columns) : columns_(columns.size()) {
  number_.imbue(std::locale::classic());
  for (const std::string& column : columns) {
    if (!ReadsBack(column)) throw std::runtime_error("'" + column + "' cannot name a column");
    text_ += (text_.empty() ? "" : ",") + column;
  }
  text_ += "\n";
}

void CsvText::Add(double value) {
  if (!std::isfinite(value)) throw std::runtime_error("a number that is not finite");
  // Fifteen digits hold every number that was written with as many; computed ones need seventeen.
  for (const int digits : {kAlwaysExact, kEnough}) {
    number_.str("");
    number_.precision(digits);
    number_ << value;
    if (ParseNumber(number_.str()).value == value) break;
  }
  text_ += number_.str();
  filled_ = (filled_ + 1) % columns_;
  text_ += filled_ == 0 ? '\n' : ',';
}

}  // namespace cosserat_cable
