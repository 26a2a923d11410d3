#include "channel_slips.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>

#include "cosserat_cable/cable/parameters.h"
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
// What a slip leaves, in the noise's variance: with more, it stands for what the model lacks.
constexpr double kFaithful = 25;
// A form that leaves no more than so many times what a richer one leaves, and this part of the
// noise's variance, is as good. So it is where a channel needs nothing and is left near its noise.
constexpr double kAsGood = 1.25, kOfNoise = 0.15;
// What forms leave in the first part of a record, in the logarithm of the variance by sample,
// beyond the best one's: others are not followed.
constexpr double kFollowed = 1.5;
// A factor this near to a unit's is that unit's.
constexpr double kNearUnit = 0.03;
// Gains beyond this, either way, are none: a model that hardly moves, times a large factor.
constexpr double kLargestGain = 20;
// Forms that go on from the first part of a record.
constexpr std::size_t kMostForms = 12, kMostWhole = 6;
// No noise is taken to be less than this part of a channel's range where its level is unknown; and
// a residual beyond this part is looked at then.
constexpr double kUnknownLevel = 0.005, kUnknownMisfit = 0.05;
// What a record's own fit may take [s], and in parts of the whole fit.
constexpr double kLeastTime = 3, kPartOfFit = 0.1;
// Records whose slips are looked for, the worst first: each takes seconds.
constexpr std::size_t kMostRecords = 8;
// Of what is left, a form must leave less than this part to be simulated more finely; and where
// something was found, no more of what acts on the cable is tried after so long [s].
constexpr double kPromises = 0.1, kEnoughTime = 10;
// Complexities: of one slip, of more than two, and of so many that they explain anything.
constexpr double kSimple = 1.5, kSeveral = 2.8, kTooComplex = 6;
// Of what is left of a record without a slip, what is little.
constexpr double kLittle = 0.01;
// Of the noise, squared: nothing is left but noise.
constexpr double kNoise = 1.6;
// Of a record: with more, a channel that fits is not tried beside the others.
constexpr std::size_t kFewChannels = 4;

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
  return (other_column ? 1.0 : 0.0) + (scaled ? (of_unit ? 1.0 : 1.2) : 0.0) + (moved ? 1.0 : 0.0) +
         (scaled && moved && !of_unit ? 0.5 : 0.0);
}

/// Something of the set beside the channels that may be another one, for all of the record.
struct InputSlip {
  std::string kind;  ///< "load", "mass", "start", "parameter"
  std::string text;
  double factor = 1;   ///< by which the set's value is multiplied
  std::string named;   ///< a parameter that is to be found with the others
  bool of_set = true;  ///< it holds for all of the set's records
  MeasurementSet set;  ///< with it mended
};

void Scale(double factor, CableKey<std::vector<LumpedMassKey>>* masses) {
  if (!masses->value) return;
  for (LumpedMassKey& one : *masses->value) one.mass.mass *= factor;
}

/// Signs and units of what acts on the cable, as people mistake them.
std::vector<InputSlip> InputSlips(const MeasurementSet& set, std::size_t e) {
  constexpr double kGravity = 9.80665, kRadians = 0.017453292519943295;
  std::vector<InputSlip> slips;
  const auto add = [&](const char* kind, const std::string& text, double factor, bool of_set,
                       const auto& change) {
    slips.push_back({kind, text, factor, "", of_set, set});
    change(&slips.back().set);
  };
  const Experiment& experiment = set.experiments[e];
  const std::vector<ExperimentLoad::Sample>& forces = experiment.load.samples;
  if (std::any_of(forces.begin(), forces.end(),
                  [](const auto& force) { return force.force_W.norm() > 0; })) {
    for (const auto& [factor, text] :
         {std::pair<double, const char*>{-1, "with the sign of its load turned"},
          {kGravity, "with its load in kilograms"},
          {1e-3 * kGravity, "with its load in grams"},
          {1e-3, "with its load in millinewtons"},
          {4.4482216, "with its load in pounds"}})
      add("load", text, factor, false, [&, factor = factor](MeasurementSet* changed) {
        for (ExperimentLoad::Sample& force : changed->experiments[e].load.samples)
          force.force_W *= factor;
      });
    // Of several, one alone.
    for (std::size_t k = 0; experiment.load.file.empty() && forces.size() > 1 && k < forces.size();
         ++k)
      add("load", "with the sign of its load at s = " + FormatRounded(forces[k].s) + " m turned",
          -1, false,
          [&](MeasurementSet* changed) { changed->experiments[e].load.samples[k].force_W *= -1; });
  }
  CableKeys keys = SpecimenKeys(set, experiment);
  const auto grams = [](double factor) {
    return " in grams (factor " + FormatRounded(factor) + ")";
  };
  if (keys.masses.value && !keys.masses.value->empty())
    add("mass", "with `masses`" + grams(1e-3), 1e-3, true, [](MeasurementSet* changed) {
      Scale(1e-3, &changed->cable.masses);
      for (Experiment& one : changed->experiments) Scale(1e-3, &one.specimen.masses);
    });
  if (const auto paths = ParameterPaths(keys); true)
    for (const std::string& path : paths) {
      if (path.rfind("extensions.added_mass", 0) != 0 || UnitOf(path) != "kg") continue;
      const std::optional<double> value = GetParameter(path, set.cable);
      if (!value || !(*value > 0)) continue;
      add("mass", "with [" + path + "]" + grams(1e-3), 1e-3, true,
          [&](MeasurementSet* changed) { SetParameter(path, 1e-3 * *value, &changed->cable); });
    }
  if (experiment.b.kind == EndCondition::Kind::kDisc) {
    const auto disc = [&](const std::string& text, double factor, double Disc::*number) {
      add("mass", text + " (factor " + FormatRounded(factor) + ")", factor, true,
          [=](MeasurementSet* changed) {
            for (Experiment& one : changed->experiments) one.b.disc.*number *= factor;
          });
    };
    if (experiment.b.disc.mass > 0) disc("with the disc's mass in grams", 1e-3, &Disc::mass);
    if (experiment.b.disc.inertia > 0)
      for (const auto& [factor, unit] :
           {std::pair<double, const char*>{1e-3, "g m^2"}, {1e-4, "kg cm^2"}, {1e-7, "g cm^2"}})
        disc(std::string("with the disc's inertia in ") + unit, factor, &Disc::inertia);
  }
  if (keys.mass_per_length.value)
    add("mass", "with [mass_per_length] in g/m (factor 0.001)", 1e-3, true,
        [](MeasurementSet* changed) {
          const auto mend = [](CableKeys* keys) {
            if (keys->mass_per_length.value) *keys->mass_per_length.value *= 1e-3;
          };
          mend(&changed->cable);
          for (Experiment& one : changed->experiments) mend(&one.specimen);
        });
  if (experiment.start.kind == StartCondition::Kind::kTwisted)
    for (const auto& [factor, text] :
         {std::pair<double, const char*>{-1, "with the sign of `twisted` turned"},
          {kRadians, "with `twisted` in degrees"}})
      add("start", text, factor, false, [&, factor = factor](MeasurementSet* changed) {
        changed->experiments[e].start.twisted *= factor;
      });
  // What the set says to be known may be off.
  if (set.cable.uncertain.value) {
    const std::string name = experiment.b.kind == EndCondition::Kind::kDisc ? "GJ" : "EI";
    const auto& names = *set.cable.uncertain.value;
    if (std::none_of(names.begin(), names.end(),
                     [&](const UncertainKey& key) { return key.name.rfind(name, 0) == 0; }) &&
        GetParameter(name, keys)) {
      add("parameter", "", 1, true, [&](MeasurementSet* changed) {
        changed->cable.uncertain.value->push_back({name, set.cable.uncertain.mark});
      });
      slips.back().named = name;
    }
  }
  return slips;
}

using Points = std::vector<std::vector<std::pair<std::string, double>>>;

/// What was found for a record.
struct Found {
  FormFit fit;
  double complexity = 0;
  const InputSlip* input = nullptr;
};

class SlipSearch {
 public:
  SlipSearch(const MeasurementSet& set, int experiment, const ExperimentFit& fit,
             const Points& points, const std::string& known, const std::function<bool()>& stop)
      : set_(set),
        known_(known),
        index_(experiment),
        experiment_(set.experiments[static_cast<std::size_t>(experiment)]),
        usable_(UsableSamples(experiment_.record)),
        level_(Levels(fit)),
        points_(points),
        stop_(stop),
        model_(set, experiment, level_, usable_, points, stop),
        inputs_(InputSlips(set, static_cast<std::size_t>(experiment))) {
    before_ = Left(fit);
  }

  std::vector<ChannelSlip> Find();
  /// The set with what was found mended where that holds for all records; null where nothing was.
  const MeasurementSet* mended() const { return mended_; }
  /// The words for it, where it is of what acts on the cable.
  const std::string& input() const { return input_; }

 private:
  Eigen::VectorXd Levels(const ExperimentFit& fit) const;
  Eigen::VectorXd Left(const ExperimentFit& fit) const;
  std::vector<RecordForm> Forms(const std::vector<bool>& suspects) const;
  FormFit Simplest(const FormFit& fit) const;
  bool IsAsGood(const FormFit& simple, const FormFit& rich, Eigen::Index identity) const;
  bool OfUnit(std::size_t channel, double factor) const;
  double ComplexityOf(const RecordForm& form) const;
  bool Explains(const FormFit& fit, double least, bool simplest = true) const;
  void SnapToUnits(RecordForm* form) const;
  std::vector<Found> OfChannels(const FormFit& looked, const FormFit& plain, double least) const;
  std::vector<Found> OfInputs(double least, const std::vector<Found>& beside) const;
  std::optional<Found> OfInput(const InputSlip& input, double least) const;
  FormFit WholeOf(const SlipModel& model, const FormFit& part, double least) const;
  double FarFromSet(const SlipModel& model, const FormFit& fit) const;
  std::vector<ChannelSlip> Words(const Found& found, const Found* other) const;
  ChannelSlip OfChannel(std::size_t channel, const FormFit& fit) const;
  ChannelSlip OfClock(const FormFit& fit) const;
  ChannelSlip OfInput(const InputSlip& input, const FormFit& fit) const;

  const MeasurementSet& set_;
  std::string known_;  // the words for what was found in another record
  int index_;
  const Experiment& experiment_;
  Eigen::MatrixXd usable_;
  Eigen::VectorXd level_;
  const Points& points_;
  std::function<bool()> stop_;
  SlipModel model_;
  std::vector<InputSlip> inputs_;
  Eigen::VectorXd before_;  // by channel, mean square left over the level's
  const MeasurementSet* mended_ = nullptr;
  std::string input_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
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

/// With those channels free that do not fit as they are, all together and each by itself, another
/// clock, and other axes.
std::vector<RecordForm> SlipSearch::Forms(const std::vector<bool>& suspects) const {
  const RecordForm plain = model_.Plain();
  std::vector<RecordForm> forms;
  const auto add = [&](const auto& change) {
    RecordForm form = plain;
    change(&form);
    forms.push_back(form);
  };
  const auto& channels = experiment_.channels;
  const auto add_free = [&](const std::vector<bool>& which) {
    for (const bool factor : {false, true})
      for (const bool constant : {false, true})
        if (factor || constant)
          add([&](RecordForm* form) {
            for (std::size_t c = 0; c < channels.size(); ++c) {
              ChannelForm& channel = form->channels[c];
              if (!which[c]) continue;
              channel.free_factor = factor;
              channel.free_constant = channel.free_constant || constant;
            }
          });
  };
  const auto count = std::count(suspects.begin(), suspects.end(), true);
  const std::vector<bool> all(channels.size(), true);
  if (count > 1) add_free(suspects);
  if (suspects != all && channels.size() > 1 && channels.size() <= kFewChannels) add_free(all);
  for (std::size_t c = 0; c < channels.size(); ++c) {
    if (!suspects[c] && channels.size() > kFewChannels) continue;
    std::vector<bool> one(channels.size(), false);
    one[c] = true;
    add_free(one);
  }
  if (model_.LongestDelay() > 0) {
    add([&](RecordForm* form) { form->free_delay = true; });
    add([&](RecordForm* form) { form->free_rate = true; });
  }
  for (std::size_t c = 0; c < channels.size(); ++c) {
    for (int axis = 0; axis < 3; ++axis) {
      const int column = model_.ColumnOf(static_cast<int>(c), axis);
      if (column < 0 || axis == channels[c].axis || !suspects[c]) continue;
      for (const double factor : {1.0, -1.0})
        add([&](RecordForm* form) {
          form->channels[c].shows = column;
          form->channels[c].factor = factor;
        });
    }
    for (std::size_t other = 0; other < c; ++other)
      if (channels[other].quantity == channels[c].quantity && (suspects[c] || suspects[other]))
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

/// Whether a simpler form leaves no more than a richer one. `identity`: a channel that is as the
/// set says in it, -1 for none: such a one may be left somewhat above its noise.
bool SlipSearch::IsAsGood(const FormFit& simple, const FormFit& rich, Eigen::Index identity) const {
  if (!simple.ok) return false;
  for (Eigen::Index c = 0; c < simple.left.size(); ++c) {
    double most = kAsGood * std::max(rich.left[c], 0.8) + kOfNoise;
    if (identity >= 0) most = std::max(most, c == identity ? kFarAbove : 0.5 * kFarAbove);
    if (simple.left[c] > most) return false;
  }
  return true;
}

/// Of a channel after the other, the simplest form that leaves about as little, all else fitted
/// anew.
FormFit SlipSearch::Simplest(const FormFit& fit) const {
  const RecordForm plain = model_.Plain();
  FormFit best = fit;
  // First, those that need least.
  std::vector<std::size_t> order;
  for (std::size_t c = 0; c < plain.channels.size(); ++c) order.push_back(c);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(std::log(std::abs(fit.form.channels[a].factor) + 1e-300)) <
           std::abs(std::log(std::abs(fit.form.channels[b].factor) + 1e-300));
  });
  for (const std::size_t c : order) {
    const ChannelForm& own = plain.channels[c];
    const ChannelForm rich = best.form.channels[c];
    const bool of_unit = !rich.free_factor && rich.factor != own.factor;
    if (!rich.free_factor && !(rich.free_constant && !own.free_constant)) continue;
    ChannelForm identity = own;
    identity.shows = rich.shows;
    std::vector<ChannelForm> candidates = {identity};
    ChannelForm next = identity;
    if (rich.free_constant && !own.free_constant) {
      next.free_constant = true;
      candidates.push_back(next);
    }
    if (of_unit) {
      next = rich;
      next.free_constant = own.free_constant;
      next.constant = 0;
      candidates.push_back(next);
      candidates.push_back(rich);
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
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      RecordForm tried = best.form;
      tried.channels[c] = candidates[k];
      const FormFit judged = model_.Judge(model_.Fit(model_.With(best, tried), true));
      if (!IsAsGood(judged, best, k == 0 ? static_cast<Eigen::Index>(c) : -1)) continue;
      best = judged;
      break;
    }
  }
  return best;
}

double SlipSearch::ComplexityOf(const RecordForm& form) const {
  const RecordForm plain = model_.Plain();
  double sum = (form.free_delay ? 1.0 : 0.0) + (form.free_rate ? 1.0 : 0.0);
  int elsewhere = 0;
  for (std::size_t c = 0; c < form.channels.size(); ++c) {
    ChannelForm one = form.channels[c];
    if (plain.channels[c].free_constant) one.constant = 0;
    elsewhere += one.shows != plain.channels[c].shows;
    sum += Complexity(one, false, OfUnit(c, one.factor));
  }
  return sum + (elsewhere > 0 ? 1.0 : 0.0);
}

bool SlipSearch::Explains(const FormFit& fit, double least, bool simplest) const {
  for (const ChannelForm& channel : fit.form.channels)
    if (channel.free_factor &&
        !(std::abs(channel.factor) < kLargestGain && std::abs(channel.factor) > 1 / kLargestGain))
      return false;
  // What a slip leaves is near the noise, or little beside what was there; several leave noise.
  const double most = !simplest ? kFaithful
                      : ComplexityOf(fit.form) > kSeveral
                          ? kNoise
                          : std::clamp(kLittle * least, kFarAbove, kFaithful);
  return fit.ok && fit.mean() <= (1 - kExplains) * (least - 1) + 1 && fit.left.maxCoeff() <= most;
}

/// A factor near that of a unit is that unit's.
void SlipSearch::SnapToUnits(RecordForm* form) const {
  for (std::size_t c = 0; c < form->channels.size(); ++c) {
    ChannelForm& channel = form->channels[c];
    for (const Unit& unit : UnitsOf(experiment_.channels[c].quantity)) {
      if (!channel.free_factor || unit.factor < kLargestGain ||
          std::abs(std::abs(channel.factor) / unit.factor - 1) > kNearUnit)
        continue;
      channel.free_factor = false;
      channel.factor = std::copysign(unit.factor, channel.factor);
    }
  }
}

std::vector<Found> SlipSearch::OfChannels(const FormFit& looked, const FormFit& plain,
                                          double least) const {
  // With the parameters at their best, a channel that slips stands out beside those that do not.
  std::vector<bool> suspects(experiment_.channels.size(), true);
  if (plain.ok)
    for (std::size_t c = 0; c < suspects.size(); ++c)
      suspects[c] = plain.left[static_cast<Eigen::Index>(c)] > kFarAbove;
  std::vector<FormFit> forms;
  for (const RecordForm& form : Forms(suspects)) {
    if (stop_ && stop_()) return {};
    const FormFit fit = model_.Look(form);
    if (fit.ok && (fit.form.free_rate || !looked.ok || fit.cost < looked.cost))
      forms.push_back(fit);
  }
  const auto by_cost = [](const FormFit& a, const FormFit& b) { return a.cost < b.cost; };
  const auto keep_best = [&](std::size_t most) {
    std::sort(forms.begin(), forms.end(), by_cost);
    std::vector<FormFit> kept;
    for (const FormFit& form : forms)
      if (form.form.free_rate || (kept.size() < most && form.cost < forms.front().cost + kFollowed))
        kept.push_back(form);
    forms = std::move(kept);
  };
  keep_best(kMostForms);
  for (FormFit& form : forms) form = model_.Fit(form, false);
  forms.erase(
      std::remove_if(forms.begin(), forms.end(), [](const FormFit& one) { return !one.ok; }),
      forms.end());
  keep_best(kMostWhole);
  // The simplest first: where a single slip leaves noise, richer forms are not simulated.
  const auto freedom = [](const FormFit& fit) {
    int count = (fit.form.free_delay ? 1 : 0) + (fit.form.free_rate ? 1 : 0);
    for (const ChannelForm& channel : fit.form.channels)
      count += (channel.free_factor ? 1 : 0) + (channel.free_constant ? 1 : 0);
    return count;
  };
  std::stable_sort(forms.begin(), forms.end(),
                   [&](const FormFit& a, const FormFit& b) { return freedom(a) < freedom(b); });
  std::vector<Found> found;
  int enough = std::numeric_limits<int>::max();
  for (const FormFit& form : forms) {
    if (stop_ && stop_()) return {};
    if (freedom(form) > enough) continue;
    FormFit part = form;
    SnapToUnits(&part.form);
    FormFit whole = WholeOf(model_, part, least);
    if (Explains(whole, least) && freedom(form) == 1 && !(whole.left.maxCoeff() > kNoise))
      enough = freedom(form);
    if (!Explains(whole, least, false)) continue;
    whole = Simplest(whole);
    const double complexity = ComplexityOf(whole.form) + FarFromSet(model_, whole);
    if (Explains(whole, least) && ComplexityOf(whole.form) > 0 && complexity < kTooComplex)
      found.push_back({whole, complexity, nullptr});
  }
  return found;
}

/// To the end of the record; where that promises something, with what steps in space and time do.
FormFit SlipSearch::WholeOf(const SlipModel& model, const FormFit& part, double least) const {
  FormFit whole = model.Judge(model.Fit(part, true));
  if (!whole.ok || !(whole.mean() < kPromises * least) || !(whole.left.maxCoeff() > kNoise))
    return whole;
  if (model.Refine(whole)) whole = model.Judge(model.Fit(whole, true));
  return whole;
}

/// A stiffness far from the set's makes an explanation less simple: by half a slip for a factor of
/// ten beyond two.
double SlipSearch::FarFromSet(const SlipModel& model, const FormFit& fit) const {
  double farthest = 0;
  for (const char* name : {"EI", "EI1", "EI2", "GJ"}) {
    const std::optional<double> value = model.ValueOf(name, fit);
    const std::optional<double> given = GetParameter(name, SpecimenKeys(set_, experiment_));
    if (value && given && *value > 0 && *given > 0)
      farthest = std::max(farthest, std::abs(std::log(*value / *given)));
  }
  return 0.5 * std::max(0.0, farthest - std::log(2.0)) / std::log(10.0);
}

std::optional<Found> SlipSearch::OfInput(const InputSlip& input, double least) const {
  const SlipModel model(input.set, index_, level_, usable_, points_, stop_);
  if (!model.ok()) return std::nullopt;
  const FormFit whole = WholeOf(model, model.Fit(model.Look(model.Plain()), false), least);
  if (!Explains(whole, least)) return std::nullopt;
  // What is wrong with a start is as well wrong with a channel.
  Found found = {whole, input.kind == "start" ? 1.1 : 1.0, &input};
  const std::optional<double> value = model.ValueOf(input.named, whole);
  if (value)
    found.fit.named = *value;
  else
    found.complexity += FarFromSet(model, whole);
  return found;
}

std::vector<Found> SlipSearch::OfInputs(double least, const std::vector<Found>& beside) const {
  std::vector<Found> found;
  for (const InputSlip& input : inputs_) {
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin_;
    if (stop_ && stop_()) break;
    // Units of one thing are all tried: only together they tell which it is.
    const bool begun = !found.empty() && found.back().input->kind == input.kind;
    const auto is_simple = [](const Found& one) { return one.complexity < kSimple; };
    if (taken.count() > kEnoughTime && !begun &&
        (std::any_of(found.begin(), found.end(), is_simple) ||
         std::any_of(beside.begin(), beside.end(), is_simple)))
      break;
    if (std::optional<Found> one = OfInput(input, least)) found.push_back(std::move(*one));
  }
  return found;
}

std::vector<ChannelSlip> SlipSearch::Find() {
  if (!(before_.maxCoeff() > kFarAbove)) return {};
  double least = before_.mean();
  std::vector<Found> found;
  // What another record has is likely to be in this one, too.
  for (const InputSlip& input : inputs_) {
    if (input.text != known_ || known_.empty()) continue;
    const std::optional<Found> same = OfInput(input, least);
    if (same && !(same->fit.left.maxCoeff() > kFarAbove)) return Words(*same, nullptr);
  }
  if (model_.ok()) {
    // What the record leaves as it is, alone, at its best.
    const FormFit looked = model_.Look(model_.Plain());
    FormFit plain = model_.Judge(model_.Fit(model_.Fit(looked, false), true));
    if (plain.ok && model_.Refine(plain)) plain = model_.Judge(model_.Fit(plain, true));
    if (plain.ok && !(plain.left.maxCoeff() > kFarAbove)) return {};
    if (plain.ok) least = std::min(least, plain.mean());
    if (!(least * static_cast<double>(before_.size()) > kFarAbove)) return {};
    found = OfChannels(looked, plain, least);
  }
  const std::vector<Found> of_inputs = OfInputs(least, found);
  found.insert(found.end(), of_inputs.begin(), of_inputs.end());
  if (found.empty() || (stop_ && stop_())) return {};
  const auto best =
      std::min_element(found.begin(), found.end(),
                       [](const Found& a, const Found& b) { return a.fit.mean() < b.fit.mean(); });
  const auto is_alike = [&](const Found& one) {
    return one.fit.mean() <= kAsGood * std::max(best->fit.mean(), 1.0) + kOfNoise;
  };
  const auto goes_before = [](const Found& a, const Found& b) {
    return a.complexity != b.complexity ? a.complexity < b.complexity : a.fit.mean() < b.fit.mean();
  };
  const Found* chosen = nullptr;
  for (const Found& one : found)
    if (is_alike(one) && (!chosen || goes_before(one, *chosen))) chosen = &one;
  // What is as simple and fits as well is told beside it: a turned force is a turned channel.
  const Found* other = nullptr;
  for (const Found& one : found)
    if (is_alike(one) && (one.input || chosen->input) && one.input != chosen->input &&
        one.complexity <= chosen->complexity && (!other || goes_before(one, *other)))
      other = &one;
  if (chosen->input) input_ = chosen->input->text;
  if (chosen->input && chosen->input->of_set) mended_ = &chosen->input->set;
  return Words(*chosen, other);
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
  if (fit.form.free_rate) {
    slip.kind = "clock";
    slip.factor = 1 + fit.form.rate;
    slip.text = "fits with a clock that is " + FormatRounded(100 * std::abs(fit.form.rate), 2) +
                " % " + (fit.form.rate > 0 ? "fast" : "slow") +
                ": `faults.clock.scale` in `uncertain`?";
    return slip;
  }
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

ChannelSlip SlipSearch::OfInput(const InputSlip& input, const FormFit& fit) const {
  ChannelSlip slip;
  slip.kind = input.kind;
  slip.factor = input.factor;
  slip.text = "fits " + input.text;
  if (!input.named.empty()) {
    const double given = GetParameter(input.named, SpecimenKeys(set_, experiment_)).value_or(0);
    slip.factor = given > 0 ? fit.named / given : 1.0;
    slip.text = "fits with [" + input.named + "] = " + FormatRounded(fit.named) +
                " instead of the set's " + FormatRounded(given) + ": name it in `uncertain`?";
  }
  return slip;
}

std::vector<ChannelSlip> SlipSearch::Words(const Found& found, const Found* other) const {
  std::vector<ChannelSlip> slips;
  const FormFit& fit = found.fit;
  if (found.input) {
    slips.push_back(OfInput(*found.input, fit));
  } else {
    if (fit.form.free_delay || fit.form.free_rate) slips.push_back(OfClock(fit));
    for (std::size_t c = 0; c < experiment_.channels.size(); ++c) {
      const ChannelSlip slip = OfChannel(c, fit);
      if (!slip.kind.empty()) slips.push_back(slip);
    }
  }
  if (other && !slips.empty()) {
    const std::vector<ChannelSlip> as_well = Words(*other, nullptr);
    if (!as_well.empty()) slips.front().text += " (as well: " + as_well.front().text + ")";
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
  // With what holds for all records mended.
  std::optional<MeasurementSet> mended;
  std::string input;
  for (std::size_t k = 0; k < std::min(suspects.size(), kMostRecords) && !ended(); ++k) {
    const std::size_t e = suspects[k].second;
    if (options.progress &&
        !options.progress("looking for slips in " + set.experiments[e].name, 0.95))
      return slips;
    of_record.time_limit = std::min(time_left(), std::max(kLeastTime, kPartOfFit * fit.seconds));
    if (set.experiments[e].start.kind == StartCondition::Kind::kUnknown) {
      const auto found = OffsetsBesideAStart(set, e, fit.experiments[e], of_record);
      slips.insert(slips.end(), found.begin(), found.end());
      continue;
    }
    const MeasurementSet now = mended ? *mended : set;
    SlipSearch search(now, static_cast<int>(e), fit.experiments[e], points, input, ended);
    const std::vector<ChannelSlip> found = search.Find();
    slips.insert(slips.end(), found.begin(), found.end());
    if (search.mended()) mended = *search.mended();
    if (!search.input().empty()) input = search.input();
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
