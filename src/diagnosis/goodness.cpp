#include "goodness.h"

#include <algorithm>
#include <cmath>

namespace cosserat_cable {
namespace {

// Noise levels, simulations and laws are right within a few per cent: what is left may exceed the
// noise's variance by this part, where a set gives the level and where it is estimated.
constexpr double kTolerance = 0.10, kToleranceOfEstimate = 0.25;
constexpr double kBeyondChance = 4;
// Blocks of a record, for paired differences: long enough to be independent of each other.
constexpr Eigen::Index kBlocks = 8;

}  // namespace

Correlations CorrelationsOf(const FitPoint& point) {
  Correlations correlations;
  for (const Eigen::MatrixXd& left : point.residuals) {
    Eigen::VectorXd of = Eigen::VectorXd::Ones(left.cols());
    for (Eigen::Index c = 0; c < left.cols(); ++c)
      if (left.rows() > 2 && !left.col(c).isZero())
        of[c] = std::max(1.0, ColourOf(left.col(c)).correlation_samples);
    correlations.push_back(of);
  }
  return correlations;
}

Adequacy AdequacyOf(const FitPoint& point, const SetNoise& noise) {
  Adequacy adequacy;
  double variance = 0, tolerance = 0;
  for (std::size_t e = 0; e < point.residuals.size(); ++e)
    for (Eigen::Index c = 0; c < point.residuals[e].cols(); ++c) {
      const NoiseLevel& level = noise.sources[e][static_cast<std::size_t>(c)];
      const Eigen::VectorXd left =
          point.residuals[e].col(c) * (point.noise[e][c] / noise.levels[e][c]);
      const auto n = static_cast<double>((left.array() != 0).count());
      if (n < 1) continue;
      const NoiseColour colour = ColourOf(left);
      double squares = 1;
      for (std::size_t lag = 1; lag < colour.autocorrelation.size(); ++lag)
        squares += 2 * colour.autocorrelation[lag] * colour.autocorrelation[lag];
      adequacy.chi2 += left.squaredNorm();
      adequacy.expected += n;
      variance += 2 * n * squares;
      if (std::isfinite(level.freedom) && level.freedom > 0) variance += 2 * n * n / level.freedom;
      tolerance +=
          n * (level.source == NoiseLevel::Source::kGiven ? kTolerance : kToleranceOfEstimate);
    }
  adequacy.expected = std::max(1.0, adequacy.expected - static_cast<double>(point.values.size()));
  adequacy.sd = std::sqrt(variance);
  adequacy.adequate = adequacy.excess() < std::max(tolerance, kBeyondChance * adequacy.sd);
  return adequacy;
}

Difference DifferenceOf(const Records& worse, const Records& better,
                        const Correlations& correlations) {
  Difference difference;
  std::vector<double> blocks;
  for (std::size_t e = 0; e < worse.size(); ++e) {
    if (worse[e].rows() != better[e].rows()) continue;
    const Eigen::Index rows = worse[e].rows(), count = std::min(kBlocks, rows);
    for (Eigen::Index block = 0; block < count; ++block) {
      const Eigen::Index from = block * rows / count, until = (block + 1) * rows / count;
      double sum = 0;
      for (Eigen::Index c = 0; c < worse[e].cols(); ++c)
        sum += (worse[e].col(c).segment(from, until - from).squaredNorm() -
                better[e].col(c).segment(from, until - from).squaredNorm()) /
               correlations[e][c];
      blocks.push_back(sum);
      difference.value += sum;
    }
    const double gained = worse[e].squaredNorm() - better[e].squaredNorm();
    const auto samples = static_cast<double>(std::max<Eigen::Index>(1, worse[e].size()));
    difference.most_per_sample = std::max(difference.most_per_sample, gained / samples);
  }
  const auto n = static_cast<double>(blocks.size());
  double squares = 0;
  for (const double block : blocks) squares += std::pow(block - difference.value / n, 2);
  if (n > 1) difference.se = std::sqrt(squares * n / (n - 1));
  return difference;
}

}  // namespace cosserat_cable
