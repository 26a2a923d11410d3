#pragma once

#include "sample_sets.h"

namespace cosserat_cable::generator {

/// What default sizes are measured by in these experiments.
EffectScale effectScale(const std::vector<Experiment>& experiments, const CableData& truth);

/// Records to learn from and one to predict, of the same cable with the same effects.
struct EffectSets {
  MeasurementSet seen, unseen;
};

/// A random cable of little damping without D_E: a small ring-down at full length, a larger one in
/// another plane at 0.8 of it, torsion at 0.6, a sweep of the clamp; unseen a clamp that moves by
/// several sines, tilted otherwise and further.
EffectSets effectSets(std::uint64_t seed, double snr, const EffectPlan& effects);

/// The sweep alone.
MeasurementSet driveSet(std::uint64_t seed, double snr, const EffectPlan& effects);

/// An arch that hangs between clamps half a length apart, both tangents vertical; a is swept in its
/// plane and across it.
MeasurementSet archSet(std::uint64_t seed, double snr, const EffectPlan& effects);

/// Quasi-static records: a force at the tip of a hanging cable goes to and fro twice along a1, and
/// with twice the size along a2.
MeasurementSet bendSet(std::uint64_t seed, double snr, const EffectPlan& effects);

}  // namespace cosserat_cable::generator
