#include "csv_table.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <string_view>

#include "cosserat_cable/input/number_text.h"
#include "cosserat_cable/input/text_file.h"

namespace cosserat_cable {
namespace {

constexpr int kMostShown = 20;
constexpr std::size_t kLongestShown = 40;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::string_view Trimmed(std::string_view text) {
  const char* const blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string_view Unquoted(std::string_view text) {
  const bool quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return quoted ? text.substr(1, text.size() - 2) : text;
}

std::string Shown(std::string_view cell) {
  if (cell.empty()) return "nothing";
  if (cell.size() > kLongestShown) return "'" + std::string(cell.substr(0, kLongestShown)) + "...'";
  return "'" + std::string(cell) + "'";
}

// Cuts off and returns what stands before the separator, or all of it.
std::string_view TakeUntil(char separator, std::string_view* rest) {
  const std::size_t end = rest->find(separator);
  const std::string_view taken = rest->substr(0, end);
  rest->remove_prefix(end == std::string_view::npos ? rest->size() : end + 1);
  return taken;
}

std::vector<std::string_view> Cells(std::string_view line) {
  std::vector<std::string_view> cells;
  const auto count = std::count(line.begin(), line.end(), ',') + 1;
  for (auto i = count; i > 0; --i) cells.push_back(Trimmed(TakeUntil(',', &line)));
  return cells;
}

// Parses the text of one file.
class CsvReader {
 public:
  CsvReader(CsvTable* table, Problems* problems)
      : table_(table), problems_(problems), rows_(table->path, problems) {}

  bool Read(std::string_view text) {
    const std::string_view mark = "\xEF\xBB\xBF";
    if (text.substr(0, mark.size()) == mark) text.remove_prefix(mark.size());
    if (Trimmed(text).empty()) {
      problems_->Add(table_->path, 1, "", "got an empty file, expected a header line");
      return false;
    }
    if (!ReadHeader(TakeUntil('\n', &text))) return false;
    while (!text.empty()) ReadRow(TakeUntil('\n', &text));
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const auto width = static_cast<Eigen::Index>(table_->columns.size());
    const Eigen::Index count = static_cast<Eigen::Index>(numbers_.size()) / width;
    table_->values = Eigen::Map<const RowMajor>(numbers_.data(), count, width);
    if (count == 0) problems_->Add(table_->path, 1, "", "got a header line only, expected rows");
    return true;
  }

 private:
  bool ReadHeader(std::string_view line) {
    std::map<std::string, int> seen;
    for (const std::string_view cell : Cells(line)) {
      const std::string name(Unquoted(cell));
      table_->columns.push_back(name);
      if (++seen[name] != 2) continue;
      problems_->Add(table_->path, 1, name, "got two columns of this name, expected one");
    }
    const std::string& first = table_->columns[0];
    const bool separated = table_->columns.size() == 1;
    if (separated && first.find_first_of(";\t") != std::string::npos) {
      problems_->Add(table_->path, 1, "",
                     "got columns separated by semicolons or tabs, expected commas");
      return false;
    }
    if (ParseNumber(first).kind != NumberText::Kind::kNone) {
      problems_->Add(table_->path, 1, "", "got numbers, expected a header line of column names");
      return false;
    }
    return true;
  }

  void ReadRow(std::string_view line) {
    ++line_;
    if (Trimmed(line).empty()) {
      ++empty_lines_;
      return;
    }
    // Rows keep their line's place, so that a row's line is known later.
    for (; empty_lines_ > 0; --empty_lines_) {
      rows_.Add(line_ - empty_lines_, "", "got an empty line, expected a row of numbers");
      numbers_.insert(numbers_.end(), table_->columns.size(), kNaN);
    }
    const auto cells = static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1;
    if (cells != table_->columns.size()) {
      rows_.Add(line_, "",
                "got " + std::to_string(cells) + " cells, expected " +
                    std::to_string(table_->columns.size()) + " as in the header");
      numbers_.insert(numbers_.end(), table_->columns.size(), kNaN);
      return;
    }
    for (const std::string& column : table_->columns) {
      const std::string_view cell = Unquoted(Trimmed(TakeUntil(',', &line)));
      text_.assign(cell.data(), cell.size());
      const NumberText number = ParseNumber(text_);
      const bool finite = number.kind == NumberText::Kind::kFinite;
      if (!finite) rows_.Add(line_, column, "got " + Shown(cell) + ", expected a finite number");
      numbers_.push_back(finite ? number.value : kNaN);
    }
  }

  CsvTable* table_;
  Problems* problems_;
  RowProblems rows_;
  std::vector<double> numbers_;
  std::string text_;  // kept, so that not every cell allocates
  int line_ = 1;
  int empty_lines_ = 0;  // just before this line
};

}  // namespace

std::optional<Eigen::Index> CsvTable::Find(const std::string& column) const {
  const auto found = std::find(columns.begin(), columns.end(), column);
  if (found == columns.end()) return std::nullopt;
  return found - columns.begin();
}

void RowProblems::Add(int line, const std::string& column, const std::string& message) {
  if (++count_ <= kMostShown) problems_->Add(path_, line, column, message);
  last_line_ = line;
}

RowProblems::~RowProblems() {
  if (count_ <= kMostShown) return;
  problems_->Add(path_, last_line_, "",
                 std::to_string(count_ - kMostShown) + " more of this kind, up to this line");
}

std::optional<CsvTable> ReadCsvTable(const std::string& folder, const std::string& name,
                                     const YamlValue& named_by, Problems* problems) {
  CsvTable table;
  table.path = (std::filesystem::path(folder) / name).string();
  const TextFile file = ReadTextFile(table.path, kMostOfCsv);
  if (!file.ok) {
    named_by.Report("got '" + name + "', " +
                    (file.is.empty() ? "which cannot be read: " + file.why + ": " + table.path
                                     : file.is + ", expected a CSV file"));
    return std::nullopt;
  }
  CsvReader reader(&table, problems);
  if (!reader.Read(file.text)) return std::nullopt;
  return table;
}

std::optional<std::string> ReadFileName(const YamlValue& value) {
  const std::optional<std::string> name = value.Text("the name of a CSV file");
  if (!name) return std::nullopt;
  const std::filesystem::path path(*name);
  const std::filesystem::path plain = path.lexically_normal();
  if (path.is_absolute() || (!plain.empty() && *plain.begin() == "..")) {
    value.ReportUnexpected("a file in the set's own folder");
    return std::nullopt;
  }
  return name;
}

bool CheckColumns(const CsvTable& table, const std::vector<std::string>& expected,
                  const std::string& what, Problems* problems) {
  bool all = true;
  std::vector<std::string> strange;
  for (const std::string& column : table.columns) {
    if (std::find(expected.begin(), expected.end(), column) == expected.end())
      strange.push_back(column);
  }
  for (const std::string& column : expected) {
    if (table.Find(column)) continue;
    all = false;
    const std::string nearest = NearestWord(column, strange);
    problems->Add(table.path, 1, column,
                  "no such column, expected one in " + what +
                      (nearest.empty() ? "" : ": is it meant by '" + nearest + "'?"));
  }
  for (const std::string& column : strange) {
    problems->Add(table.path, 1, column, "got a column of this name, expected none in " + what);
  }
  return all;
}

}  // namespace cosserat_cable
