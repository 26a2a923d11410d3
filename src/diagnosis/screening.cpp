#include "screening.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace cosserat_cable {
namespace {

// Of the noise, rms over all samples: what a component's size is chosen to do to the records.
constexpr double kFaint = 0.5;
// Rescaled so often at most; a size that is off by less than a factor stays.
constexpr int kRescaled = 3;
constexpr double kNearEnough = 3;
// A factor in one rescaling: sizes are not proportional to effects over more.
constexpr double kFarthest = 1e3;
// By its typical size, how large a component may begin: what needs more to show at all, no record
// shows.
constexpr double kLargestStart = 3;
// What a component does to all records, in standard deviations of the noise, that is nothing; and
// the part of a component that the fit's own unknowns
// must leave of it, in squares.
constexpr double kNothing = 0.5, kOwn = 1e-6;
constexpr double kRidge = 1e-9;
// Of a component's size: what is there then acts beside the sizes.
constexpr double kNoSize = 1e-3;

struct Column {
  std::size_t trial = 0, component = 0;
  Eigen::VectorXd effect;  // weighted, of all samples, at the component's size
  bool shown = false;
};

/// Residuals by their weights, all records one below the other, as FitPoint's Jacobian has them.
Eigen::VectorXd Stacked(const FitProblem& problem, const Records& difference) {
  Eigen::Index rows = 0;
  for (const Eigen::MatrixXd& one : difference) rows += one.size();
  Eigen::VectorXd stacked(rows);
  Eigen::Index row = 0;
  for (std::size_t e = 0; e < difference.size(); ++e) {
    const Eigen::MatrixXd weighted =
        difference[e].cwiseProduct(SampleWeights(problem.model(), e, problem.noise()));
    stacked.segment(row, weighted.size()) =
        Eigen::Map<const Eigen::VectorXd>(weighted.data(), weighted.size());
    row += weighted.size();
  }
  return stacked;
}

/// What the fit's unknowns take away from columns of the same rows.
class Projection {
 public:
  explicit Projection(const RecordJacobian& jacobian) : jacobian_(jacobian) {
    Eigen::MatrixXd gram = jacobian.Gram();
    unit_ = gram.diagonal().unaryExpr([](double x) { return x > 0 ? 1 / std::sqrt(x) : 0.0; });
    gram = unit_.asDiagonal() * gram * unit_.asDiagonal();
    gram.diagonal().array() += kRidge;
    factor_.compute(gram);
  }
  /// R^-T J^T of a column: two columns' product of it is what they share in J's space.
  Eigen::VectorXd Part(const Eigen::VectorXd& column) const {
    Eigen::Index priors = 0;
    for (Eigen::Index i = 0; i < jacobian_.priors().size(); ++i)
      priors += jacobian_.priors()[i] != 0;
    Eigen::VectorXd whole = Eigen::VectorXd::Zero(column.size() + priors);
    whole.head(column.size()) = column;
    return factor_.matrixL().solve(unit_.cwiseProduct(jacobian_.TransposeTimes(whole)));
  }

 private:
  const RecordJacobian& jacobian_;
  Eigen::VectorXd unit_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

/// The largest drop of |r - D a|^2 over a, those of one-sided columns not negative: the best of all
/// choices of columns (there are few).
double LargestDrop(const Eigen::MatrixXd& gram, const Eigen::VectorXd& gradient,
                   const std::vector<bool>& one_sided) {
  const auto n = static_cast<int>(gradient.size());
  double best = 0;
  for (int choice = 1; choice < (1 << n); ++choice) {
    std::vector<int> which;
    for (int i = 0; i < n; ++i)
      if (choice >> i & 1) which.push_back(i);
    const auto m = static_cast<Eigen::Index>(which.size());
    Eigen::MatrixXd part(m, m);
    Eigen::VectorXd towards(m);
    for (Eigen::Index i = 0; i < m; ++i) {
      towards[i] = gradient[which[static_cast<std::size_t>(i)]];
      for (Eigen::Index k = 0; k < m; ++k)
        part(i, k) = gram(which[static_cast<std::size_t>(i)], which[static_cast<std::size_t>(k)]);
      part(i, i) *= 1 + kRidge;
    }
    const Eigen::VectorXd amplitude = part.ldlt().solve(towards);
    bool allowed = amplitude.allFinite();
    for (Eigen::Index i = 0; i < m; ++i)
      allowed =
          allowed && (!one_sided[static_cast<std::size_t>(which[static_cast<std::size_t>(i)])] ||
                      amplitude[i] > 0);
    if (allowed) best = std::max(best, amplitude.dot(towards));
  }
  return best;
}

/// The components of hypotheses, one hypothesis after the other, and what each two share.
struct Components {
  explicit Components(const std::vector<const Screened*>& hypotheses) {
    for (const Screened* one : hypotheses) {
      first.push_back(static_cast<Eigen::Index>(one_sided.size()));
      for (const TrialComponent& component : one->trial.components)
        one_sided.push_back(component.one_sided);
    }
    const auto n = static_cast<Eigen::Index>(one_sided.size());
    first.push_back(n);
    const Screened& any = *hypotheses.front();
    Eigen::MatrixXd effects(any.effects.front().size(), n), parts(any.parts.front().size(), n);
    gradient.resize(n);
    Eigen::Index k = 0;
    for (const Screened* one : hypotheses)
      for (std::size_t i = 0; i < one->effects.size(); ++i, ++k) {
        effects.col(k) = one->effects[i];
        parts.col(k) = one->parts[i];
        gradient[k] = one->gradient[i];
      }
    gram = effects.transpose() * effects - parts.transpose() * parts;
    gram.diagonal() = gram.diagonal().cwiseMax(kOwn * effects.colwise().squaredNorm().transpose());
  }

  /// The drop of some of the hypotheses together.
  double DropOf(const std::vector<std::size_t>& hypotheses) const {
    std::vector<Eigen::Index> which;
    for (const std::size_t h : hypotheses)
      for (Eigen::Index i = first[h]; i < first[h + 1]; ++i) which.push_back(i);
    const auto n = static_cast<Eigen::Index>(which.size());
    Eigen::MatrixXd part(n, n);
    Eigen::VectorXd towards(n);
    std::vector<bool> sides;
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::Index own = which[static_cast<std::size_t>(i)];
      towards[i] = gradient[own];
      sides.push_back(one_sided[static_cast<std::size_t>(own)]);
      for (Eigen::Index k = 0; k < n; ++k)
        part(i, k) = gram(own, which[static_cast<std::size_t>(k)]);
    }
    return LargestDrop(part, towards, sides);
  }

  std::vector<Eigen::Index> first;  // component of each hypothesis, and their number
  std::vector<bool> one_sided;
  Eigen::MatrixXd gram;
  Eigen::VectorXd gradient;
};

bool Grows(const Trial& trial) {
  return std::any_of(trial.components.begin(), trial.components.end(),
                     [](const TrialComponent& component) { return component.grows(); });
}

/// Of what does not grow: it is there as a whole.
double DropAsAWhole(const Screened& one) {
  Eigen::VectorXd effect = one.effects.front(), part = one.parts.front();
  double gradient = one.gradient.front();
  for (std::size_t i = 1; i < one.effects.size(); ++i) {
    effect += one.effects[i];
    part += one.parts[i];
    gradient += one.gradient[i];
  }
  return std::max(0.0, 2 * gradient - (effect.squaredNorm() - part.squaredNorm()));
}

}  // namespace

std::vector<Screened> Screen(const FitProblem& problem, const FitPoint& at,
                             std::vector<Trial> trials,
                             std::map<std::string, std::string>* failures) {
  std::vector<Column> columns;
  for (std::size_t t = 0; t < trials.size(); ++t)
    for (std::size_t c = 0; c < trials[t].components.size(); ++c)
      columns.push_back({t, c, {}, false});
  const double samples = std::max(1.0, at.samples);
  std::vector<std::size_t> todo(columns.size());
  for (std::size_t k = 0; k < columns.size(); ++k) todo[k] = k;
  for (int round = 0; round <= kRescaled && !todo.empty(); ++round) {
    std::vector<Unknowns::Setting> also, without;
    for (const std::size_t k : todo) {
      const Trial& trial = trials[columns[k].trial];
      const TrialComponent& component = trial.components[columns[k].component];
      also.push_back({component.At(), trial.channels});
      if (component.acts_beside()) without.push_back({component.At(kNoSize), trial.channels});
    }
    also.insert(also.end(), without.begin(), without.end());
    std::vector<RecordModel::Simulated> found = problem.model().SimulateWith(at.values, also);
    std::size_t next_without = todo.size();
    std::vector<std::size_t> again;
    for (std::size_t i = 0; i < todo.size(); ++i) {
      Column& column = columns[todo[i]];
      TrialComponent& component = trials[column.trial].components[column.component];
      double& size = component.size;
      const Records* beside = &at.simulated;
      if (component.acts_beside()) {
        const RecordModel::Simulated& reference = found[next_without++];
        beside = &reference.records;
        found[i].ok = found[i].ok && reference.ok;
      }
      if (!found[i].ok && failures && (round == kRescaled || !component.grows()))
        (*failures)[trials[column.trial].cause] = found[i].message;
      if (!found[i].ok && !component.grows()) continue;
      if (!found[i].ok) {
        // Too much of it may be what cannot be simulated.
        column.shown = false;
        size /= kFarthest;
        again.push_back(todo[i]);
        continue;
      }
      Records difference;
      for (std::size_t e = 0; e < at.simulated.size(); ++e)
        difference.push_back(found[i].records[e] - (*beside)[e]);
      column.effect = Stacked(problem, difference);
      const double effect = column.effect.norm() / std::sqrt(samples);
      column.shown = column.effect.norm() > kNothing;
      if (!component.grows()) continue;
      const double factor = std::clamp(kFaint / std::max(effect, 1e-300), 1 / kFarthest, kFarthest);
      if (factor > kNearEnough || factor < 1 / kNearEnough) {
        const double next = std::min(size * factor, kLargestStart);
        if (round == kRescaled || next == size) continue;
        size = next;
        again.push_back(todo[i]);
      }
    }
    todo = again;
  }

  Records left;
  for (const Eigen::MatrixXd& one : at.residuals) left.push_back(one);
  Eigen::Index rows = 0;
  for (const Eigen::MatrixXd& one : left) rows += one.size();
  Eigen::VectorXd residual(rows);
  Eigen::Index row = 0;
  for (const Eigen::MatrixXd& one : left) {
    residual.segment(row, one.size()) = Eigen::Map<const Eigen::VectorXd>(one.data(), one.size());
    row += one.size();
  }
  const Projection projection(at.jacobian);
  const Eigen::VectorXd residual_part = projection.Part(residual);
  std::vector<Screened> screened;
  for (std::size_t t = 0; t < trials.size(); ++t) {
    Screened one;
    one.trial = trials[t];
    one.trial.components.clear();
    std::vector<const Column*> shown;
    for (const Column& column : columns) {
      if (column.trial != t || !column.shown) continue;
      shown.push_back(&column);
      one.trial.components.push_back(trials[t].components[column.component]);
    }
    // Without what no record shows, some are the same.
    const bool known = std::any_of(screened.begin(), screened.end(), [&](const Screened& other) {
      return other.trial.cause == one.trial.cause && other.trial.channels == one.trial.channels &&
             other.trial.Values() == one.trial.Values();
    });
    if (shown.empty() || known) continue;
    for (const Column* column : shown) {
      one.effects.push_back(column->effect);
      one.parts.push_back(projection.Part(column->effect));
      const double whole = column->effect.squaredNorm();
      const bool own = whole - one.parts.back().squaredNorm() < kOwn * whole;
      one.gradient.push_back(
          own ? 0.0 : column->effect.dot(residual) - one.parts.back().dot(residual_part));
    }
    one.drop = Grows(one.trial) ? Components({&one}).DropOf({0}) : DropAsAWhole(one);
    screened.push_back(std::move(one));
  }
  std::stable_sort(screened.begin(), screened.end(),
                   [](const Screened& a, const Screened& b) { return a.drop > b.drop; });
  return screened;
}

std::vector<ScreenedPair> ScreenPairs(const std::vector<Screened>& screened) {
  if (screened.empty()) return {};
  std::vector<const Screened*> all;
  for (const Screened& one : screened) all.push_back(&one);
  const Components components(all);
  std::map<std::pair<std::string, std::string>, ScreenedPair> best;
  for (std::size_t a = 0; a < screened.size(); ++a)
    for (std::size_t b = a + 1; b < screened.size(); ++b) {
      const std::string &first = screened[a].trial.cause, &second = screened[b].trial.cause;
      if (!screened[a].trial.CanBeBeside(screened[b].trial)) continue;
      // What is there as a whole has no amplitude to be shared with another's.
      if (!Grows(screened[a].trial) || !Grows(screened[b].trial)) continue;
      const double drop = components.DropOf({a, b});
      ScreenedPair& known = best[std::minmax(first, second)];
      if (drop > known.drop) known = {a, b, drop};
    }
  std::vector<ScreenedPair> pairs;
  for (const auto& [causes, pair] : best)
    if (pair.drop > 0) pairs.push_back(pair);
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const ScreenedPair& a, const ScreenedPair& b) { return a.drop > b.drop; });
  return pairs;
}

}  // namespace cosserat_cable
