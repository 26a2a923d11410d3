// A plan as text.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "cosserat_cable/identification/plan.h"

namespace cosserat_cable {

nlohmann::json PlanJson(const Plan& plan);
/// The best few, for the terminal.
std::string PlanTable(const Plan& plan);

}  // namespace cosserat_cable
