// Stretches of samples that a sensor did not measure: it stood still, or it was at its limit.
//
// Where a sensor is logged faster than it measures, each of its values stands several times; counts
// of samples below are then of such values.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace cosserat_cable {

/// Neighbouring samples of one value.
struct SampleRun {
  Eigen::Index first = 0;
  Eigen::Index count = 0;
};

/// Runs of ten and more equal samples in a signal that otherwise changes with most of its samples.
std::vector<SampleRun> FrozenRuns(const Eigen::Ref<const Eigen::VectorXd>& values);

/// Runs of three and more equal samples at the signal's largest or smallest value, where at least
/// two of them, or one of five samples, are reached by steps larger than the signal's resolution:
/// the turning point of a coarsely quantised oscillation is no clipping.
std::vector<SampleRun> ClippedRuns(const Eigen::Ref<const Eigen::VectorXd>& values);

}  // namespace cosserat_cable
