#include "cosserat_cable/identification/plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cosserat_cable/cable/parameters.h"
#include "cosserat_cable/fit/fit.h"
#include "cosserat_cable/fit/information.h"

namespace cosserat_cable {
namespace {

constexpr double kInertias[] = {0.5, 1.0, 2.0};
constexpr int kLengths = 5;
// Relative half-widths of one round beyond which no number of repeats helps.
constexpr double kHopeless = 1e3;

/// The experiment with another length and disc: places scaled about clamp a.
Experiment Scaled(const Experiment& like, double from, double to, double inertia_factor) {
  Experiment experiment = like;
  const double ratio = to / from;
  SetParameter("length", to, &experiment.specimen);
  for (Channel& channel : experiment.channels) channel.s *= ratio;
  experiment.start.held.s *= ratio;
  const Eigen::Vector3d a = experiment.a.pose.p;
  experiment.start.held.position_W = a + ratio * (experiment.start.held.position_W - a);
  experiment.b.disc.inertia *= inertia_factor;
  return experiment;
}

/// Only what is held at one end can be scaled.
bool CanBeScaled(const Experiment& experiment) {
  return !experiment.quasi_static() && !experiment.a.motion &&
         experiment.b.kind != EndCondition::Kind::kClamp &&
         experiment.start.kind != StartCondition::Kind::kUnknown;
}

struct Rated {
  double length = 0, inertia = 0;
  std::size_t like = 0;
  Eigen::MatrixXd information;  // of one record, in units of the scales
};

/// What is left of a record's information where the unknown is another one in each record: its own
/// is integrated out.
void LoseToScatter(int unknown, double sd, const Unknowns& unknowns, Eigen::MatrixXd* information) {
  if (unknown < 0) return;
  const double precision = std::pow(unknowns.all()[unknown].scale / sd, 2);
  const Eigen::VectorXd column = information->col(unknown);
  *information -= column * column.transpose() / (precision + column[unknown]);
}

double HalfWidth(const Eigen::MatrixXd& information, int target, double value, double scale) {
  // An unknown that no record shows is not looked for either.
  std::vector<int> which;
  for (int i = 0; i < information.rows(); ++i)
    if (information(i, i) > 0) which.push_back(i);
  if (std::find(which.begin(), which.end(), target) == which.end() || !(value > 0))
    return std::numeric_limits<double>::infinity();
  const double variance = CovarianceOf({information, information}, which)(target, target);
  return kNormal95 * std::sqrt(variance) * scale / value;
}

/// The relative half-width that the set itself gives; infinite where it determines nothing.
double WidthNow(const ParameterEstimate& one) {
  return one.determined && one.value > 0 ? kNormal95 * one.sd / one.value
                                         : std::numeric_limits<double>::infinity();
}

/// The parameters, the one that is known worst first.
std::vector<const ParameterEstimate*> WorstFirst(const Estimation& estimation) {
  std::vector<const ParameterEstimate*> order;
  for (const ParameterEstimate& one : estimation.parameters)
    if (one.unknown.kind == Unknown::Kind::kCable) order.push_back(&one);
  std::stable_sort(order.begin(), order.end(),
                   [](const ParameterEstimate* a, const ParameterEstimate* b) {
                     return WidthNow(*a) > WidthNow(*b);
                   });
  return order;
}

/// Every length alone and every two lengths with one disc, as often as it takes.
std::vector<PlanCandidate> CandidatesFor(int target, double value, double scale,
                                         const MeasurementSet& set, const std::vector<Rated>& rated,
                                         const PlanOptions& options) {
  std::vector<PlanCandidate> candidates;
  for (std::size_t i = 0; i < rated.size(); ++i)
    for (std::size_t k = i; k < rated.size(); ++k) {
      if (rated[i].like != rated[k].like || rated[i].inertia != rated[k].inertia) continue;
      const bool pair = k != i;
      const Eigen::MatrixXd once =
          pair ? Eigen::MatrixXd(rated[i].information + rated[k].information)
               : rated[i].information;
      const double single = HalfWidth(once, target, value, scale);
      if (!(single < kHopeless)) continue;
      PlanCandidate candidate;
      candidate.like = set.experiments[rated[i].like].name;
      candidate.lengths = {rated[i].length};
      if (pair) candidate.lengths.push_back(rated[k].length);
      candidate.inertia = rated[i].inertia;
      // Repeats add up.
      const double needed = std::ceil(std::pow(single / options.accuracy, 2));
      candidate.repeats =
          static_cast<int>(std::clamp(needed, 1.0, static_cast<double>(options.most_repeats)));
      candidate.half_width = single / std::sqrt(candidate.repeats);
      candidates.push_back(candidate);
    }
  const auto reaches = [&](const PlanCandidate& c) { return c.half_width <= options.accuracy; };
  std::sort(candidates.begin(), candidates.end(),
            [&](const PlanCandidate& a, const PlanCandidate& b) {
              if (reaches(a) != reaches(b)) return reaches(a);
              if (reaches(a) && a.records() != b.records()) return a.records() < b.records();
              return a.half_width < b.half_width;
            });
  return candidates;
}

}  // namespace

Plan MakePlan(const MeasurementSet& set, const Estimation& estimation, const PlanOptions& options,
              const EstimationProgress& progress) {
  Plan plan;
  plan.accuracy = options.accuracy;

  MeasurementSet rigs = set;
  rigs.cable = estimation.cable;
  rigs.cable.uncertain = {std::vector<UncertainKey>(), set.cable_mark};
  for (const ParameterEstimate& one : estimation.parameters)
    if (one.unknown.kind == Unknown::Kind::kCable)
      rigs.cable.uncertain.value->push_back({one.unknown.name, set.cable_mark});
  std::vector<Rated> rated;
  std::vector<double> lengths;
  for (const Experiment& experiment : set.experiments)
    lengths.push_back(SpecimenKeys(set, experiment).length.value.value_or(0));
  const double longest =
      options.longest > 0 ? options.longest : *std::max_element(lengths.begin(), lengths.end());
  double shortest =
      options.shortest > 0 ? options.shortest : *std::min_element(lengths.begin(), lengths.end());
  if (shortest > 0.75 * longest) shortest = 0.5 * longest;
  rigs.experiments.clear();
  NoiseLevels noise;
  for (std::size_t e = 0; e < set.experiments.size(); ++e) {
    const Experiment& like = set.experiments[e];
    const bool repeated = std::any_of(
        set.experiments.begin(), set.experiments.begin() + static_cast<std::ptrdiff_t>(e),
        [&](const Experiment& earlier) {
          return earlier.b.kind == like.b.kind && earlier.channels.size() == like.channels.size();
        });
    if (!CanBeScaled(like) || repeated) continue;
    const bool disc = like.b.kind == EndCondition::Kind::kDisc;
    for (int k = 0; k < kLengths; ++k)
      for (const double factor : kInertias) {
        if (!disc && factor != 1.0) continue;
        const double to =
            shortest * std::pow(longest / shortest, static_cast<double>(k) / (kLengths - 1));
        rigs.experiments.push_back(Scaled(like, lengths[e], to, factor));
        rated.push_back({to, disc ? like.b.disc.inertia * factor : 0.0, e, {}});
        Eigen::VectorXd levels(like.channels.size());
        for (std::size_t c = 0; c < like.channels.size(); ++c)
          levels[static_cast<int>(c)] = estimation.experiments[e].channels[c].sigma;
        noise.push_back(levels);
      }
  }
  if (rigs.experiments.empty()) {
    plan.message = "no experiment of the set is held at one end only: there is none to plan with";
    return plan;
  }

  Problems problems;
  UnknownOptions unknown_options;
  unknown_options.end_damping =
      std::any_of(estimation.parameters.begin(), estimation.parameters.end(),
                  [](const ParameterEstimate& one) { return one.unknown.name == kEndDamping; });
  const Unknowns unknowns(rigs, unknown_options, &problems);
  if (!problems.empty()) {
    plan.message = problems.ToString();
    return plan;
  }
  if (progress && !progress("planning", 0.95)) return plan;
  const RecordModel model(unknowns);
  const Eigen::VectorXd values = unknowns.StartValues();
  Eigen::VectorXd steps = model.SmallSteps();
  const Linearised found = Linearise(model, values, model.WholeHorizon(), noise,
                                     RecordModel::Difference::kCentral, true, &steps);
  if (!found.ok) {
    plan.message = found.message;
    return plan;
  }
  for (std::size_t e = 0; e < rigs.experiments.size(); ++e) {
    const RecordJacobian::Record& record = found.jacobian.records()[e];
    rated[e].information = Eigen::MatrixXd::Zero(unknowns.size(), unknowns.size());
    AddPart(record.columns.transpose() * record.columns, record.unknowns, &rated[e].information);
    for (const ParameterScatter& one : estimation.scatter)
      LoseToScatter(unknowns.Find(one.name), one.sd, unknowns, &rated[e].information);
  }

  for (const ParameterEstimate* one : WorstFirst(estimation)) {
    const int target = unknowns.Find(one->unknown.name);
    if (target < 0 || (!options.target.empty() && one->unknown.name != options.target)) continue;
    plan.target = one->unknown.name;
    plan.half_width_now = WidthNow(*one);
    plan.candidates =
        CandidatesFor(target, values[target], unknowns.all()[target].scale, set, rated, options);
    if (!plan.candidates.empty()) break;
  }
  plan.reached = !plan.candidates.empty() && plan.candidates.front().half_width <= options.accuracy;
  if (plan.target.empty())
    plan.message = "[" + options.target + "] is none of the set's unknowns";
  else if (plan.candidates.empty())
    plan.message = "[" + plan.target + "] shows in none of the set's rigs at any length";
  return plan;
}

}  // namespace cosserat_cable
