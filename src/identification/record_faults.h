// Samples that no sensor saw: clipped at the end of its range, or frozen.
#pragma once

#include <Eigen/Core>
#include <string>

namespace cosserat_cable {

/// What makes the record no measurement of a motion: not finite, times that do not increase,
/// constant, clipped, frozen; with numbers and times. Empty where nothing does. A signal that has
/// decayed below its sensor's resolution is none of these.
std::string FaultOf(const Eigen::VectorXd& t, const Eigen::VectorXd& y);

}  // namespace cosserat_cable
