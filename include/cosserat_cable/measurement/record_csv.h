// Records as text, in the columns of the files that they are compared with.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "cosserat_cable/measurement/measurement_set.h"

namespace cosserat_cable {

/// A header, then the record's times (or steps) and, column by column, `values`; in full precision.
std::string RecordCsv(const Record& record, const std::vector<std::string>& columns,
                      const Eigen::MatrixXd& values);

}  // namespace cosserat_cable
