// What an answer says of a fit: where it leaves more than noise, which interval holds, and what
// slip stands behind a reason.
#pragma once

#include <string>
#include <vector>

#include "cosserat_cable/fit/unknowns.h"
#include "cosserat_cable/identification/estimation.h"

namespace cosserat_cable {

/// The residual against a noise level that the fit had no part in. Sets `times_noise` and `misfit`.
void Judge(const Experiment& experiment, ChannelFit* channel, std::vector<std::string>* warnings);

/// Reasons that were read off a bad fit say nothing; what the record would fit with does.
void NameSlips(const Unknowns& unknowns, Estimation* estimation);

}  // namespace cosserat_cable
