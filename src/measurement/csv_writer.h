// The text of a CSV file of numbers that reads back to the same bits.
#pragma once

#include <sstream>
#include <string>
#include <vector>

namespace cosserat_cable {

class CsvText {
 public:
  /// @throws std::runtime_error for a column's name that would not read back
  explicit CsvText(const std::vector<std::string>& columns);

  /// One cell; a row ends where it has as many as there are columns.
  void Add(double value);
  const std::string& text() const { return text_; }

 private:
  std::ostringstream number_;
  std::string text_;
  std::size_t columns_;
  std::size_t filled_ = 0;
};

}  // namespace cosserat_cable
