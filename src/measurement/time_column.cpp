#include "time_column.h"

#include <cmath>

#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {
namespace {

void CheckTimes(const CsvTable& table, TimeOrder order, Problems* problems) {
  RowProblems rows(table.path, problems);
  double last = std::nan("");
  for (Eigen::Index i = 0; i < table.values.rows(); ++i) {
    const double t = table.values(i, 0);
    if (std::isnan(t)) continue;  // reported
    const bool good = order == TimeOrder::kRepeating ? t >= last : t > last;
    if (!std::isnan(last) && !good) {
      rows.Add(CsvTable::LineOf(i), "t",
               "got " + FormatNumber(t) + " after " + FormatNumber(last) +
                   (order == TimeOrder::kRepeating ? ", expected times that do not decrease"
                                                   : ", expected times that increase"));
    }
    last = t;
  }
}

void CheckSteps(const CsvTable& table, TimeOrder order, Problems* problems) {
  RowProblems rows(table.path, problems);
  double last = -1;
  for (Eigen::Index i = 0; i < table.values.rows(); ++i) {
    const double step = table.values(i, 0);
    if (std::isnan(step)) {
      ++last;  // reported; taken for what it should be
      continue;
    }
    const bool repeats = order == TimeOrder::kRepeating && i > 0 && step == last;
    if (step != last + 1 && !repeats) {
      rows.Add(CsvTable::LineOf(i), "step",
               "got " + FormatNumber(step) + ", expected " + FormatNumber(last + 1) +
                   ": steps are 0, 1, 2, ...");
    }
    last = step;
  }
}

}  // namespace

TimeColumn ReadTimeColumn(const CsvTable& table, TimeOrder order, Problems* problems) {
  TimeColumn times;
  const std::string& name = table.columns[0];
  if (name != "t" && name != "step") {
    problems->Add(table.path, 1, name,
                  "got this as the first column, expected `t` [s], or `step` of a quasi-static "
                  "test");
    return times;
  }
  times.name = name;
  times.quasi_static = name == "step";
  (times.quasi_static ? CheckSteps : CheckTimes)(table, order, problems);
  const double* const first = table.values.data();  // its columns lie one behind the other
  times.t.assign(first, first + table.values.rows());
  return times;
}

}  // namespace cosserat_cable
