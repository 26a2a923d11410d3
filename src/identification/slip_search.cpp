#include "slip_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cosserat_cable/cable/parameters.h"
#include "cosserat_cable/fit/damage.h"
#include "cosserat_cable/input/number_text.h"
#include "slip_units.h"

namespace cosserat_cable {
namespace {

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
// Of what is left, a form must leave less than this part to be simulated more finely; and where
// something was found, no more of what acts on the cable is tried after so long [s].
constexpr double kPromises = 0.1, kEnoughTime = 30;
// Complexities: of one slip, of more than two, and of so many that they explain anything.
constexpr double kSimple = 1.5, kSeveral = 2.8, kTooComplex = 6;
// Of a start that is elsewhere, and of a factor that is to be found, beside a turned sign or a
// unit.
constexpr double kOfStart = 1.1, kOfGain = 1.2;
// A factor is looked for in so many steps of a grid, and then until it is known so well, relative.
constexpr int kFactors = 10;
constexpr double kFactorFound = 3e-3;
// A sum of squares of a unit larger by more than this is no chance (99.9 %) beside a free factor's.
constexpr double kChance = 10.8;
// Explanations that are told beside the one that is chosen.
constexpr std::size_t kMostOthers = 3;
// Of what is left of a record without a slip, what is little.
constexpr double kLittle = 0.01;
// Of the noise, squared: nothing is left but noise.
constexpr double kNoise = 1.6;
// Of a record: with more, a channel that fits is not tried beside the others.
constexpr std::size_t kFewChannels = 4;

/// How far from what the set says; slips that explain as much are ordered by it.
double Complexity(const ChannelForm& form, bool other_column, bool of_unit) {
  const bool scaled = form.factor != 1, moved = form.constant != 0;
  return (other_column ? 1.0 : 0.0) + (scaled ? (of_unit ? 1.0 : 1.2) : 0.0) + (moved ? 1.0 : 0.0) +
         (scaled && moved && !of_unit ? 0.5 : 0.0);
}

}  // namespace

bool IsStiffness(const std::string& name) {
  return name == "EI" || name == "EI1" || name == "EI2" || name == "GJ";
}

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
    if (model_.LongestDelay() > 0 && channels.size() > 1 && suspects[c])
      add([&](RecordForm* form) {
        form->free_delay = true;
        form->delayed = static_cast<int>(c);
      });
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
  // A swing that fades fits as well later as with another scale.
  if (form.free_delay && form.delay < 0) sum = kOfStart;
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
      if (!channel.free_factor || std::max(unit.factor, 1 / unit.factor) < kLargestGain ||
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
      found.push_back({whole, complexity, nullptr, 1, model_.ValuesOf(whole)});
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
  for (const auto& [name, value] : model.ValuesOf(fit)) {
    if (!IsStiffness(name)) continue;
    const std::optional<double> given = GetParameter(name, SpecimenKeys(set_, experiment_));
    if (given && *given > 0) farthest = std::max(farthest, std::abs(std::log(value / *given)));
  }
  return 0.5 * std::max(0.0, farthest - std::log(2.0)) / std::log(10.0);
}

/// Nothing where it explains little, or already in the first part leaves more than the record as it
/// is, `looked`.
std::optional<Found> SlipSearch::OfInput(const InputSlip& input, double factor,
                                         const FormFit& looked, double least) const {
  const MeasurementSet set = input.Mended(set_, factor);
  const SlipModel model(set, index_, level_, usable_, points_, stop_);
  if (!model.ok()) return std::nullopt;
  const FormFit begun = model.Look(model.Plain());
  if (looked.ok && begun.ok && begun.cost > looked.cost + kFollowed) return std::nullopt;
  const FormFit whole = WholeOf(model, model.Fit(begun, false), least);
  if (!Explains(whole, least)) return std::nullopt;
  // What is wrong with a start is as well wrong with a channel.
  const double complexity = input.kind == "start" ? kOfStart : input.free_factor() ? kOfGain : 1.0;
  Found found = {whole, complexity, &input, factor, model.ValuesOf(whole)};
  const std::optional<double> value = model.ValueOf(input.named, whole);
  if (value)
    found.fit.named = *value;
  else
    found.complexity += FarFromSet(model, whole);
  return found;
}

/// With which the record is left least, all parameters at their best: the least of a grid, and the
/// golden section between its neighbours.
double SlipSearch::BestFactor(const InputSlip& input, const FormFit& plain) const {
  Points points = points_;
  points.push_back(model_.ValuesOf(plain));
  const auto cost = [&](double logarithm) {
    const MeasurementSet set = input.Mended(set_, std::exp(logarithm));
    const SlipModel model(set, index_, level_, usable_, points, stop_, true);
    if (!model.ok()) return std::numeric_limits<double>::infinity();
    const FormFit fit = model.Judge(model.Fit(model.Look(model.Plain()), true));
    return fit.ok ? fit.cost : std::numeric_limits<double>::infinity();
  };
  const double low = std::log(input.least), step = (std::log(input.most) - low) / kFactors;
  double best = low, least = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= kFactors && !(stop_ && stop_()); ++k)
    if (const double now = cost(low + k * step); now < least) {
      least = now;
      best = low + k * step;
    }
  const double golden = 0.5 * (std::sqrt(5.0) - 1);
  double a = best - step, b = best + step;
  double inner[2] = {b - golden * (b - a), a + golden * (b - a)};
  double costs[2] = {cost(inner[0]), cost(inner[1])};
  while (b - a > kFactorFound && !(stop_ && stop_())) {
    const int better = costs[0] < costs[1] ? 0 : 1;
    (better == 0 ? b : a) = inner[1 - better];
    inner[1 - better] = inner[better];
    costs[1 - better] = costs[better];
    inner[better] = better == 0 ? b - golden * (b - a) : a + golden * (b - a);
    costs[better] = cost(inner[better]);
  }
  return std::exp(0.5 * (a + b));
}

std::vector<Found> SlipSearch::OfInputs(const FormFit& looked, const FormFit& plain, double least,
                                        const std::vector<Found>& beside) const {
  std::vector<Found> found;
  const auto any = [&](const auto& is) {
    return std::any_of(found.begin(), found.end(), is) ||
           std::any_of(beside.begin(), beside.end(), is);
  };
  for (const InputSlip& input : inputs_) {
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin_;
    if (stop_ && stop_()) break;
    // Units of one thing are all tried: only together they tell which it is.
    const bool begun = std::any_of(found.begin(), found.end(),
                                   [&](const Found& one) { return one.input->kind == input.kind; });
    if (taken.count() > kEnoughTime && !begun &&
        any([](const Found& one) { return one.complexity < kSimple; }))
      break;
    // No factor is looked for where something simpler leaves nothing but noise, unless that is a
    // unit, beside which the factor may be another one.
    const auto is_unit_of = [&](const Found& one) {
      return one.input && one.input->kind == input.kind && one.factor > input.least &&
             one.factor < input.most && one.factor != 1;
    };
    if (input.free_factor() && (!plain.ok || any([&](const Found& one) {
          return one.complexity < kOfGain && !(one.fit.left.maxCoeff() > kNoise) &&
                 !is_unit_of(one);
        })))
      continue;
    const double factor = input.free_factor() ? BestFactor(input, plain) : input.factor;
    if (input.free_factor() && std::abs(std::log(factor)) < kNearUnit) continue;
    std::optional<Found> one = OfInput(input, factor, looked, least);
    if (!one) continue;
    if (input.free_factor()) {
      const double samples = usable_.sum();
      const auto is_refuted = [&](const Found& unit) {
        return is_unit_of(unit) && std::abs(std::log(unit.factor / factor)) > kNearUnit &&
               samples * (unit.fit.mean() / one->fit.mean() - 1) > kChance;
      };
      found.erase(std::remove_if(found.begin(), found.end(), is_refuted), found.end());
    }
    found.push_back(std::move(*one));
  }
  return found;
}

/// Whether the record fits as it is beside another one that slips, with parameters nearer to what
/// the other shows than those with the same slip in this one.
bool SlipSearch::IsHealthy(const FormFit& plain, const std::optional<Found>& same) const {
  if (!plain.ok || plain.left.maxCoeff() > kFarAbove) return false;
  const FormFit as_the_other = model_.At(known_->values);
  if (as_the_other.ok && !(as_the_other.left.maxCoeff() > kFarAbove)) return true;
  if (!same) return true;
  const auto distance = [&](const Values& values) {
    double sum = 0;
    for (const auto& [name, value] : values)
      for (const auto& [other, known] : known_->values)
        if (name == other && IsStiffness(name)) sum += std::abs(std::log(value / known));
    return sum;
  };
  return distance(model_.ValuesOf(plain)) <= distance(same->values);
}

std::vector<ChannelSlip> SlipSearch::Find() {
  if (!(before_.maxCoeff() > kFarAbove)) return {};
  double least = before_.mean();
  std::vector<Found> found;
  FormFit looked, plain;
  if (model_.ok()) {
    // What the record leaves as it is, alone, at its best.
    looked = model_.Look(model_.Plain());
    plain = model_.Judge(model_.Fit(model_.Fit(looked, false), true));
    if (plain.ok && model_.Refine(plain)) plain = model_.Judge(model_.Fit(plain, true));
  }
  // What another record has may be in this one, too.
  for (const InputSlip& input : inputs_) {
    if (!known_ || input.text != known_->input.text) continue;
    const std::optional<Found> same = OfInput(input, known_->factor, {}, least);
    if (IsHealthy(plain, same)) return {};
    if (!same || same->fit.left.maxCoeff() > kFarAbove) continue;
    input_ = KnownSlip{input, same->factor, same->values};
    return Words(*same, {});
  }
  if (plain.ok && !(plain.left.maxCoeff() > kFarAbove)) {
    alone_ = model_.ValuesOf(plain);
    return {};
  }
  if (plain.ok) least = std::min(least, plain.mean());
  if (model_.ok()) {
    if (!(least * static_cast<double>(before_.size()) > kFarAbove)) return {};
    found = OfChannels(looked, plain, least);
  }
  const std::vector<Found> of_inputs = OfInputs(looked, plain, least, found);
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
  std::vector<const Found*> others;
  for (const Found& one : found)
    if (is_alike(one) && (one.input || chosen->input) && one.input != chosen->input &&
        one.complexity <= chosen->complexity)
      others.push_back(&one);
  std::sort(others.begin(), others.end(),
            [&](const Found* a, const Found* b) { return goes_before(*a, *b); });
  others.resize(std::min(others.size(), kMostOthers));
  if (chosen->input) {
    input_ = KnownSlip{*chosen->input, chosen->factor, chosen->values};
  } else {
    // From there the record may be found to fit as it is.
    plain = model_.Judge(model_.Fit(model_.With(chosen->fit, model_.Plain()), true));
    if (plain.ok && !(plain.left.maxCoeff() > kFarAbove)) {
      alone_ = model_.ValuesOf(plain);
      return {};
    }
  }
  return Words(*chosen, others);
}

}  // namespace cosserat_cable
