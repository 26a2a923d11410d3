#include "channel_slips.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>

#include "cosserat_cable/fit/damage.h"
#include "cosserat_cable/fit/noise_level.h"
#include "cosserat_cable/input/number_text.h"
#include "slip_model.h"

namespace cosserat_cable {
namespace {

// A channel is looked at where its residual is so many times the noise, squared.
constexpr double kFarAbove = 4.0;
// Of what is left above the noise, a slip must explain this share, and leave little beside the
// rest.
constexpr double kExplains = 0.9;
// What an offset leaves, in the noise's variance: with more, it stands for what the model lacks.
constexpr double kFaithful = 25;
// A form that leaves no more than so many times what a richer one leaves, and half the noise's
// variance, is as good.
constexpr double kAsGood = 2.0, kOfNoise = 0.5;
// Of slips that explain a record, those within this factor of the best in variance are compared by
// how simple they are.
constexpr double kAlike = 4.0;
// A factor this near to a unit's is that unit's.
constexpr double kNearUnit = 0.03;
// Forms that go on from the first part of a record.
constexpr std::size_t kMostForms = 8;
// No noise is taken to be less than this part of a channel's range where its level is unknown; and
// a residual beyond this part is looked at then.
constexpr double kUnknownLevel = 0.005, kUnknownMisfit = 0.05;
// What a record's own fit may take [s], and in parts of the whole fit.
constexpr double kLeastTime = 3, kPartOfFit = 0.1;
// Records whose slips are looked for, the worst first: each takes seconds.
constexpr std::size_t kMostRecords = 8;

struct Unit {
  double factor;  ///< values in it over values in SI
  const char* name;
};

std::vector<Unit> UnitsOf(Quantity quantity) {
  constexpr double kDegrees = 57.29577951308232, kGravity = 9.80665;
  switch (quantity) {
    case Quantity::kPosition:
      return {{1e3, "millimetres"},
              {1e2, "centimetres"},
              {39.3700787, "inches"},
              {1e-3, "metres that were taken for millimetres"}};
    case Quantity::kVelocity:
      return {{1e3, "mm/s"}, {1e2, "cm/s"}, {39.3700787, "inches per second"}};
    case Quantity::kAcceleration:
      return {{1 / kGravity, "multiples of g"}, {1e3, "mm/s^2"}, {1e2, "cm/s^2"}};
    case Quantity::kAngle:
      return {{kDegrees, "degrees"},
              {0.15915494309, "turns"},
              {1 / kDegrees, "radians that were taken for degrees"}};
    case Quantity::kRate:
      return {{kDegrees, "degrees per second"},
              {9.5492965855, "turns per minute"},
              {0.15915494309, "turns per second"},
              {1 / kDegrees, "rad/s that were taken for degrees per second"}};
    case Quantity::kForce:
      return {{1e3, "millinewtons"},
              {1 / kGravity, "kilograms"},
              {1e3 / kGravity, "grams"},
              {0.224808943, "pounds"},
              {1e-3, "kilonewtons"}};
    case Quantity::kMoment:
      return {{1e3, "N mm"}, {1e2, "N cm"}, {8.8507457676, "pound inches"}};
  }
  return {};
}

std::string Formatted(const char* format, double value) {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// Lengths in mm, as people read them.
std::string WithUnit(Quantity quantity, double value) {
  switch (quantity) {
    case Quantity::kPosition:
      return std::abs(value) < 1e-3  ? Formatted("%.2g", 1e3 * value) + " mm"
             : std::abs(value) < 0.1 ? Formatted("%.1f", 1e3 * value) + " mm"
                                     : Formatted("%.4g", value) + " m";
    case Quantity::kVelocity:
      return Formatted("%.3g", value) + " m/s";
    case Quantity::kAcceleration:
      return Formatted("%.3g", value) + " m/s^2";
    case Quantity::kAngle:
      return Formatted("%.3g", value) + " rad";
    case Quantity::kRate:
      return Formatted("%.3g", value) + " rad/s";
    case Quantity::kForce:
      return Formatted("%.3g", value) + " N";
    case Quantity::kMoment:
      return Formatted("%.3g", value) + " N m";
  }
  return "";
}

std::string Seconds(double value) {
  return Formatted(std::abs(value) < 0.1 ? "%.2g" : "%.2f", value) + " s";
}

/// How far from what the set says; slips that explain as much are ordered by it.
double Complexity(const ChannelForm& form, bool other_column, bool of_unit) {
  const bool scaled = form.factor != 1, moved = form.constant != 0;
  return (other_column ? 1.0 : 0.0) + (scaled ? (of_unit ? 1.0 : 1.5) : 0.0) + (moved ? 1.0 : 0.0) +
         (scaled && moved && !of_unit ? 0.5 : 0.0);
}

/// What was found for a record.
struct Found {
  FormFit fit;
  double complexity = 0;
};

class SlipSearch {
 public:
  SlipSearch(const MeasurementSet& set, int experiment, const ExperimentFit& fit,
             const std::vector<std::vector<std::pair<std::string, double>>>& points)
      : experiment_(set.experiments[static_cast<std::size_t>(experiment)]),
        usable_(UsableSamples(experiment_.record)),
        level_(Levels(fit)),
        model_(set, experiment, level_, usable_, points) {
    before_ = Left(fit);
  }

  std::vector<ChannelSlip> Find();

 private:
  Eigen::VectorXd Levels(const ExperimentFit& fit) const;
  Eigen::VectorXd Left(const ExperimentFit& fit) const;
  std::vector<RecordForm> Forms() const;
  RecordForm Simplest(const FormFit& fit) const;
  bool OfUnit(std::size_t channel, double factor) const;
  double ComplexityOf(const RecordForm& form) const;
  std::vector<ChannelSlip> Words(const FormFit& fit) const;
  ChannelSlip OfChannel(std::size_t channel, const FormFit& fit) const;
  ChannelSlip OfClock(const FormFit& fit) const;

  const Experiment& experiment_;
  Eigen::MatrixXd usable_;
  Eigen::VectorXd level_;
  SlipModel model_;
  Eigen::VectorXd before_;  // by channel, mean square left over the level's
};

Eigen::VectorXd SlipSearch::Levels(const ExperimentFit& fit) const {
  Eigen::VectorXd level(static_cast<Eigen::Index>(fit.channels.size()));
  for (Eigen::Index c = 0; c < level.size(); ++c) {
    const NoiseLevel& noise = fit.channels[static_cast<std::size_t>(c)].noise;
    const auto column = experiment_.record.values.col(c);
    const double range = column.maxCoeff() - column.minCoeff();
    level[c] = noise.source != NoiseLevel::Source::kUnknown
                   ? noise.sd
                   : std::max(noise.sd, kUnknownLevel * range);
    level[c] = std::max({level[c], 1e-9 * column.cwiseAbs().maxCoeff(), 1e-300});
  }
  return level;
}

Eigen::VectorXd SlipSearch::Left(const ExperimentFit& fit) const {
  Eigen::VectorXd left(level_.size());
  for (Eigen::Index c = 0; c < left.size(); ++c) {
    const Eigen::VectorXd residual =
        (experiment_.record.values.col(c) - fit.simulated.col(c)).cwiseProduct(usable_.col(c));
    left[c] = residual.squaredNorm() / std::max(usable_.col(c).sum(), 1.0) / std::pow(level_[c], 2);
  }
  return left;
}

std::vector<RecordForm> SlipSearch::Forms() const {
  const RecordForm plain = model_.Plain();
  std::vector<RecordForm> forms;
  const auto add = [&](const auto& change) {
    RecordForm form = plain;
    change(&form);
    forms.push_back(form);
  };
  for (const bool factor : {false, true})
    for (const bool constant : {false, true})
      if (factor || constant)
        add([&](RecordForm* form) {
          for (ChannelForm& channel : form->channels) {
            channel.free_factor = factor;
            channel.free_constant = channel.free_constant || constant;
          }
        });
  if (model_.LongestDelay() > 0) add([&](RecordForm* form) { form->free_delay = true; });
  const auto& channels = experiment_.channels;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    for (int axis = 0; axis < 3; ++axis) {
      const int column = model_.ColumnOf(static_cast<int>(c), axis);
      if (column < 0 || axis == channels[c].axis) continue;
      for (const double factor : {1.0, -1.0})
        add([&](RecordForm* form) {
          form->channels[c].shows = column;
          form->channels[c].factor = factor;
        });
    }
    for (std::size_t other = 0; other < c; ++other)
      if (channels[other].quantity == channels[c].quantity)
        add([&](RecordForm* form) {
          std::swap(form->channels[c].shows, form->channels[other].shows);
        });
  }
  return forms;
}

bool SlipSearch::OfUnit(std::size_t channel, double factor) const {
  if (std::abs(factor) == 1) return true;
  for (const Unit& unit : UnitsOf(experiment_.channels[channel].quantity))
    if (std::abs(std::abs(factor) / unit.factor - 1) < 1e-9) return true;
  return false;
}

/// The simplest form by channel that leaves about as little.
RecordForm SlipSearch::Simplest(const FormFit& fit) const {
  const RecordForm plain = model_.Plain();
  RecordForm simple = fit.form;
  for (std::size_t c = 0; c < simple.channels.size(); ++c) {
    const ChannelForm& own = plain.channels[c];
    const ChannelForm rich = fit.form.channels[c];
    if (!rich.free_factor && !rich.free_constant) continue;
    ChannelForm identity = own;
    identity.shows = rich.shows;
    std::vector<ChannelForm> candidates = {identity};
    ChannelForm next = identity;
    if (rich.free_constant && !own.free_constant) {
      next.free_constant = true;
      candidates.push_back(next);
    }
    if (rich.free_factor) {
      std::vector<double> factors = {-1.0};
      for (const Unit& unit : UnitsOf(experiment_.channels[c].quantity))
        for (const double sign : {1.0, -1.0}) factors.push_back(sign * unit.factor);
      for (const bool constant : {false, true}) {
        if (constant && !rich.free_constant) continue;
        for (const double factor : factors) {
          if (std::abs(rich.factor / factor - 1) > kNearUnit) continue;
          next = identity;
          next.factor = factor;
          next.free_constant = own.free_constant || constant;
          candidates.push_back(next);
        }
      }
      next = identity;
      next.free_factor = true;
      candidates.push_back(next);
    }
    candidates.push_back(rich);
    for (const ChannelForm& candidate : candidates) {
      RecordForm tried = fit.form;
      tried.channels[c] = candidate;
      const FormFit judged = model_.Judge(model_.With(fit, tried));
      simple.channels[c] = candidate;
      const auto i = static_cast<Eigen::Index>(c);
      if (judged.ok && judged.left[i] <= kAsGood * fit.left[i] + kOfNoise) break;
    }
  }
  return simple;
}

double SlipSearch::ComplexityOf(const RecordForm& form) const {
  const RecordForm plain = model_.Plain();
  double sum = form.free_delay ? 1.0 : 0.0;
  int elsewhere = 0;
  for (std::size_t c = 0; c < form.channels.size(); ++c) {
    ChannelForm one = form.channels[c];
    if (plain.channels[c].free_constant) one.constant = 0;
    elsewhere += one.shows != plain.channels[c].shows;
    sum += Complexity(one, false, OfUnit(c, one.factor));
  }
  return sum + (elsewhere > 0 ? 1.0 : 0.0);
}

std::vector<ChannelSlip> SlipSearch::Find() {
  if (!model_.ok() || !(before_.maxCoeff() > kFarAbove)) return {};
  const FormFit looked = model_.Look(model_.Plain());
  std::vector<FormFit> forms;
  for (const RecordForm& form : Forms()) {
    const FormFit fit = model_.Look(form);
    if (fit.ok && (!looked.ok || fit.cost < looked.cost)) forms.push_back(fit);
  }
  std::sort(forms.begin(), forms.end(),
            [](const FormFit& a, const FormFit& b) { return a.cost < b.cost; });
  forms.resize(std::min(forms.size(), kMostForms));
  if (forms.empty()) return {};
  // What the record leaves as it is, alone, at its best.
  const FormFit plain = model_.Judge(model_.Fit(model_.Fit(looked, false), true));
  double least = before_.mean();
  if (plain.ok) least = std::min(least, plain.mean());
  if (!(least * static_cast<double>(before_.size()) > kFarAbove)) return {};
  std::vector<Found> found;
  for (const FormFit& form : forms) {
    const FormFit part = model_.Fit(form, false);
    FormFit whole = model_.Judge(model_.Fit(part, true));
    if (!whole.ok || whole.mean() > (1 - kExplains) * (least - 1) + 1) continue;
    whole = model_.Judge(model_.Fit(model_.With(whole, Simplest(whole)), true));
    if (!whole.ok || whole.mean() > (1 - kExplains) * (least - 1) + 1) continue;
    const double complexity = ComplexityOf(whole.form);
    if (complexity > 0) found.push_back({whole, complexity});
  }
  if (found.empty()) return {};
  double best = std::numeric_limits<double>::infinity();
  for (const Found& one : found) best = std::min(best, one.fit.mean());
  const Found* chosen = nullptr;
  for (const Found& one : found) {
    if (one.fit.mean() > kAlike * best + kOfNoise) continue;
    if (!chosen || one.complexity < chosen->complexity ||
        (one.complexity == chosen->complexity && one.fit.mean() < chosen->fit.mean()))
      chosen = &one;
  }
  return chosen ? Words(chosen->fit) : std::vector<ChannelSlip>();
}

ChannelSlip SlipSearch::OfChannel(std::size_t c, const FormFit& fit) const {
  const Channel& channel = experiment_.channels[c];
  const RecordForm plain = model_.Plain();
  const ChannelForm& form = fit.form.channels[c];
  ChannelSlip slip;
  slip.column = channel.column;
  slip.factor = form.factor;
  slip.constant = plain.channels[c].free_constant ? 0.0 : form.constant;
  std::string text;
  const auto also = [&](const std::string& more) {
    text += (text.empty() ? " fits " : ", ") + more;
  };
  if (form.shows != plain.channels[c].shows) {
    slip.kind = "axis";
    for (std::size_t other = 0; other < experiment_.channels.size(); ++other)
      if (other != c && plain.channels[other].shows == form.shows &&
          fit.form.channels[other].shows == plain.channels[c].shows) {
        slip.kind = "swapped";
        slip.shows = experiment_.channels[other].column;
        text = " is " + slip.shows + " (swapped?)";
      }
    if (slip.kind == "axis") {
      for (int axis = 0; axis < 3; ++axis)
        if (model_.ColumnOf(static_cast<int>(c), axis) == form.shows) slip.shows = "xyz"[axis];
      also("as axis " + slip.shows);
    }
  }
  const auto kind = [&](const char* name) {
    if (slip.kind.empty()) slip.kind = name;
  };
  if (form.factor != 1) {
    const char* unit = nullptr;
    for (const Unit& one : UnitsOf(channel.quantity))
      if (std::abs(std::abs(form.factor) / one.factor - 1) < 1e-9) unit = one.name;
    if (form.factor == -1) {
      kind("sign");
      also("with its sign turned");
    } else if (unit) {
      kind("unit");
      also(std::string("as ") + unit + " (factor " + FormatRounded(1 / form.factor, 4) + ")");
    } else {
      kind("gain");
      also("with a factor of " + FormatRounded(form.factor, 3) + " (gain?)");
    }
  }
  if (slip.constant != 0) {
    kind("offset");
    also("with a constant of " + WithUnit(channel.quantity, slip.constant) +
         ": `offset: unknown`?");
    constexpr double kNearGravity = 0.05;
    const double g = experiment_.gravity_W.norm();
    if (channel.quantity == Quantity::kAcceleration && g > 0 &&
        std::abs(std::abs(slip.constant) / g - 1) < kNearGravity)
      text += " Gravity seems to be in it";
  }
  slip.text = slip.kind.empty() ? "" : channel.column + text;
  return slip;
}

ChannelSlip SlipSearch::OfClock(const FormFit& fit) const {
  ChannelSlip slip;
  slip.delay = fit.form.delay;
  slip.kind = "delay";
  const bool driven = experiment_.a.motion || experiment_.b.motion;
  if (driven) {
    slip.text = "fits with times that are " + Seconds(std::abs(slip.delay)) +
                (slip.delay > 0 ? " late" : " early") + " beside the clamps' motion";
  } else if (slip.delay > 0) {
    slip.kind = "start";
    slip.text =
        "still until " + Seconds(experiment_.record.t.front() + slip.delay) + ": let go there?";
  } else {
    slip.kind = "start";
    slip.text = "swings already for " + Seconds(-slip.delay) +
                " when the record begins: `start: {unknown: true}`?";
  }
  return slip;
}

std::vector<ChannelSlip> SlipSearch::Words(const FormFit& fit) const {
  std::vector<ChannelSlip> slips;
  if (fit.form.free_delay) slips.push_back(OfClock(fit));
  for (std::size_t c = 0; c < experiment_.channels.size(); ++c) {
    const ChannelSlip slip = OfChannel(c, fit);
    if (!slip.kind.empty()) slips.push_back(slip);
  }
  for (ChannelSlip& slip : slips) {
    slip.experiment = experiment_.name;
    double before = before_.mean(), after = fit.mean();
    for (std::size_t c = 0; c < experiment_.channels.size(); ++c)
      if (experiment_.channels[c].column == slip.column) {
        before = before_[static_cast<Eigen::Index>(c)];
        after = fit.left[static_cast<Eigen::Index>(c)];
      }
    slip.before = std::sqrt(before);
    slip.after = std::sqrt(after);
  }
  return slips;
}

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

/// With an unknown start, sign and scale are the start's; a constant is not. Through the fit
/// itself, which finds the start.
std::vector<ChannelSlip> OffsetsBesideAStart(const MeasurementSet& set, std::size_t e,
                                             const ExperimentFit& before,
                                             const EstimationOptions& options) {
  MeasurementSet one = set;
  one.experiments = {set.experiments[e]};
  for (Channel& channel : one.experiments.front().channels) channel.unknown_offset = true;
  EstimationOptions cheap = options;
  cheap.profiles = cheap.scatter = cheap.slips = false;
  cheap.unknowns.scatter.clear();
  Problems unused;
  const Estimation fit = Estimate(one, cheap, &unused);
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

}  // namespace

std::vector<ChannelSlip> FindSlips(const MeasurementSet& set, const Estimation& fit,
                                   const EstimationOptions& options) {
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
    return options.time_limit > 0 ? options.time_limit - fit.seconds - taken.count()
                                  : std::numeric_limits<double>::infinity();
  };
  const auto ended = [&] { return (options.stop && options.stop()) || !(time_left() > 0); };
  EstimationOptions of_record = options;
  for (std::size_t k = 0; k < std::min(suspects.size(), kMostRecords) && !ended(); ++k) {
    const std::size_t e = suspects[k].second;
    if (options.progress &&
        !options.progress("looking for slips in " + set.experiments[e].name, 0.95))
      return slips;
    of_record.time_limit = std::min(time_left(), std::max(kLeastTime, kPartOfFit * fit.seconds));
    const std::vector<ChannelSlip> found =
        set.experiments[e].start.kind == StartCondition::Kind::kUnknown
            ? OffsetsBesideAStart(set, e, fit.experiments[e], of_record)
            : SlipSearch(set, static_cast<int>(e), fit.experiments[e], points).Find();
    slips.insert(slips.end(), found.begin(), found.end());
  }
  return slips;
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
