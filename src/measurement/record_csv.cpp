#include "cosserat_cable/measurement/record_csv.h"

#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {

std::string RecordCsv(const Record& record, const std::vector<std::string>& columns,
                      const Eigen::MatrixXd& values) {
  std::string text = record.quasi_static ? "step" : "t";
  for (const std::string& column : columns) text += "," + column;
  text += "\n";
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    text += FormatNumber(record.t[static_cast<std::size_t>(i)]);
    for (Eigen::Index c = 0; c < values.cols(); ++c) text += "," + FormatNumber(values(i, c));
    text += "\n";
  }
  return text;
}

}  // namespace cosserat_cable
