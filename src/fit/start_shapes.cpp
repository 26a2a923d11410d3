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
// Frequencies that differ by less, of the one, are one.
constexpr double kOneFrequency = 1e-3;
// Of what the shape that the channels see best does to them: below, they do not see it.
constexpr double kSeen = 1e-3;

/// Value of a field at the node that is nearest to `s`.
const Eigen::Vector3d& At(const std::vector<Eigen::Vector3d>& field, double s, double length) {
  const auto last = field.size() - 1;
  const double x = std::clamp(s / length, 0.0, 1.0) * static_cast<double>(last);
  return field[std::min(static_cast<std::size_t>(std::lround(x)), last)];
}

/// What an amplitude of one does to each channel, roughly: to first order, at its largest.
Eigen::VectorXd EffectsOf(const SwingShape& shape, const Experiment& experiment, double length) {
  const EndCondition& a = experiment.a;
  const Eigen::Quaterniond q_a = a.motion ? a.motion->poses.front().q : a.pose.q;
  Eigen::VectorXd effects = Eigen::VectorXd::Zero(static_cast<int>(experiment.channels.size()));
  for (std::size_t c = 0; c < experiment.channels.size(); ++c) {
    const Channel& channel = experiment.channels[c];
    const Eigen::Vector3d moved = At(shape.displacement, channel.s, length);
    const double along =
        (channel.in_frame_a ? Eigen::Vector3d(q_a.conjugate() * moved) : moved)[channel.axis];
    const double about = At(shape.rotation, channel.s, length).z();
    double& effect = effects[static_cast<Eigen::Index>(c)];
    switch (channel.quantity) {
      case Quantity::kPosition:
        effect = along;
        break;
      case Quantity::kVelocity:
        effect = shape.w * along;
        break;
      case Quantity::kAcceleration:
        effect = shape.w * shape.w * along;
        break;
      case Quantity::kAngle:
        effect = about;
        break;
      case Quantity::kRate:
        effect = shape.w * about;
        break;
      case Quantity::kForce:
      case Quantity::kMoment:
        break;
    }
  }
  return effects;
}

void Turn(double c, double s, std::vector<Eigen::Vector3d>* first,
          std::vector<Eigen::Vector3d>* second) {
  for (std::size_t i = 0; i < first->size(); ++i) {
    const Eigen::Vector3d one = (*first)[i], other = (*second)[i];
    (*first)[i] = c * one + s * other;
    (*second)[i] = c * other - s * one;
  }
}

/// Two modes of one frequency, a straight cable's in any two planes, so that the channels see most
/// of the first and least of the second.
void TurnToChannels(const Experiment& experiment, double length, SwingShape* first,
                    SwingShape* second) {
  const Eigen::VectorXd e = EffectsOf(*first, experiment, length),
                        f = EffectsOf(*second, experiment, length);
  const double angle = 0.5 * std::atan2(2 * e.dot(f), e.squaredNorm() - f.squaredNorm());
  const double c = std::cos(angle), s = std::sin(angle);
  Turn(c, s, &first->displacement, &second->displacement);
  Turn(c, s, &first->rotation, &second->rotation);
}

}  // namespace

std::vector<StartShape> StartShapes(const Experiment& experiment, const Specimen& specimen) {
  const Record& record = experiment.record;
  const double fastest = record.t.size() > 1 ? kPi / MedianInterval(record.t) : 0.0;  // [rad/s]
  std::vector<StartShape> seen;
  std::vector<double> effects;
  double slowest = 0;  // [rad/s] of what swings: clamps that may roll let the whole cable turn
  const double length = specimen.cable.length;
  std::vector<SwingShape> shapes =
      FindSwingShapes(experiment, specimen, specimen.cable.elements, kMostShapes);
  for (std::size_t k = 0; k + 1 < shapes.size(); ++k)
    if (shapes[k + 1].w - shapes[k].w < kOneFrequency * shapes[k].w)
      TurnToChannels(experiment, length, &shapes[k], &shapes[k + 1]);
  for (SwingShape& shape : shapes) {
    if (!seen.empty() && shape.w > fastest) continue;
    const Eigen::VectorXd by = EffectsOf(shape, experiment, length);
    const double effect = by.squaredNorm();
    double ranges = 0;
    for (Eigen::Index c = 0; c < by.size(); ++c) {
      if (by[c] == 0) continue;
      const auto column = record.values.col(c);
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
