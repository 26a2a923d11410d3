#include "least_squares.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace cosserat_cable {
namespace {

// Damping, in parts of the Gram matrix's diagonal: the first, from one trial to the next, and where
// it stops.
constexpr double kFirstDamping = 1e-3, kRatio = 10, kSmallest = 1e-12, kLargest = 1e12;
// What a step must gain, in parts of the gain that ends the search.
constexpr double kWorthwhile = 0.01;
// Of the best step's gain: not worth a linearisation elsewhere.
constexpr double kNearlyAsMuch = 0.5;
// So many steps in a row that gain less than what ends the search, although more is promised.
constexpr int kSmallGains = 3;
// The aim is out of reach where so many times what is promised does not lead there, so many times
// in a row.
constexpr double kPromised = 4;
constexpr int kOutOfReach = 3;
// Where derivatives are kept, new ones are asked for by a step that gains less than the first part
// of what it promised, or less than the second of what a step without damping promises: damping
// makes up for derivatives that are not right any more, by small steps.
constexpr double kAsPromised = 0.3, kHeldBack = 0.1;
// Of the largest diagonal entry: a direction that no residual shows is not followed.
constexpr double kZeroDiagonal = 1e-14;
// Mean square of the residuals, in the noise's variance, above which they are no noise; and the
// part of the rest that is not worth an iteration.
constexpr double kMuchNoise = 4, kOfMisfit = 3e-5;

/// What moves in an iteration: not held, shown, and not at a bound that it is pushed against.
std::vector<Eigen::Index> FreeOf(const Eigen::VectorXd& x,
                                 const LeastSquaresProblem::Linearisation& at,
                                 const LeastSquaresOptions& options) {
  std::vector<Eigen::Index> free;
  const double unseen = kZeroDiagonal * at.gram.diagonal().maxCoeff();
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    if (!options.held.empty() && options.held[static_cast<std::size_t>(i)]) continue;
    if (!(at.gram(i, i) > unseen)) continue;
    if (x[i] <= options.lower[i] && at.gradient[i] >= 0) continue;
    if (x[i] >= options.upper[i] && at.gradient[i] <= 0) continue;
    free.push_back(i);
  }
  return free;
}

/// The damped step over the free unknowns, zero for the others. `tied`: by unknown, twice what it
/// costs to move by one. `gain`: what the linear model promises.
Eigen::VectorXd StepOf(const LeastSquaresProblem::Linearisation& at,
                       const std::vector<Eigen::Index>& free, double damping,
                       const Eigen::VectorXd& tied, double* gain) {
  const auto n = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd gram(n, n);
  Eigen::VectorXd gradient(n), unit(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    unit[i] = 1 / std::sqrt(at.gram(free[i], free[i]));
    gradient[i] = unit[i] * at.gradient[free[i]];
  }
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < n; ++k) gram(i, k) = unit[i] * unit[k] * at.gram(free[i], free[k]);
  Eigen::MatrixXd damped = gram;
  for (Eigen::Index i = 0; i < n; ++i) damped(i, i) += damping + unit[i] * unit[i] * tied[free[i]];
  const Eigen::VectorXd step = -damped.ldlt().solve(gradient);
  *gain = -(gradient.dot(step) + 0.5 * step.dot(gram * step));
  Eigen::VectorXd all = Eigen::VectorXd::Zero(at.gradient.size());
  for (Eigen::Index i = 0; i < n; ++i) all[free[i]] = unit[i] * step[i];
  return all;
}

struct Place {
  double cost = std::numeric_limits<double>::infinity();
  Eigen::VectorXd x;
};

/// The point that is the best of several, if it gains enough.
struct Best {
  double cost;  ///< to be undercut
  int index = -1;

  void Offer(double other, int i) {
    if (!(other < cost)) return;
    cost = other;
    index = i;
  }
};

}  // namespace

Eigen::VectorXd Ties(const Eigen::VectorXd& x, double variance) {
  return variance * x.cwiseAbs().cwiseMax(1).cwiseAbs2().cwiseInverse();
}

LeastSquaresResult Minimise(const Eigen::VectorXd& start, const LeastSquaresOptions& options,
                            LeastSquaresProblem* problem) {
  using End = LeastSquaresResult::End;
  using Renew = LeastSquaresProblem::Renew;
  LeastSquaresResult result;
  result.x = start.cwiseMax(options.lower).cwiseMin(options.upper);
  double damping = kFirstDamping;
  int small_gains = 0, out_of_reach = 0;
  Renew way = options.renew, next_renew = way;
  std::vector<double> costs;
  LeastSquaresProblem::Linearisation at = problem->Linearise(result.x, {}, way, &costs);
  if (!at.ok) return result;
  const auto renewed = [&](Renew renew) {
    if (way == Renew::kNone) way = next_renew = Renew::kSome;
    LeastSquaresProblem::Linearisation here = problem->Linearise(result.x, {}, renew, &costs);
    if (!here.ok) return false;
    at = std::move(here);
    return true;
  };
  // Nothing ends by derivatives that are not those of the place.
  const auto completed = [&] {
    if (at.whole || !options.finish || !renewed(Renew::kAll)) return false;
    damping = kFirstDamping;
    small_gains = 0;
    return true;
  };
  result.end = End::kStuck;
  for (;; ++result.iterations) {
    result.cost = at.cost;
    const std::vector<Eigen::Index> free = FreeOf(result.x, at, options);
    const double noise = std::max(1.0, 2 * at.cost / std::max(options.samples, 1.0));
    double gain = 0, promise = 0;
    const Eigen::VectorXd tied = Ties(result.x, noise);
    StepOf(at, free, kSmallest, tied, &gain);
    StepOf(at, free, kSmallest, Eigen::VectorXd::Zero(tied.size()), &promise);
    result.gain_left = gain / noise;
    // What is more than noise hides more than as much noise would: it goes the same way for long.
    const double of_misfit =
        kOfMisfit * std::max(0.0, at.cost - 0.5 * kMuchNoise * options.samples);
    if (!(gain > std::max(options.small_gain * noise, of_misfit))) {
      if (completed()) continue;
      result.end = End::kMinimum;
      return result;
    }
    if (result.iterations >= options.max_iterations) {
      result.end = End::kIterations;
      return result;
    }
    const bool far = options.aim > 0 && at.cost - kPromised * promise > options.aim;
    out_of_reach = far ? out_of_reach + 1 : 0;
    if (out_of_reach >= kOutOfReach) {
      result.end = End::kFar;
      return result;
    }
    if (small_gains >= kSmallGains) {
      if (completed()) continue;
      return result;
    }
    const double enough = at.cost - kWorthwhile * std::max(options.small_gain * noise, of_misfit);

    // From less damping than did last time to more.
    double tried = std::max(damping / kRatio, kSmallest);
    Place nearest;  // where no derivatives are to be had
    for (bool moved = false; !moved;) {
      if (!problem->GoOn(result.iterations, result.cost)) {
        result.end = End::kStopped;
        return result;
      }
      if (tried > kLargest) {
        if (nearest.cost < result.cost) {
          result.x = nearest.x;
          result.cost = nearest.cost;
          return result;
        }
        if (completed()) break;
        return result;
      }
      const bool first = tried <= damping && way != Renew::kNone;
      std::vector<Eigen::VectorXd> points;
      std::vector<double> dampings, promised;
      const int count = first ? 1 + problem->Room() : problem->SideBySide();
      for (int k = 0; k < count; ++k, tried *= kRatio) {
        double expected = 0;
        Eigen::VectorXd next = result.x + StepOf(at, free, tried, tied, &expected);
        next = next.cwiseMax(options.lower).cwiseMin(options.upper);
        problem->Restrain(result.x, &next);
        if (!next.allFinite()) continue;
        points.push_back(next);
        dampings.push_back(tried);
        promised.push_back(expected);
      }
      if (points.empty()) continue;
      Best best{enough};
      LeastSquaresProblem::Linearisation there;
      if (first) {
        there =
            problem->Linearise(points[0], {points.begin() + 1, points.end()}, next_renew, &costs);
        costs.insert(costs.begin(),
                     there.ok ? there.cost : std::numeric_limits<double>::infinity());
      } else {
        costs = problem->Costs(points);
      }
      for (std::size_t k = 0; k < points.size(); ++k) best.Offer(costs[k], static_cast<int>(k));
      if (best.index < 0 && at.kept) {
        if (!renewed(Renew::kSome)) return result;
        break;
      }
      if (best.index < 0) continue;
      // What is linearised already is taken if it gains nearly as much.
      if (there.ok && there.cost < enough &&
          at.cost - there.cost > kNearlyAsMuch * (at.cost - best.cost))
        best.index = 0;
      const auto k = static_cast<std::size_t>(best.index);
      if (!there.ok || k > 0) there = problem->Linearise(points[k], {}, next_renew, &costs);
      if (!there.ok) {
        // It was simulated, its neighbours cannot be: nearer they perhaps can.
        if (best.cost < nearest.cost) nearest = {best.cost, points[k]};
        continue;
      }
      const double gained = at.cost - there.cost;
      const bool poor = gained < kAsPromised * promised[k];
      const bool held_back = !at.whole && gained < kHeldBack * gain;
      next_renew = (poor || held_back) && way == Renew::kSome ? Renew::kAll : way;
      if (there.kept && poor) {
        LeastSquaresProblem::Linearisation anew =
            problem->Linearise(points[k], {}, Renew::kSome, &costs);
        if (anew.ok) there = std::move(anew);
      }
      small_gains = gained < std::max(options.small_gain * noise, of_misfit) ? small_gains + 1 : 0;
      result.x = points[k];
      damping = dampings[k];
      at = std::move(there);
      moved = true;
    }
  }
}

}  // namespace cosserat_cable
