#include "channel_slips.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>

#include "cosserat_cable/cable/parameters.h"
#include "cosserat_cable/fit/damage.h"
#include "cosserat_cable/fit/noise_level.h"
#include "cosserat_cable/input/number_text.h"
#include "slip_search.h"
#include "slip_units.h"

namespace cosserat_cable {
namespace {

// What a record's own fit with an unknown start may take [s], and in parts of the whole fit.
constexpr double kLeastTime = 3, kPartOfFit = 0.03;
// What a fit of what is mended may take, likewise.
constexpr double kLeastTimeOfMended = 24, kPartOfFitOfMended = 0.1;
// Stiffnesses that two records show are the same within this, relative.
constexpr double kSameStiffness = 0.02;
// Records whose slips are looked for, the worst first: each takes seconds; so many of those with an
// unknown start, which are fitted anew by themselves.
constexpr std::size_t kMostRecords = 8, kMostFittedAnew = 2;

/// By how much the worst channel exceeds its noise, squared; zero where it need not be looked at.
double Suspicion(const Experiment& experiment, const ExperimentFit& fit) {
  double worst = 0;
  for (std::size_t c = 0; c < fit.channels.size(); ++c) {
    const ChannelFit& channel = fit.channels[c];
    const auto column = experiment.record.values.col(static_cast<Eigen::Index>(c));
    const double range = column.maxCoeff() - column.minCoeff();
    double times = channel.times_noise;
    if (fit.left_out) {
      const Eigen::VectorXd residual = column - fit.simulated.col(static_cast<Eigen::Index>(c));
      const double rms = std::sqrt(residual.squaredNorm() / static_cast<double>(residual.size()));
      times = TimesNoise(rms, channel.noise);
      worst = std::max(worst, times * times > kFarAbove ? times * times : 0.0);
    } else if (channel.noise.source == NoiseLevel::Source::kUnknown) {
      if (range > 0 && channel.rms > kUnknownMisfit * range)
        worst = std::max(worst, std::pow(channel.rms / (kUnknownLevel * range), 2));
    } else if (channel.misfit) {
      worst = std::max(worst, times * times > kFarAbove ? times * times : 0.0);
    }
  }
  return worst;
}

EstimationOptions Cheap(EstimationOptions options) {
  options.profiles = options.scatter = options.slips = false;
  options.unknowns.scatter.clear();
  return options;
}

/// With an unknown start, sign and scale are the start's; a constant is not. Through the fit
/// itself, which finds the start.
std::vector<ChannelSlip> OffsetsBesideAStart(const MeasurementSet& set, std::size_t e,
                                             const ExperimentFit& before,
                                             const EstimationOptions& options) {
  MeasurementSet one = set;
  one.experiments = {set.experiments[e]};
  for (Channel& channel : one.experiments.front().channels) channel.unknown_offset = true;
  Problems unused;
  const Estimation fit = Estimate(one, Cheap(options), &unused);
  std::vector<ChannelSlip> slips;
  if (!fit.ok || !unused.empty()) return slips;
  const Experiment& experiment = set.experiments[e];
  for (std::size_t c = 0; c < experiment.channels.size(); ++c) {
    const Channel& channel = experiment.channels[c];
    const ChannelFit& was = before.channels[c];
    const ChannelFit& is = fit.experiments.front().channels[c];
    const double left = was.times_noise * was.times_noise, now = is.times_noise * is.times_noise;
    if (channel.unknown_offset || !(left > kFarAbove) || !(now > 0) ||
        now > std::min((1 - kExplains) * (left - 1) + 1, kFaithful))
      continue;
    for (const ParameterEstimate& estimate : fit.parameters) {
      if (estimate.unknown.name != experiment.name + "/" + channel.column + ".offset") continue;
      if (!estimate.determined || std::abs(estimate.value) < kFarAbove * estimate.sd) continue;
      ChannelSlip slip;
      slip.experiment = experiment.name;
      slip.column = channel.column;
      slip.kind = "offset";
      slip.constant = estimate.value;
      slip.before = was.times_noise;
      slip.after = is.times_noise;
      slip.text = channel.column + " fits with a constant of " +
                  WithUnit(channel.quantity, estimate.value) + ": `offset: unknown`?";
      slips.push_back(slip);
    }
  }
  return slips;
}

/// A record that fits as it is, alone.
struct FitsAlone {
  std::size_t experiment = 0;
  Values values;
};

/// The farther of two records' stiffnesses, as a factor's logarithm.
double Apart(const Values& a, const Values& b) {
  double farthest = 0;
  for (const auto& [name, value] : a)
    for (const auto& [other, there] : b)
      if (name == other && IsStiffness(name))
        farthest = std::max(farthest, std::abs(std::log(value / there)));
  return farthest;
}

/// Each record fits by itself, all together do not: the slips of those that have no more company
/// than another one, with the stiffness that this has.
std::vector<ChannelSlip> SlipsBetween(const MeasurementSet& set, const Estimation& fit,
                                      const Points& points, const std::vector<FitsAlone>& alone,
                                      const std::function<bool()>& stop) {
  std::vector<int> company;
  for (const FitsAlone& one : alone)
    company.push_back(
        static_cast<int>(std::count_if(alone.begin(), alone.end(), [&](const FitsAlone& other) {
          return Apart(one.values, other.values) < kSameStiffness;
        })));
  std::vector<ChannelSlip> slips;
  for (std::size_t k = 0; k < alone.size(); ++k) {
    const FitsAlone* other = nullptr;
    int most = company[k];
    for (std::size_t o = 0; o < alone.size(); ++o)
      if (company[o] >= most && Apart(alone[k].values, alone[o].values) > kSameStiffness) {
        other = &alone[o];
        most = company[o] + 1;
      }
    if (!other || !set.cable.uncertain.value) continue;
    MeasurementSet known = set;
    std::string names;
    auto& uncertain = *known.cable.uncertain.value;
    for (const auto& [name, value] : other->values) {
      if (!IsStiffness(name)) continue;
      SetParameter(name, value, &known.cable);
      uncertain.erase(
          std::remove_if(uncertain.begin(), uncertain.end(),
                         [&, &of = name](const UncertainKey& key) { return key.name == of; }),
          uncertain.end());
      names += (names.empty() ? "[" : ", [") + name + "]";
    }
    const std::size_t e = alone[k].experiment;
    SlipSearch search(known, static_cast<int>(e), fit.experiments[e], points, std::nullopt, stop,
                      false);
    for (ChannelSlip slip : search.Find()) {
      slip.text += ", where " + names + " is as " + set.experiments[other->experiment].name +
                   " has it: one of the two records slips";
      slip.values = other->values;
      slip.of_record = true;  // which of the two it is nobody knows: neither is mended
      slips.push_back(slip);
    }
  }
  return slips;
}

}  // namespace

std::vector<ChannelSlip> FindSlips(const MeasurementSet& set, const Estimation& fit,
                                   const EstimationOptions& options, double seconds,
                                   MeasurementSet* mended) {
  std::vector<std::pair<double, std::size_t>> suspects;
  for (std::size_t e = 0; e < set.experiments.size(); ++e)
    if (const double worst = Suspicion(set.experiments[e], fit.experiments[e]); worst > 0)
      suspects.push_back({-worst, e});
  std::sort(suspects.begin(), suspects.end());
  std::vector<std::vector<std::pair<std::string, double>>> points = {{}};
  for (const ParameterEstimate& estimate : fit.parameters)
    if (estimate.unknown.kind == Unknown::Kind::kCable)
      points.front().push_back({estimate.unknown.name, estimate.value});
  if (!options.guesses.empty()) points.push_back(options.guesses);
  std::vector<ChannelSlip> slips;
  const auto begin = std::chrono::steady_clock::now();
  const auto time_left = [&] {
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    return seconds - taken.count();
  };
  const auto ended = [&] { return (options.stop && options.stop()) || !(time_left() > 0); };
  EstimationOptions of_record = options;
  std::optional<KnownSlip> input;
  MeasurementSet with_set_mended = set;
  std::vector<FitsAlone> alone;
  std::size_t fitted_anew = 0;
  for (std::size_t k = 0; k < std::min(suspects.size(), kMostRecords) && !ended(); ++k) {
    const std::size_t e = suspects[k].second;
    const bool unknown_start = set.experiments[e].start.kind == StartCondition::Kind::kUnknown;
    if (unknown_start && ++fitted_anew > kMostFittedAnew) continue;
    if (options.progress &&
        !options.progress("looking for slips in " + set.experiments[e].name, 0.95))
      return slips;
    of_record.time_budget = std::min(time_left(), std::max(kLeastTime, kPartOfFit * fit.seconds));
    if (unknown_start) {
      const auto found = OffsetsBesideAStart(set, e, fit.experiments[e], of_record);
      slips.insert(slips.end(), found.begin(), found.end());
      continue;
    }
    SlipSearch search(with_set_mended, static_cast<int>(e), fit.experiments[e], points, input,
                      ended);
    const std::vector<ChannelSlip> found = search.Find();
    slips.insert(slips.end(), found.begin(), found.end());
    if (search.alone()) alone.push_back({e, *search.alone()});
    if (!search.input()) continue;
    input = search.input();
    input->Mend(mended);
    if (input->input.of_set) input->Mend(&with_set_mended);
  }
  return slips.empty() ? SlipsBetween(set, fit, points, alone, ended) : slips;
}

void DoubtSlips(const MeasurementSet& mended, const Unknowns& unknowns,
                const EstimationOptions& options, double seconds, Estimation* fit) {
  const auto any_slip = [&](const auto& is) {
    return std::any_of(fit->slips.begin(), fit->slips.end(), is);
  };
  const auto suspected = [&](std::size_t e) {
    return !fit->experiments[e].left_out && any_slip([&](const ChannelSlip& slip) {
      return slip.of_set || slip.experiment == mended.experiments[e].name;
    });
  };
  MeasurementSet rest = mended;
  rest.experiments.clear();
  for (const Experiment& experiment : mended.experiments)
    if (!any_slip([&](const ChannelSlip& slip) {
          return slip.of_record && slip.experiment == experiment.name;
        }))
      rest.experiments.push_back(experiment);
  const bool left_out = rest.experiments.size() < mended.experiments.size();
  EstimationOptions of_rest = Cheap(options);
  of_rest.time_budget =
      std::max(kLeastTime,
               std::min(seconds, std::max(kLeastTimeOfMended, kPartOfFitOfMended * fit->seconds)));
  for (const ParameterEstimate& one : fit->parameters)
    if (one.unknown.kind == Unknown::Kind::kCable)
      of_rest.guesses.push_back({one.unknown.name, one.value});
  std::optional<Estimation> others;
  for (ParameterEstimate& one : fit->parameters) {
    if (!one.determined || one.unknown.kind != Unknown::Kind::kCable) continue;
    const int unknown = unknowns.Find(one.unknown.name);
    bool depends = false;
    for (std::size_t e = 0; e < mended.experiments.size(); ++e)
      depends |= suspected(e) && unknowns.Concerns(unknown, static_cast<int>(e));
    if (!depends) continue;
    if (!others) {
      Problems unused;
      others = rest.experiments.empty() ? Estimation() : Estimate(rest, of_rest, &unused);
    }
    const double half = 0.5 * (one.high - one.low);
    std::string instead;
    bool known = false;
    for (const ParameterEstimate& other : others->parameters) {
      if (other.unknown.name != one.unknown.name || !other.determined) continue;
      known = true;
      if (std::abs(other.value - one.value) > std::hypot(half, 0.5 * (other.high - other.low)))
        instead = (left_out ? "without that record it is " : "with that mended it is ") +
                  FormatRounded(other.value);
    }
    std::string slips;
    for (const ChannelSlip& slip : fit->slips) {
      const auto is_it = [&](const auto& value) { return value.first == one.unknown.name; };
      const auto own = std::find_if(slip.values.begin(), slip.values.end(), is_it);
      if (own == slip.values.end()) continue;
      slips += slip.experiment + " " + slip.text + "; ";
      if (!known && (own->second < one.low || own->second > one.high))
        instead = "with that mended it is some " + FormatRounded(own->second, 3);
    }
    if (instead.empty()) continue;
    one.doubt = slips + instead + " " + one.unknown.unit;
    fit->warnings.push_back("[" + one.unknown.name + "] is not to be trusted: " + one.doubt);
  }
}

void CheckClocks(const MeasurementSet& set, Problems* problems) {
  constexpr double kFewestOfPeriod = 2;  // samples, to show a swing at all
  constexpr double kEnoughOfPeriod = 6;  // with the factor, and periods of a record
  constexpr double kNoLogger = 0.5;      // [s] nobody samples a swinging cable so slowly
  struct Clock {
    double factor;
    const char* name;
  };
  for (const Experiment& experiment : set.experiments) {
    const std::vector<double>& t = experiment.record.t;
    if (experiment.quasi_static() || t.size() < 2) continue;
    Problems unused;
    CableKeys keys = SpecimenKeys(set, experiment);
    const Specimen specimen = MakeSpecimen(WithoutUnknownDamping(keys), experiment, &unused);
    if (!unused.empty()) continue;
    Experiment still = experiment;
    still.a.motion.reset();
    still.b.motion.reset();
    const double period = SlowestPeriod(still, specimen.cable);
    const double interval = (t.back() - t.front()) / static_cast<double>(t.size() - 1);
    if (!(interval > kNoLogger) || !(kFewestOfPeriod * interval > period)) continue;
    for (const Clock& clock :
         {Clock{1e-3, "ms"}, Clock{1e-6, "microseconds"}, Clock{1e-9, "nanoseconds"}}) {
      const double mended = clock.factor * interval;
      if (kEnoughOfPeriod * mended > period || mended * static_cast<double>(t.size() - 1) < period)
        continue;
      problems->Add((std::filesystem::path(set.folder) / experiment.record.file).string(), 1, "t",
                    "got samples " + FormatRounded(interval) +
                        " s apart of a cable that swings in some " + FormatRounded(period, 2) +
                        " s: is it in " + clock.name + " (factor " + FormatRounded(clock.factor) +
                        ")?");
      break;
    }
  }
}

}  // namespace cosserat_cable
