#include "strength.h"

#include <Eigen/QR>
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

double separation(const Variation& cause, double size, const EffectKind& rival,
                  const std::string& rival_form, double snr,
                  const std::vector<Experiment>& experiments, const EffectScale& scale,
                  Random* random) {
  constexpr int kForms = 8;
  constexpr double kSmall = 0.1;  // of a usual size: still linear
  const auto rigged = withEffects(experiments, choicesOf({cause}, {size}, scale));
  const Recalibration recalibration(rigged, snr);
  const Eigen::VectorXd left = recalibration.fit(rigged, Eigen::Vector4d::Zero()).residual;
  Eigen::MatrixXd columns(left.size(), 4 + kForms);
  columns.leftCols<4>() = recalibration.derivatives();
  for (int i = 0; i < kForms; ++i) {
    const Variation form = varied(rival, scale, rival_form, random);
    // Held where the cause has the cable held, as a rival's model would have it.
    std::vector<Experiment> other = plain(rigged);
    for (Experiment& e : other) e.effects = choicesOf({form}, {kSmall}, scale);
    columns.col(4 + i) = recalibration.fit(other, Eigen::Vector4d::Zero()).residual / kSmall;
  }
  return (left - columns * columns.colPivHouseholderQr().solve(left)).norm();
}

}  // namespace cosserat_cable::generator
