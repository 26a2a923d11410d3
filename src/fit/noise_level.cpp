#include "cosserat_cable/fit/noise_level.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace cosserat_cable {
namespace {

constexpr int kOrder = 6;  // of the differences
// Fewer differences than this are too few to tell jumps from noise.
constexpr int kFewestDifferences = 30;
// From one distance to twice that, correlated noise shows sqrt(2) times as much at most
// (exponential correlation), and of a short record by chance up to 2.5 times; a resolved signal 64
// times. Where it grows by less than this, the signal is sqrt(8)/64 of what was seen before at most.
constexpr double kMostOfColour = 3;
// Standard deviations by which noise must be larger at a distance to count as correlated.
constexpr double kBeyondChanceOfColour = 2.0;
// Degrees of freedom of sixth differences of white noise, by sample: 3.2 of them are worth one for
// their correlation, and leaving out the largest costs a fifth.
constexpr double kFreedomOfDifferences = 0.8 / 3.2;
// Short records: the degree of the polynomial that stands for the signal, by sample and at most.
constexpr int kSamplesPerDegree = 4, kHighestDegree = 5;
constexpr int kFewestFreedom = 3;
// Poses and forces this near are the same.
constexpr double kSameInput = 1e-9;
// An rms so many times the noise is a misfit where it is so many standard deviations of the
// logarithm of the ratio of variances beyond it.
constexpr double kMisfit = 1.5, kBeyondChance = 3.0;

/// Weights of a divided difference of these times, as a unit vector: white noise keeps its size.
template <int N>
Eigen::Matrix<double, N, 1> DifferenceWeights(const Eigen::Matrix<double, N, 1>& t) {
  Eigen::Matrix<double, N, 1> weight;
  const double span = t[N - 1] - t[0];
  for (int i = 0; i < N; ++i) {
    double product = 1;
    for (int k = 0; k < N; ++k)
      if (k != i) product *= N * (t[i] - t[k]) / span;
    weight[i] = 1 / product;
  }
  return weight.normalized();
}

struct Level {
  double sd = std::numeric_limits<double>::infinity();
  int count = 0;
};

/// From differences of samples that lie `apart` samples from each other.
Level LevelAt(const std::vector<double>& t, const Eigen::VectorXd& y, const Eigen::VectorXd& usable,
              int apart) {
  std::vector<double> size;
  const auto n = static_cast<int>(y.size());
  for (int first = 0; first + kOrder * apart < n; ++first) {
    Eigen::Matrix<double, kOrder + 1, 1> times, values;
    bool whole = true;
    for (int k = 0; k <= kOrder; ++k) {
      const int i = first + k * apart;
      times[k] = t[static_cast<std::size_t>(i)];
      values[k] = y[i];
      whole = whole && usable[i] > 0;
    }
    if (whole) size.push_back(std::abs(DifferenceWeights<kOrder + 1>(times).dot(values)));
  }
  if (static_cast<int>(size.size()) < kFewestDifferences) return {};
  const auto middle = size.begin() + static_cast<std::ptrdiff_t>(size.size() / 2);
  std::nth_element(size.begin(), middle, size.end());
  // The median resists jumps: 0.6745 of a normal distribution's standard deviation. What is not
  // far beyond it tells more; of a normal distribution's square, kOfSquare lies within.
  constexpr double kWithin = 2.5, kOfSquare = 0.91126;
  const double most = kWithin * *middle / 0.6745;
  double square = 0, kept = 0;
  for (const double one : size)
    if (one <= most) {
      square += one * one;
      ++kept;
    }
  return {std::sqrt(square / kept / kOfSquare), static_cast<int>(size.size())};
}

NoiseLevel OfLongRecord(const std::vector<double>& t, const std::vector<Eigen::VectorXd>& signals,
                        const Eigen::VectorXd& usable) {
  const auto at = [&](int apart) {
    Level least;
    for (const Eigen::VectorXd& y : signals) {
      const Level level = LevelAt(t, y, usable, apart);
      if (level.sd < least.sd) least = level;
    }
    return least;
  };
  NoiseLevel result;
  const Level neighbours = at(1);
  Level here = neighbours;
  if (here.count == 0) return result;
  result.freedom = kFreedomOfDifferences * here.count;
  result.sd = here.sd;
  const double by_chance = 1 + kBeyondChanceOfColour / std::sqrt(2 * result.freedom);
  for (int apart = 2; 2 * kOrder * apart < static_cast<int>(t.size()); apart *= 2) {
    const Level next = at(apart);
    if (next.count == 0) break;
    // What is seen here is noise where it does not grow as a signal's differences do.
    if (next.sd > kMostOfColour * here.sd) break;
    result.source = NoiseLevel::Source::kRecord;
    if (here.sd > by_chance * result.sd) result.sd = here.sd;
    here = next;
  }
  // Neighbours show q = (1 - rho)/(1 + rho) of the variance of noise that keeps rho from sample to
  // sample, and the mean of its squares has (1 - rho^2)/(1 + rho^2) of white noise's freedom.
  const double q = std::pow(neighbours.sd / result.sd, 2);
  if (q < 1) result.freedom *= 2 * q / (1 + q * q);
  return result;
}

/// Of what a polynomial over the steps leaves; the smallest of the signals'.
NoiseLevel OfShortRecord(const std::vector<double>& t, const std::vector<Eigen::VectorXd>& signals,
                         const Eigen::VectorXd& usable) {
  NoiseLevel result;
  std::vector<int> rows;
  for (int i = 0; i < usable.size(); ++i)
    if (usable[i] > 0) rows.push_back(i);
  const auto n = static_cast<int>(rows.size());
  const int degree = std::clamp(n / kSamplesPerDegree, 1, kHighestDegree);
  const int freedom = n - degree - 1;
  if (freedom < kFewestFreedom) return result;
  Eigen::MatrixXd powers(n, degree + 1);
  for (int i = 0; i < n; ++i) {
    const double x = 2 * (t[static_cast<std::size_t>(rows[i])] - t.front()) /
                         std::max(t.back() - t.front(), 1e-300) -
                     1;
    powers(i, 0) = 1;
    for (int k = 1; k <= degree; ++k) powers(i, k) = powers(i, k - 1) * x;
  }
  const Eigen::MatrixXd q =
      powers.householderQr().householderQ() * Eigen::MatrixXd::Identity(n, degree + 1);
  double least = std::numeric_limits<double>::infinity();
  for (const Eigen::VectorXd& y : signals) {
    Eigen::VectorXd values(n);
    for (int i = 0; i < n; ++i) values[i] = y[rows[i]];
    least = std::min(least, (values - q * (q.transpose() * values)).squaredNorm());
  }
  result.source = NoiseLevel::Source::kRecord;
  result.sd = std::sqrt(least / freedom);
  result.freedom = freedom;
  return result;
}

Eigen::VectorXd RowOf(const EndCondition& end, int step) {
  if (!end.motion || end.motion->poses.empty()) return Eigen::VectorXd::Zero(7);
  const auto last = static_cast<int>(end.motion->poses.size()) - 1;
  const Pose& pose = end.motion->poses[static_cast<std::size_t>(std::clamp(step, 0, last))];
  Eigen::VectorXd row(7);
  row << pose.p, (pose.q.w() < 0 ? -1.0 : 1.0) * pose.q.coeffs();
  return row;
}

/// All that is done to the cable at each step: a column per step.
Eigen::MatrixXd InputsOf(const Experiment& experiment) {
  const auto steps = static_cast<int>(experiment.record.t.size());
  Eigen::MatrixXd inputs = Eigen::MatrixXd::Zero(14 + 6, steps);
  for (int i = 0; i < steps; ++i) {
    const double t = experiment.record.t[static_cast<std::size_t>(i)];
    const int step = static_cast<int>(std::lround(t));
    inputs.col(i).head(7) = RowOf(experiment.a, step);
    inputs.col(i).segment(7, 7) = RowOf(experiment.b, step);
    if (experiment.load.file.empty()) continue;
    // Force and its moment of arc length: what tells one step's forces from another's.
    for (const ExperimentLoad::Sample& sample : experiment.load.samples)
      if (sample.t == t) {
        inputs.col(i).segment<3>(14) += sample.force_W;
        inputs.col(i).segment<3>(17) += sample.s * sample.force_W;
      }
  }
  return inputs;
}

/// Steps at which the same is done: groups of rows. `neighbours`: only one after the other.
NoiseLevel OfRepeats(const Experiment& experiment, const Eigen::VectorXd& y, bool neighbours) {
  const Eigen::MatrixXd inputs = InputsOf(experiment);
  const auto n = static_cast<int>(y.size());
  std::vector<std::vector<int>> groups;
  for (int i = 0; i < n; ++i) {
    const auto same = [&](const std::vector<int>& group) {
      const Eigen::VectorXd& first = inputs.col(group.front());
      const double scale = std::max(1e-3, first.cwiseAbs().maxCoeff());
      return (!neighbours || group.back() == i - 1) &&
             (inputs.col(i) - first).cwiseAbs().maxCoeff() <= kSameInput * scale;
    };
    const auto place = std::find_if(groups.begin(), groups.end(), same);
    if (place == groups.end())
      groups.push_back({i});
    else
      place->push_back(i);
  }
  NoiseLevel result;
  double sum = 0;
  for (const std::vector<int>& group : groups) {
    double mean = 0;
    for (const int i : group) mean += y[i] / static_cast<double>(group.size());
    for (const int i : group) sum += (y[i] - mean) * (y[i] - mean);
    result.freedom += static_cast<double>(group.size()) - 1;
  }
  if (result.freedom < kFewestFreedom) return {};
  result.source = NoiseLevel::Source::kRepeats;
  result.sd = std::sqrt(sum / result.freedom);
  return result;
}

}  // namespace

NoiseLevel LevelOf(const Experiment& experiment, int column, const Eigen::VectorXd& usable,
                   const Eigen::VectorXd& simulated) {
  const Channel& channel = experiment.channels[static_cast<std::size_t>(column)];
  if (channel.sigma)
    return {NoiseLevel::Source::kGiven, *channel.sigma, std::numeric_limits<double>::infinity()};
  std::vector<Eigen::VectorXd> signals = {experiment.record.values.col(column)};
  if (signals.front().size() < 2) return {};
  if (simulated.size() == signals.front().size()) signals.push_back(signals.front() - simulated);
  const std::vector<double>& t = experiment.record.t;
  if (experiment.quasi_static()) {
    const NoiseLevel repeats = OfRepeats(experiment, signals.front(), true);
    if (repeats.source != NoiseLevel::Source::kUnknown) return repeats;
  }
  NoiseLevel level = OfLongRecord(t, signals, usable);
  if (!experiment.quasi_static() || level.source != NoiseLevel::Source::kUnknown) return level;
  level = OfShortRecord(t, signals, usable);
  if (level.source != NoiseLevel::Source::kUnknown) return level;
  return OfRepeats(experiment, signals.front(), false);
}

double TimesNoise(double rms, const NoiseLevel& level) {
  return level.source != NoiseLevel::Source::kUnknown && level.sd > 0 ? rms / level.sd : 0.0;
}

bool IsMisfit(double rms, double samples, const NoiseLevel& level) {
  const double times = TimesNoise(rms, level);
  if (!(times > kMisfit) || !(samples > 0)) return false;
  const double spread = std::sqrt(2 / samples + 2 / level.freedom);
  return 2 * std::log(times) > kBeyondChance * spread;
}

}  // namespace cosserat_cable
