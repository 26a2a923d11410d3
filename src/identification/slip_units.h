// Units that people write a channel in, and numbers as people read them.
#pragma once

#include <string>
#include <vector>

#include "cosserat_cable/measurement/measurement_set.h"

namespace cosserat_cable {

struct Unit {
  double factor;  ///< values in it over values in SI
  const char* name;
};

std::vector<Unit> UnitsOf(Quantity quantity);
/// Lengths in mm, as people read them.
std::string WithUnit(Quantity quantity, double value);
/// "0.40 s"
std::string Seconds(double value);

}  // namespace cosserat_cable
