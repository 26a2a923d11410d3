// The noise of a channel, from its record alone: no fit decides how large it is.
#pragma once

#include <Eigen/Core>

#include "cosserat_cable/measurement/measurement_set.h"

namespace cosserat_cable {

/// How large a channel's noise is, independently of any fit.
struct NoiseLevel {
  enum class Source {
    kUnknown,  ///< there is no way to tell: the fit's own residual has to stand for it
    kGiven,    ///< by the set
    kRecord,   ///< from how rough the record is
    kRepeats   ///< from steps at which the same was done
  };
  Source source = Source::kUnknown;
  double sd = 0;       ///< [the channel's unit]; an upper bound, or zero, where it is unknown
  double freedom = 0;  ///< degrees of freedom of the estimate
};

/// `usable`: one per sample that a sensor measured, zero per other. `simulated`: what a fit left
/// of the record's own curvature; it may be empty, and it may be wrong: the smaller of the levels
/// with and without it counts.
///
/// Over time: differences of sixth order (divided ones, at the record's own times) of samples that
/// lie one, two, four, ... apart. Noise that is correlated from one sample to the next shows whole
/// where they lie far enough apart, and a signal that shows there grows 64 times from one distance
/// to the next. Steps: repeats of the same load one after the other, else what a low polynomial
/// leaves, else returns to the same load. kUnknown where none of these is there: `sd` is an upper
/// bound then, or zero.
NoiseLevel LevelOf(const Experiment& experiment, int column, const Eigen::VectorXd& usable,
                   const Eigen::VectorXd& simulated = Eigen::VectorXd());

/// How many times the noise an rms of so many independent samples is; zero where the level is
/// unknown.
double TimesNoise(double rms, const NoiseLevel& level);

/// Whether it is more than noise, and more than chance makes of two estimates of it.
bool IsMisfit(double rms, double samples, const NoiseLevel& level);

}  // namespace cosserat_cable
