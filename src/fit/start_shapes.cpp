#include "start_shapes.h"

#include <algorithm>
#include <cmath>

namespace cosserat_cable {
namespace {

constexpr double kPi = 3.14159265358979323846;
// In both planes of a straight cable: four bending shapes each. What the fifth has of a pull at the
// end is a thousandth of the first's.
constexpr int kMostShapes = 8;
// A start is this many times what its record ranges over at most.
constexpr double kGenerous = 3;
// Of what the shape that the channels see best does to them: below, they do not see it.
constexpr double kSeen = 1e-3;

/// What an amplitude of one does to a channel, roughly.
double EffectOn(const Channel& channel, const SwingShape& shape, double length) {
  const auto last = shape.displacement.size() - 1;
  const double x = std::clamp(channel.s / length, 0.0, 1.0) * static_cast<double>(last);
  const auto node = std::min(static_cast<std::size_t>(std::lround(x)), last);
  switch (channel.quantity) {
    case Quantity::kPosition:
      return shape.displacement[node].norm();
    case Quantity::kVelocity:
      return shape.w * shape.displacement[node].norm();
    case Quantity::kAcceleration:
      return shape.w * shape.w * shape.displacement[node].norm();
    case Quantity::kAngle:
      return std::abs(shape.rotation[node].z());
    case Quantity::kRate:
      return shape.w * std::abs(shape.rotation[node].z());
    case Quantity::kForce:
    case Quantity::kMoment:
      return 0;
  }
  return 0;
}

}  // namespace

std::vector<StartShape> StartShapes(const Experiment& experiment, const Specimen& specimen) {
  const Record& record = experiment.record;
  const double fastest = record.t.size() > 1 ? kPi / MedianInterval(record.t) : 0.0;  // [rad/s]
  std::vector<StartShape> seen;
  std::vector<double> effects;
  double slowest = 0;  // [rad/s] of what swings: clamps that may roll let the whole cable turn
  const double length = specimen.cable.length;
  for (SwingShape& shape :
       FindSwingShapes(experiment, specimen, specimen.cable.elements, kMostShapes)) {
    if (!seen.empty() && shape.w > fastest) continue;
    double ranges = 0, effect = 0;
    for (std::size_t c = 0; c < experiment.channels.size(); ++c) {
      const double by = EffectOn(experiment.channels[c], shape, length);
      if (by == 0) continue;
      const auto column = record.values.col(static_cast<Eigen::Index>(c));
      effect += by * by;
      ranges += std::pow(column.maxCoeff() - column.minCoeff(), 2);
    }
    if (slowest == 0) slowest = shape.w;
    const double slowness = shape.w > slowest ? slowest / shape.w : 1.0;
    // Shapes have a largest displacement of 1 m, or turn of 1 rad: where only forces are measured.
    double size = 0.1 * length;
    if (effect > 0) size = kGenerous * std::sqrt(ranges / effect);
    seen.push_back({std::move(shape), size * slowness});
    effects.push_back(std::sqrt(effect));
  }
  const double best = effects.empty() ? 0 : *std::max_element(effects.begin(), effects.end());
  std::vector<StartShape> kept;
  for (std::size_t k = 0; k < seen.size(); ++k)
    if (effects[k] >= kSeen * best && seen[k].size > 0) kept.push_back(std::move(seen[k]));
  return kept;
}

}  // namespace cosserat_cable
