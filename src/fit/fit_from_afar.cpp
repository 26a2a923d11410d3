// Fits from nowhere near a minimum.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "cosserat_cable/cable/parameters.h"
#include "cosserat_cable/fit/damage.h"
#include "cosserat_cable/fit/fit.h"

namespace cosserat_cable {
namespace {

// Parts of the records that are fitted one after the other, and the fewest samples of a part.
constexpr double kParts[] = {0.06, 0.25, 1.0};
constexpr int kFewestSamples = 40;
// Of the slowest swing: in the first, the start is seen whatever the cable, in the second both.
constexpr double kStartPeriods[] = {0.3, 1.0};
// Of what is left over, what a parameter should explain at least when it moves by its whole size.
constexpr double kPower = 0.01;
const FitOptions kOnTheWay = [] {
  FitOptions options;
  options.loose = true;
  options.finish = false;
  return options;
}();
// Where the search looks: around the start, within these factors.
constexpr double kStiffnessSpread = 1.6, kWideSpread = 6.0;
constexpr int kPoints = 24, kBest = 2;
// A stiffness that is given may be off by this factor either way. It is scanned in these steps, 9 %
// apart, over so many periods of the slowest swing and samples at least: a swing that is faster by
// half of its number of periods' inverse is another one.
constexpr double kFarOff = 4.0;
constexpr int kScanned = 33;
constexpr double kScannedPeriods = 2.5;
constexpr std::size_t kFewestScanned = 8;
// The scan's best is where the points lie around, where its likelihood is better than that of all
// around the start by this (of logarithms); other valleys that are followed are at least this part
// as deep as the deepest.
constexpr double kClearly = 5, kAsDeep = 0.5;
constexpr std::size_t kMostValleys = 3;
// A further fit begins at the best point that leaves less than this part of what the curvature at
// the best fit foretells of it: another valley may be there.
constexpr double kOfForetold = 0.5;
// On the first part of the records, one that leaves more than so many times what the best leaves is
// no rival. Two fits are in one valley where the curvature at one foretells a difference of less
// than this part of what is left, or than chance makes.
constexpr double kRival = 4, kSameCost = 0.05, kChance = 9;
constexpr std::uint32_t kSeed = 20150113;

void LeaveOutUnseen(const Eigen::VectorXd& values, const NoiseLevels& noise, RecordModel* model) {
  Eigen::VectorXd steps = model->SmallSteps();
  const Linearised found = Linearise(*model, values, model->WholeHorizon(), noise,
                                     RecordModel::Difference::kForward, true, &steps);
  if (!found.ok) return;
  const auto& records = found.jacobian.records();
  for (std::size_t e = 0; e < records.size(); ++e)
    for (std::size_t k = 0; k < records[e].unknowns.size(); ++k)
      if (records[e].columns.col(static_cast<Eigen::Index>(k)).squaredNorm() < kUnseen)
        model->Ignore(records[e].unknowns[k], static_cast<int>(e));
}

/// Spread evenly over the box around a point, the same on each run.
std::vector<Eigen::VectorXd> PointsAround(const Unknowns& unknowns, const Eigen::VectorXd& centre) {
  std::mt19937 random(kSeed);
  // A Latin hypercube: every unknown takes each of its levels once.
  std::vector<std::vector<int>> levels(unknowns.size());
  for (auto& order : levels) {
    order.resize(kPoints);
    for (int k = 0; k < kPoints; ++k) order[k] = k;
    for (int k = kPoints - 1; k > 0; --k)
      std::swap(order[k], order[random() % static_cast<std::uint32_t>(k + 1)]);
  }
  std::vector<Eigen::VectorXd> points;
  for (int k = 0; k < kPoints; ++k) {
    Eigen::VectorXd values = centre;
    for (int i = 0; i < unknowns.size(); ++i) {
      const Unknown& u = unknowns.all()[i];
      if (u.kind != Unknown::Kind::kCable) continue;
      const double level = 2 * (levels[i][k] + 0.5) / kPoints - 1;  // in (-1, 1)
      if (u.sign == ParameterSign::kSigned) {
        values[i] += level * u.scale;
      } else {
        // What is known of a law beyond the plain rod is little more than its size.
        const bool hardly_known = u.damping ? !u.start_known : IsOfEntry(u.name);
        const double spread = hardly_known ? kWideSpread : kStiffnessSpread;
        values[i] = (values[i] > 0 ? values[i] : u.scale) * std::pow(spread, level);
      }
      values[i] = std::clamp(values[i], u.lower, u.upper);
    }
    points.push_back(values);
  }
  return points;
}

/// The first periods of each record, as the set's own cable has them; no more than `first`.
Horizon ScannedHorizon(const Unknowns& unknowns, const Horizon& first) {
  Horizon horizon = first;
  const auto& experiments = unknowns.set().experiments;
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    const std::vector<double>& t = experiments[e].record.t;
    Problems problems;
    const Specimen specimen =
        unknowns.MakeSpecimen(static_cast<int>(e), unknowns.StartValues(), &problems);
    if (experiments[e].quasi_static() || !problems.empty() || t.empty()) continue;
    const double fewest = t[std::min(kFewestScanned, t.size()) - 1];
    const double periods = t.front() + kScannedPeriods * RigPeriod(experiments[e], specimen.cable);
    horizon[e] = std::min(first[e], std::max(fewest, periods));
  }
  return horizon;
}

bool IsStiffness(const Unknown& u) {
  return u.kind == Unknown::Kind::kCable &&
         (u.name == "EI" || u.name == "EI1" || u.name == "EI2" || u.name == "GJ");
}

/// Less the logarithm of the likelihood by point, with the level of each channel's noise that fits
/// best, but for given ones as a lower bound: what is guessed of noise before any fit says little
/// where samples are few. Infinite where a simulation fails.
std::vector<double> CostsAt(const RecordModel& model, const std::vector<Eigen::VectorXd>& points,
                            const Horizon& horizon) {
  std::vector<double> costs;
  const std::vector<RecordModel::Simulated> all = model.Simulate(points, horizon);
  const auto& experiments = model.unknowns().set().experiments;
  for (std::size_t p = 0; p < points.size(); ++p) {
    double cost = all[p].ok ? 0.0 : std::numeric_limits<double>::infinity();
    for (std::size_t e = 0; e < all[p].records.size() && all[p].ok; ++e) {
      const Eigen::MatrixXd& simulated = all[p].records[e];
      for (Eigen::Index c = 0; c < simulated.cols(); ++c) {
        const Eigen::VectorXd use = model.usable()[e].col(c).head(simulated.rows());
        const double count = use.sum();
        if (!(count > 0)) continue;
        const Eigen::VectorXd left =
            (experiments[e].record.values.col(c).head(simulated.rows()) - simulated.col(c))
                .cwiseProduct(use);
        const double least =
            std::max(experiments[e].channels[static_cast<std::size_t>(c)].sigma.value_or(0),
                     SmallestNoise(experiments[e], static_cast<int>(c)));
        cost += 0.5 * count * std::log(left.squaredNorm() / count + least * least);
      }
    }
    costs.push_back(std::isnan(cost) ? std::numeric_limits<double>::infinity() : cost);
  }
  return costs;
}

/// The bottoms of the valleys that lie along the stiffnesses, the deepest first: each stiffness is
/// scanned by itself, the others at their best until then.
std::vector<Eigen::VectorXd> Scan(const RecordModel& model, const Horizon& horizon) {
  const Unknowns& unknowns = model.unknowns();
  Eigen::VectorXd best = unknowns.StartValues();
  struct Valley {
    double cost;
    int unknown;
    double value;
  };
  std::vector<Valley> others;
  for (int i = 0; i < unknowns.size(); ++i) {
    const Unknown& u = unknowns.all()[i];
    if (!IsStiffness(u)) continue;
    std::vector<Eigen::VectorXd> points;
    for (int k = 0; k < kScanned; ++k) {
      points.push_back(best);
      points.back()[i] =
          std::clamp(u.start * std::pow(kFarOff, 2.0 * k / (kScanned - 1) - 1), u.lower, u.upper);
    }
    const std::vector<double> costs = CostsAt(model, points, horizon);
    std::vector<double> sorted = costs;
    std::nth_element(sorted.begin(), sorted.begin() + kScanned / 2, sorted.end());
    const double level = sorted[kScanned / 2];
    std::vector<Valley> own;
    int deepest = -1;
    for (int k = 0; k < kScanned; ++k) {
      const auto at = static_cast<std::size_t>(k);
      if (!std::isfinite(costs[at]) || (k > 0 && costs[at - 1] < costs[at]) ||
          (k + 1 < kScanned && costs[at + 1] < costs[at]))
        continue;
      own.push_back({costs[at], i, points[at][i]});
      if (deepest < 0 || costs[at] < costs[static_cast<std::size_t>(deepest)]) deepest = k;
    }
    if (deepest < 0) continue;
    best[i] = points[static_cast<std::size_t>(deepest)][i];
    const double least = costs[static_cast<std::size_t>(deepest)];
    for (const Valley& one : own)
      if (level - one.cost > kAsDeep * (level - least)) others.push_back(one);
  }
  std::vector<Eigen::VectorXd> valleys = {best};
  std::stable_sort(others.begin(), others.end(),
                   [](const Valley& a, const Valley& b) { return a.cost < b.cost; });
  for (const Valley& one : others) {
    if (valleys.size() > kMostValleys) break;
    if (one.value == best[one.unknown]) continue;
    valleys.push_back(best);
    valleys.back()[one.unknown] = one.value;
  }
  return valleys;
}

/// Half a sum of squares that a fit's curvature foretells at other values.
double Foretold(const Unknowns& unknowns, const FitResult& at, const Eigen::VectorXd& values) {
  if (at.jacobian.unknowns() != unknowns.size()) return std::numeric_limits<double>::infinity();
  Eigen::VectorXd apart = values - at.values;
  for (int i = 0; i < unknowns.size(); ++i) apart[i] /= unknowns.all()[i].scale;
  return at.cost + 0.5 * apart.dot(at.jacobian.Gram() * apart);
}

/// The cable's parameters that explain little of what is left over, however far they are moved:
/// while much is, they would only be led astray.
std::vector<int> Powerless(const RecordModel& model, const Eigen::VectorXd& values,
                           const Horizon& horizon, const NoiseLevels& noise) {
  std::vector<int> powerless;
  Eigen::VectorXd steps = model.SmallSteps();
  const Linearised found =
      Linearise(model, values, horizon, noise, RecordModel::Difference::kForward, true, &steps);
  if (!found.ok) return powerless;
  const double left = found.residuals.squaredNorm();
  const Eigen::VectorXd shown = found.jacobian.SquaredNorms();
  for (int i = 0; i < model.unknowns().size(); ++i)
    if (model.unknowns().all()[i].kind == Unknown::Kind::kCable && shown[i] < kPower * left)
      powerless.push_back(i);
  return powerless;
}

/// From a point, to the first part of the records.
FitResult FitFirst(const RecordModel& model, Eigen::VectorXd values, const Horizon& horizon,
                   const NoiseLevels& noise, const FitProgress& progress) {
  FitOptions options = kOnTheWay;
  for (const double periods : kStartPeriods) {
    const std::optional<Horizon> beginning = model.Beginning(periods);
    if (!beginning) return Fit(model, values, horizon, noise, options, progress);
    if (periods == kStartPeriods[0]) {
      for (int i = 0; i < model.unknowns().size(); ++i)
        if (model.unknowns().all()[i].kind == Unknown::Kind::kCable) options.held.push_back(i);
    } else {
      options.held = Powerless(model, values, *beginning, noise);
    }
    const FitResult fit = Fit(model, values, *beginning, noise, options, progress);
    if (fit.interrupted) return fit;
    if (fit.ok) values = fit.values;
  }
  options.held = Powerless(model, values, horizon, noise);
  return Fit(model, values, horizon, noise, options, progress);
}

/// From where the first part of the records was fitted, to longer and longer ones.
FitResult FitLonger(RecordModel* model, FitResult best, bool comparable, const NoiseLevels& noise,
                    const FitProgress& progress) {
  for (std::size_t part = 1; part < std::size(kParts) && best.ok; ++part) {
    const bool last = part + 1 == std::size(kParts);
    const Horizon horizon =
        last ? model->WholeHorizon() : model->PartialHorizon(kParts[part], kFewestSamples);
    if (last) LeaveOutUnseen(best.values, noise, model);
    FitOptions options = kOnTheWay;
    if (!comparable) options.held = Powerless(*model, best.values, horizon, noise);
    FitResult next = Fit(*model, best.values, horizon, noise, options, progress);
    if (next.interrupted && !next.ok) {
      // What was found on the shorter part stands.
      best.interrupted = true;
      return best;
    }
    best = std::move(next);
    if (best.interrupted) return best;
  }
  return best;
}

}  // namespace

bool InOneValley(const Unknowns& unknowns, const FitResult& best, const FitResult& other) {
  return 2 * (Foretold(unknowns, best, other.values) - best.cost) <
         std::max(kChance, kSameCost * 2 * best.cost);
}

FitResult FitFromAfar(RecordModel* model, const std::vector<Eigen::VectorXd>& more,
                      const NoiseLevels& noise, const FitProgress& progress, FitResult* rival) {
  std::vector<Eigen::VectorXd> points = more;
  points.push_back(model->unknowns().StartValues());
  // Where a start is unknown, all points look alike before it is fitted.
  const auto& experiments = model->unknowns().set().experiments;
  const bool comparable =
      std::none_of(experiments.begin(), experiments.end(), [](const Experiment& experiment) {
        return experiment.start.kind == StartCondition::Kind::kUnknown;
      });
  const Horizon first = model->PartialHorizon(kParts[0], kFewestSamples);
  if (progress && !progress("looking for a start")) {
    FitResult stopped;
    stopped.interrupted = true;
    return stopped;
  }
  const std::size_t given = points.size();
  std::vector<Eigen::VectorXd> valleys;
  const Horizon scanned = ScannedHorizon(model->unknowns(), first);
  if (comparable) {
    const Eigen::VectorXd start = model->unknowns().StartValues();
    std::vector<Eigen::VectorXd> around = PointsAround(model->unknowns(), start);
    points.insert(points.end(), around.begin(), around.end());
    valleys = Scan(*model, scanned);
    std::vector<Eigen::VectorXd> compared = points;
    compared.push_back(valleys.front());
    const std::vector<double> costs = CostsAt(*model, compared, scanned);
    if (costs.back() < *std::min_element(costs.begin(), costs.end() - 1) - kClearly) {
      around = PointsAround(model->unknowns(), valleys.front());
      points.resize(given);
      points.insert(points.end(), around.begin(), around.end());
    }
    points.push_back(valleys.front());
  }
  const std::vector<RecordModel::Simulated> all = model->Simulate(points, first);
  std::vector<std::pair<double, std::size_t>> ranking;
  std::string why;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (!all[p].ok) {
      why = all[p].message;
      continue;
    }
    const double cost = WeightedResiduals(*model, points[p], all[p].records, noise).squaredNorm();
    if (std::isfinite(cost)) ranking.push_back({cost, p});
  }
  FitResult failed;
  failed.message = why;
  if (ranking.empty()) return failed;
  std::sort(ranking.begin(), ranking.end());
  std::vector<FitResult> fits;
  const auto by_cost = [](const FitResult& a, const FitResult& b) { return a.cost < b.cost; };
  for (std::size_t k = 0; k < std::min<std::size_t>(kBest, ranking.size()); ++k) {
    FitResult fit = FitFirst(*model, points[ranking[k].second], first, noise, progress);
    if (fit.interrupted) return fit;
    if (fit.ok) fits.push_back(std::move(fit));
  }
  std::sort(fits.begin(), fits.end(), by_cost);
  if (rival && !fits.empty()) {
    const auto other = std::find_if(ranking.begin(), ranking.end(), [&](const auto& point) {
      // Of a ranking, sums of squares.
      return 0.5 * point.first <
             kOfForetold * Foretold(model->unknowns(), fits.front(), points[point.second]);
    });
    if (other != ranking.end()) {
      FitResult fit = FitFirst(*model, points[other->second], first, noise, progress);
      if (fit.interrupted) return fit;
      if (fit.ok) fits.push_back(std::move(fit));
      std::sort(fits.begin(), fits.end(), by_cost);
    }
  }
  // Where the scan has other valleys, each is followed by itself: over the few periods of the scan
  // first, since a longer part may hold more of them than the scan has points.
  for (std::size_t v = fits.empty() ? 0 : 1; v < valleys.size(); ++v) {
    FitResult fit = Fit(*model, valleys[v], scanned, noise, kOnTheWay, progress);
    if (fit.interrupted) return fit;
    if (!fit.ok) continue;
    if (std::any_of(fits.begin(), fits.end(),
                    [&](const FitResult& one) { return InOneValley(model->unknowns(), one, fit); }))
      continue;
    fit = FitFirst(*model, fit.values, first, noise, progress);
    if (fit.interrupted) return fit;
    if (fit.ok) fits.push_back(std::move(fit));
  }
  std::sort(fits.begin(), fits.end(), by_cost);
  // What the shorter part leads to may be no cable that the longer ones can be simulated with: then
  // the next best is tried, and at last what the set itself says.
  FitResult own;
  own.ok = true;
  own.values = model->unknowns().StartValues();
  for (std::size_t k = 0; k <= fits.size(); ++k) {
    FitResult found =
        FitLonger(model, k < fits.size() ? fits[k] : own, comparable, noise, progress);
    if (found.interrupted) return found;
    if (!found.ok) {
      failed = std::move(found);
      continue;
    }
    FitResult second;
    std::vector<std::size_t> followed = {k};
    const auto likelier = [&](const FitResult& a, const FitResult& b) {
      const std::vector<double> costs =
          CostsAt(*model, {a.values, b.values}, model->WholeHorizon());
      return costs[0] < costs[1];
    };
    for (std::size_t other = k + 1; other < fits.size(); ++other) {
      if (fits[other].cost > kRival * fits[k].cost) break;
      if (followed.size() > kMostValleys) break;
      if (std::any_of(followed.begin(), followed.end(), [&](std::size_t one) {
            return InOneValley(model->unknowns(), fits[one], fits[other]);
          }))
        continue;
      followed.push_back(other);
      FitResult end = FitLonger(model, fits[other], comparable, noise, progress);
      if (end.interrupted) break;
      if (!end.ok) continue;
      if (likelier(end, found)) std::swap(end, found);
      if (InOneValley(model->unknowns(), found, end)) continue;
      if (!second.ok || likelier(end, second)) second = std::move(end);
    }
    if (rival) *rival = std::move(second);
    return found;
  }
  return failed;
}

}  // namespace cosserat_cable
