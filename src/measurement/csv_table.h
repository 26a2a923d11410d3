// A CSV file of numbers: a header line with the columns' names, then a row per sample.
//
// Byte order marks, CRLF, blanks around cells and quoted names are style and accepted; so are empty
// lines at the end. Everything else that is not a finite number in its column is a problem.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "cosserat_cable/input/problems.h"
#include "cosserat_cable/input/yaml_value.h"

namespace cosserat_cable {

struct CsvTable {
  std::string path;
  std::vector<std::string> columns;
  Eigen::MatrixXd values;  ///< NaN where a cell was wrong (then it was reported)

  static int LineOf(Eigen::Index row) { return static_cast<int>(row) + 2; }
  std::optional<Eigen::Index> Find(const std::string& column) const;
};

/// Problems of a file's rows: the first ones in full, the others counted, so that a file of another
/// kind does not bury what is wrong elsewhere.
class RowProblems {
 public:
  RowProblems(std::string path, Problems* problems) : path_(std::move(path)), problems_(problems) {}
  ~RowProblems();
  RowProblems(const RowProblems&) = delete;
  RowProblems& operator=(const RowProblems&) = delete;

  void Add(int line, const std::string& column, const std::string& message);

 private:
  std::string path_;
  Problems* problems_;
  int count_ = 0;
  int last_line_ = 0;
};

/// Reads the file `name` in `folder`, which the set names at `named_by`: a file that cannot be read
/// is a problem there. Nothing where there is no header.
std::optional<CsvTable> ReadCsvTable(const std::string& folder, const std::string& name,
                                     const YamlValue& named_by, Problems* problems);

/// The name of a file in the set's folder or below.
std::optional<std::string> ReadFileName(const YamlValue& value);

/// Reports columns of these names that the table lacks, and others that it has.
/// @param what "a motion file", for the message
/// @return whether all are there
bool CheckColumns(const CsvTable& table, const std::vector<std::string>& expected,
                  const std::string& what, Problems* problems);

}  // namespace cosserat_cable
