#include "motion_file.h"

#include <cmath>
#include <limits>

#include "cosserat_cable/input/number_text.h"
#include "time_column.h"

namespace cosserat_cable {
namespace {

// As of poses in the set itself: more off unit length than rounding to four digits explains.
constexpr double kQuaternionTolerance = 1e-3;
// One that is normalised already keeps its bits, so that a written file reads back the same.
constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();

}  // namespace

std::optional<ClampMotion> ReadMotion(const std::string& folder, const YamlValue& value,
                                      Problems* problems) {
  const std::optional<std::string> name = ReadFileName(value);
  if (!name) return std::nullopt;
  const std::optional<CsvTable> table = ReadCsvTable(folder, *name, value, problems);
  if (!table) return std::nullopt;
  const TimeColumn times = ReadTimeColumn(*table, TimeOrder::kIncreasing, problems);
  const std::string first = times.name.empty() ? "t" : times.name;
  const std::vector<std::string> columns = {first, "x", "y", "z", "qx", "qy", "qz", "qw"};
  if (!CheckColumns(*table, columns, "a motion file", problems)) return std::nullopt;

  ClampMotion motion;
  motion.file = *name;
  motion.quasi_static = times.quasi_static;
  motion.t = times.t;
  Eigen::Matrix<Eigen::Index, 7, 1> at;
  for (int k = 0; k < 7; ++k) at[k] = *table->Find(columns[k + 1]);
  RowProblems rows(table->path, problems);
  for (Eigen::Index i = 0; i < table->values.rows(); ++i) {
    const auto row = table->values.row(i);
    Pose pose;
    pose.p = {row[at[0]], row[at[1]], row[at[2]]};
    pose.q.coeffs() << row[at[3]], row[at[4]], row[at[5]], row[at[6]];
    const double norm = pose.q.coeffs().stableNorm();
    if (std::abs(norm - 1) > kQuaternionTolerance) {
      rows.Add(CsvTable::LineOf(i), "qx, qy, qz, qw",
               "got a quaternion of length " + FormatRounded(norm) +
                   ", expected unit length within " + FormatRounded(kQuaternionTolerance));
    }
    if (std::abs(norm - 1) > kRounding) pose.q.coeffs() /= norm;
    motion.poses.push_back(pose);
  }
  return motion;
}

}  // namespace cosserat_cable
