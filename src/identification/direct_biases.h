// By how much the source paper's formulas are off for a rig.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "cosserat_cable/identification/direct_evaluation.h"

namespace cosserat_cable {

/// What the formulas want to know of a specimen: keys of the experiment, or else of the set.
struct Specimen {
  Specimen(const MeasurementSet& set, const Experiment& experiment);

  std::optional<SectionShape> shape;
  std::optional<double> length, mass_per_length, GJ, EA;
  std::optional<std::array<double, 2>> EI, GA;
  std::vector<LumpedMass> masses;
};

/// The first clamped-free bending mode's root mu0.
constexpr double kFirstRoot = 1.87510407;

/// The first clamped-free bending mode at s = x L, over its value at the tip.
double CantileverShape(double x);

/// `ring` has its frequency; tip_amplitude [m] at the first sample where it was seen.
/// @pre length and mass_per_length are known
void AddBendingBiases(const Specimen& specimen, const Experiment& experiment,
                      std::optional<double> tip_amplitude, DirectRingDown* ring);

/// @pre length is known
void AddTorsionBiases(const Specimen& specimen, const Experiment& experiment, DirectRingDown* ring);

}  // namespace cosserat_cable
