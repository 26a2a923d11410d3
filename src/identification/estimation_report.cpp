// What an estimation tells once its fit has ended.
#include <algorithm>
#include <cmath>

#include "cosserat_cable/causes/cause.h"
#include "cosserat_cable/fit/damage.h"
#include "cosserat_cable/input/number_text.h"
#include "estimation_remarks.h"
#include "estimation_work.h"
#include "weighted_line.h"

namespace cosserat_cable {
namespace {

// Half of a sum of squares: a fit that is worse by no more is as good.
constexpr double kAsWell = 2;
// The same of another minimum: more than chance makes of four parameters (99 %), or this part.
constexpr double kChanceOfMinimum = 13.3 / 2, kPartOfCost = 0.05;
// Of the slowest swing: with fewer samples, swings of other frequencies show nearly the same ones.
constexpr double kFewOfPeriod = 5;
// Aliases whose frequency is off by more than this factor are cables that nobody takes for this
// one.
constexpr double kFarAlias = 2;
// A stiffness that is found this factor from what the set gives, either way, is told.
constexpr double kFarFromGiven = 2.0;

/// By how much laws of the kind that a number belongs to differ in form: half of a 95 % interval,
/// in the number's unit. Nothing for the cable's own.
double HalfWidthOfForm(const std::string& name, double value) {
  for (const Cause& cause : Causes()) {
    const std::string law = "extensions." + cause.name;
    if (name.rfind(law + ".", 0) == 0 || name.rfind(law + "[", 0) == 0)
      return cause.form * std::abs(value);
  }
  return 0;
}

}  // namespace

/// What is not determined goes back to what was known of it, and the rest is fitted once more;
/// where that fits as well. Of several that the data only see together, what was known may
/// contradict them.
void EstimationWork::KeepDefaults(const Determination& determination) {
  bool moved = false;
  const Eigen::VectorXd found = optimum_.values;
  for (int i = 0; i < unknowns_.size(); ++i) {
    const Unknown& u = unknowns_.all()[i];
    if (determination.reasons[i].empty() || !u.start_known || optimum_.values[i] == u.start)
      continue;
    optimum_.values[i] = u.start;
    for (std::size_t e = 0; e < experiments().size(); ++e)
      if (unknowns_.Concerns(i, static_cast<int>(e))) model_.Ignore(i, static_cast<int>(e));
    moved = true;
  }
  if (!moved) return;
  const FitResult fit = Fit(model_, optimum_.values, model_.WholeHorizon(), noise_, {},
                            [&](const std::string& what) { return Tell(what, 0.8); });
  const double before = 0.5 * optimum_.residuals.squaredNorm();
  RecordModel::Simulated kept;
  kept.ok = fit.ok && fit.cost < before + kAsWell;
  if (kept.ok) kept = model_.Simulate({fit.values}, model_.WholeHorizon()).front();
  if (!kept.ok) {
    optimum_.values = found;
    return;
  }
  optimum_.values = fit.values;
  simulated_ = std::move(kept.records);
}

/// Standard deviations to the ends of the 95 % interval: Student's, with the freedom that is left
/// by the estimated scatter's share of the variance (Welch and Satterthwaite).
double EstimationWork::QuantileOf(int unknown, const Determination& determination,
                                  const Information& information) const {
  if (estimation_.scatter.empty()) return kNormal95;
  std::vector<int> common;
  for (const int i : determination.determined)
    if (unknowns_.all()[i].kind != Unknown::Kind::kScatter) common.push_back(i);
  const double without = CovarianceOf(information, common)(unknown, unknown);
  const double with = determination.covariance(unknown, unknown);
  const double share = with > 0 ? std::max(0.0, 1 - without / with) : 0.0;
  if (!(share > 0)) return kNormal95;
  int freedom = estimation_.scatter.front().freedom;
  for (const ParameterScatter& one : estimation_.scatter) freedom = std::min(freedom, one.freedom);
  return StudentQuantile(freedom / (share * share));
}

void EstimationWork::ReportChannels() {
  std::vector<std::vector<ReferenceResiduals>> references;
  if (!estimation_.interrupted)
    references = FindReferenceResiduals(unknowns_.set(), model_.usable());
  for (std::size_t e = 0; e < experiments().size(); ++e) {
    const Experiment& experiment = experiments()[e];
    ExperimentFit fit;
    fit.simulated = simulated_[e];
    fit.left_out = model_.IsLeftOut(static_cast<int>(e));
    for (std::size_t c = 0; c < experiment.channels.size(); ++c) {
      const int column = static_cast<int>(c);
      ChannelFit channel;
      channel.column = experiment.channels[c].column;
      channel.sigma = noise_[e][column];
      channel.sigma_given = experiment.channels[c].sigma.has_value();
      channel.rms = RootMeanSquare(CountedResiduals(experiment, simulated_[e], Counted(e), column));
      if (!references.empty()) channel.reference = references[e][c];
      channel.correlation_samples = colours_[e][c].correlation_samples;
      channel.noise = Level(e, column);
      if (!model_.IsLeftOut(static_cast<int>(e)))
        Judge(experiment, &channel, &estimation_.warnings);
      fit.channels.push_back(channel);
    }
    estimation_.experiments.push_back(std::move(fit));
  }
}

/// The search's second valley, where it fits as well as the first one.
void EstimationWork::ReportOtherMinimum() {
  if (!rival_.ok) return;
  FitOptions options;
  options.to_noise = !misfit_;
  const FitResult other =
      Fit(model_, rival_.values, model_.WholeHorizon(), noise_, options,
          [&](const std::string& what) { return Tell("the other minimum, " + what, 0.9); });
  clock_->Charge("other minimum");
  if (!other.ok || other.interrupted) return;
  FitResult best;
  best.values = optimum_.values;
  best.jacobian = optimum_.jacobian;
  best.cost = 0.5 * WeightedResiduals(model_, optimum_.values, simulated_, noise_).squaredNorm();
  double correlation = 1;
  for (const auto& record : colours_)
    for (const NoiseColour& colour : record)
      correlation = std::max(correlation, colour.correlation_samples);
  const double worse = other.cost - best.cost;
  if (InOneValley(unknowns_, best, other) ||
      worse > std::max(kChanceOfMinimum * correlation, kPartOfCost * best.cost))
    return;
  std::string values;
  for (int i = 0; i < unknowns_.size(); ++i) {
    const Unknown& u = unknowns_.all()[i];
    if (u.kind != Unknown::Kind::kCable) continue;
    values += (values.empty() ? "" : ", ") + u.name + " " + FormatRounded(other.values[i]);
  }
  estimation_.warnings.push_back(
      "the minimum is one of several: the records fit as well with " + values +
      " (sum of squares " + FormatRounded(100 * std::abs(worse) / best.cost, 2) + " % " +
      (worse < 0 ? "smaller" : "larger") +
      "). Begin nearer to the cable, or record it another way: faster, longer, or at "
      "another length");
}

bool EstimationWork::NothingMoves() const {
  return std::all_of(experiments().begin(), experiments().end(),
                     [](const Experiment& experiment) { return experiment.quasi_static(); });
}

/// Records that hardly resolve a swing: the minimum may be that of another cable.
void EstimationWork::ReportSampling() {
  std::string names, other;
  double fewest = kFewOfPeriod, period = 0;
  for (std::size_t e = 0; e < experiments().size(); ++e) {
    const Experiment& experiment = experiments()[e];
    const std::vector<double>& t = experiment.record.t;
    Problems problems;
    const Specimen specimen =
        unknowns_.MakeSpecimen(static_cast<int>(e), optimum_.values, &problems);
    if (experiment.quasi_static() || model_.IsLeftOut(static_cast<int>(e)) || !problems.empty() ||
        t.size() < 2)
      continue;
    const double samples = RigPeriod(experiment, specimen.cable) / MedianInterval(t);
    if (!(samples < kFewOfPeriod)) continue;
    names += (names.empty() ? "" : ", ") + experiment.name;
    if (!(samples < fewest)) continue;
    fewest = samples;
    period = samples * MedianInterval(t);
    // A frequency f shows the samples of 1/interval - f, too.
    const double alias = std::abs(samples - 1);
    other = alias < kFarAlias && alias > 1 / kFarAlias
                ? ", here one with " + FormatRounded(alias * alias, 2) + " times this [" +
                      (experiment.b.kind == EndCondition::Kind::kDisc ? "GJ" : "EI") + "]"
                : "";
  }
  if (names.empty()) return;
  estimation_.warnings.push_back(
      names + ": got " + FormatRounded(fewest, 2) + " samples in a period of the slowest swing, " +
      "some " + FormatRounded(period, 2) + " s, expected at least " + FormatRounded(kFewOfPeriod) +
      ": a cable that swings at another frequency shows nearly the same (aliasing)" + other +
      ". Record it faster, or trust the result only as far as the stiffness was known before");
}

/// A stiffness far from what the set gives: one of the two may be of another cable, or the set has
/// a length, a mass or a force in another unit.
void EstimationWork::ReportFarFromGiven() {
  for (const ParameterEstimate& one : estimation_.parameters) {
    const Unknown& u = one.unknown;
    const bool stiffness = u.name == "EI" || u.name == "EI1" || u.name == "EI2" || u.name == "GJ";
    if (!one.determined || u.kind != Unknown::Kind::kCable || !stiffness || !u.start_known ||
        !(u.start > 0))
      continue;
    if (one.low < kFarFromGiven * u.start && one.high > u.start / kFarFromGiven) continue;
    estimation_.warnings.push_back(
        "[" + u.name + "] is found " + FormatRounded(one.value / u.start, 3) +
        " times as large as the set gives it (" + FormatRounded(u.start) + " " + u.unit +
        "): either that is far off, or a length, mass or force of the set is");
  }
}

void EstimationWork::Report(const std::vector<ParameterScatter>& scatter) {
  estimation_.scatter = scatter;
  const Information information = InformationOf(model_, optimum_.jacobian, colours_);
  const Determination determination = Determine(model_, optimum_.values, information);
  optimum_.covariance = determination.covariance;
  std::vector<int> shown;
  for (const int i : determination.determined)
    if (unknowns_.all()[i].kind == Unknown::Kind::kCable) shown.push_back(i);
  std::vector<Profile> profiles(shown.size());
  if (options_.profiles && !hurried_ && Tell("profiles of the likelihood", 0.85))
    profiles = FindProfiles(model_, optimum_, noise_, shown);
  clock_->Charge("profiles");

  const Eigen::VectorXd fitted = optimum_.values;
  const Eigen::VectorXd sds = determination.covariance.diagonal().cwiseMax(0).cwiseSqrt();
  for (int i = 0; i < unknowns_.size(); ++i) {
    ParameterEstimate estimate;
    estimate.unknown = unknowns_.all()[i];
    estimate.value = fitted[i];
    estimate.determined = determination.reasons[i].empty();
    estimate.reason = determination.reasons[i];
    if (!estimate.determined && estimate.unknown.damping && NothingMoves())
      estimate.reason = "no record moves fast enough to show [" + estimate.unknown.name +
                        "]: all are quasi-static, one equilibrium after the other";
    else if (!estimate.determined && ShownByNone(i))
      estimate.reason = "every record that could show [" + estimate.unknown.name +
                        "] was left out: see the warnings";
    if (estimate.determined) {
      estimate.sd = sds[i] * estimate.unknown.scale;
      const double quantile = QuantileOf(i, determination, information);
      estimate.low = estimate.value - quantile * estimate.sd;
      estimate.high = estimate.value + quantile * estimate.sd;
      estimate.quantile = quantile;
      const auto place = std::find(shown.begin(), shown.end(), i);
      if (place != shown.end()) {
        estimate.profile = profiles[static_cast<std::size_t>(place - shown.begin())];
        if (const auto interval = IntervalOf(estimate.profile, estimate.value, estimate.sd)) {
          const double wider = quantile / kNormal95;
          estimate.low = estimate.value + wider * (interval->first - estimate.value);
          estimate.high = estimate.value + wider * (interval->second - estimate.value);
        }
      }
      const double of_form = HalfWidthOfForm(estimate.unknown.name, estimate.value);
      estimate.sd = std::hypot(estimate.sd, of_form / kNormal95);
      estimate.low = estimate.value - std::hypot(estimate.value - estimate.low, of_form);
      estimate.high = estimate.value + std::hypot(estimate.high - estimate.value, of_form);
      estimate.low = std::max(estimate.low, estimate.unknown.lower);
    }
    estimation_.parameters.push_back(std::move(estimate));
  }
  const Eigen::VectorXd inverse = sds.unaryExpr([](double sd) { return sd > 0 ? 1 / sd : 0.0; });
  estimation_.correlation = inverse.asDiagonal() * determination.covariance * inverse.asDiagonal();
  estimation_.combinations = determination.combinations;

  if (!hurried_) KeepDefaults(determination);
  clock_->Charge("fit");
  for (int i = 0; i < unknowns_.size(); ++i)
    if (!estimation_.parameters[i].determined) estimation_.parameters[i].value = optimum_.values[i];
  Eigen::VectorXd values = optimum_.values;
  for (int i = 0; i < unknowns_.size(); ++i)
    if (estimation_.parameters[i].determined) values[i] = fitted[i];
  estimation_.cable = unknowns_.FilledKeys(values);
  for (const ParameterScatter& one : scatter)
    estimation_.warnings.push_back(
        "[" + one.name + "] differs between the " + std::to_string(one.records) +
        " records that show it by more than their noise: standard deviation " +
        FormatRounded(one.sd) + " " + UnitOf(one.name) + "; the intervals count it");
  ReportChannels();
  ReportSampling();
  ReportFarFromGiven();
  clock_->Charge("models without mechanics");
  if (!hurried_) ReportOtherMinimum();
  estimation_.converged = end_.empty();
  if (!end_.empty()) {
    estimation_.warnings.push_back("these are the best values so far, and no minimum: " + end_ +
                                   "; the intervals do not tell how far off they are");
    // Standard deviations are curvatures of a minimum.
    for (ParameterEstimate& one : estimation_.parameters)
      if (one.determined)
        one.doubt = "the fit ended at no minimum: the interval does not tell how far it is off";
  }
  estimation_.ok = true;
  estimation_.seconds = clock_->seconds();
}

}  // namespace cosserat_cable
