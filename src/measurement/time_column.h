// The first column of a set's CSV files: times, or the steps of a quasi-static test.
#pragma once

#include <string>
#include <vector>

#include "csv_table.h"

namespace cosserat_cable {

enum class TimeOrder {
  kIncreasing,  ///< every row has a time of its own
  kRepeating    ///< several rows may share one
};

struct TimeColumn {
  std::string name;           ///< "t" or "step"; empty where it is neither (then it was reported)
  bool quasi_static = false;  ///< whether it is "step"
  std::vector<double> t;
};

/// Reports a first column of another name, times that do not increase, and steps that are not
/// 0, 1, 2, ...
TimeColumn ReadTimeColumn(const CsvTable& table, TimeOrder order, Problems* problems);

}  // namespace cosserat_cable
