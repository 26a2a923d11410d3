// A case with a known answer: what that is, what this package gives. The rows go into the test's
// XML report, from which scripts/validation makes docs/validation.md.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

namespace cosserat_cable {

struct ValidationRow {
  std::string section;  ///< of the table, as scripts/validation has them
  std::string what;     ///< the case and the quantity, with its unit; of a cause: "NAME: ..."
  std::string source;   ///< where the target is from
  double target;
  double ours;
  double tolerance;  ///< largest |ours - target| allowed
  int elements;
  double dt = 0;  ///< [s]; 0: statics or modal analysis
};

/// A number as part of a row's name.
inline std::string Shown(double x) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.5g", x);
  return text;
}

/// Fails where the row is beyond its tolerance; records it in any case.
inline void Validate(const ValidationRow& row) {
  EXPECT_LE(std::abs(row.ours - row.target), row.tolerance)
      << row.what << ": got " << row.ours << ", expected " << row.target;
  static int count = 0;
  char numbers[160];
  std::snprintf(numbers, sizeof(numbers), "|%.9g|%.9g|%.9g|%d|%.9g", row.target, row.ours,
                row.tolerance, row.elements, row.dt);
  ::testing::Test::RecordProperty("validation_" + std::to_string(count++),
                                  row.section + "|" + row.what + "|" + row.source + numbers);
}

}  // namespace cosserat_cable
