#include "strength.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

namespace cosserat_cable::generator {

std::vector<Experiment> withEffects(std::vector<Experiment> experiments,
                                    const std::vector<EffectChoice>& choices) {
  for (Experiment& e : experiments) {
    e.effects = choices;
    if (e.held && e.pull.norm() > 0.0) e.held = pulledEnd(e, e.pull, e.pull.norm());
  }
  return experiments;
}

Strength sizeFor(const Variation& variation, double target, double snr,
                 const std::vector<Experiment>& experiments, const EffectScale& scale) {
  constexpr int kTries = 6;
  constexpr double kNear = 1.25;  // either way
  constexpr double kFurthest = 4.0;
  double size = std::min(variation.first, variation.largest), largest = variation.largest;
  double weak = 0.0, strong = std::numeric_limits<double>::infinity();
  Eigen::Vector4d guess = Eigen::Vector4d::Zero();
  std::unique_ptr<Recalibration> recalibration;
  Strength best;
  double least = std::numeric_limits<double>::infinity();
  for (int attempt = 0; attempt < kTries; ++attempt) {
    Strength now;
    now.size = size;
    try {
      const auto rigged = withEffects(experiments, choicesOf({variation}, {size}, scale));
      if (!recalibration) recalibration = std::make_unique<Recalibration>(rigged, snr);
      now.left = recalibration->fit(rigged, guess);
    } catch (const std::runtime_error&) {
      // So large that the cable no longer gets to where it is to be held.
      largest = 0.7 * size;
      size = 0.5 * size;
      continue;
    }
    const double off = std::abs(std::log(now.left.strength / target));
    if (off < least) {
      least = off;
      best = now;
    }
    if (off < std::log(kNear)) break;
    const bool more = now.left.strength < target;
    if (more && size >= largest) break;
    (more ? weak : strong) = size;
    double next = size * std::clamp(target / now.left.strength, 1.0 / kFurthest, kFurthest);
    if (next <= weak || next >= strong) next = std::sqrt(std::max(weak, 0.1 * strong) * strong);
    next = std::min(next, largest);
    guess = next / size * now.left.change;
    size = next;
  }
  if (!std::isfinite(least)) throw std::runtime_error("the effect has no possible size");
  return best;
}

}  // namespace cosserat_cable::generator
