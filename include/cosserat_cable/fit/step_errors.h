// Which records' steps in space and time move what is fitted.
#pragma once

#include "cosserat_cable/fit/record_jacobian.h"
#include "cosserat_cable/fit/record_model.h"

namespace cosserat_cable {

/// Finer runs behind the corrections of experiments whose remaining errors move the unknowns: by
/// more than a part of a standard deviation of any of them. `jacobian`: of the residuals over
/// `noise`, by the unknowns in units of their scales.
/// @return whether any experiment's runs are finer now
bool SharpenWhereItMoves(const RecordJacobian& jacobian, const NoiseLevels& noise,
                         RecordModel* model);

}  // namespace cosserat_cable
