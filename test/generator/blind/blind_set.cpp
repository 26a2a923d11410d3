#include "blind_set.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "../effect_sets.h"
#include "../experiment_parts.h"
#include "strength.h"
#include "suites.h"

namespace cosserat_cable::generator {
namespace {

using CaseOf = Case (*)(const BlindPlan&, Random*);

const std::map<std::string, CaseOf>& suites() {
  static const std::map<std::string, CaseOf> all = {{"single", singleCase},
                                                    {"null", nullCase},
                                                    {"outside", outsideCase},
                                                    {"twins", twinsCase},
                                                    {"twins-without", twinsWithoutCase},
                                                    {"absorbed", absorbedCase},
                                                    {"pairs", pairsCase},
                                                    {"unidentifiable", unidentifiableCase}};
  return all;
}

/// Fewer times than this the noise, an effect need not be found.
constexpr double kWeak = 1.2;
/// Chi from which on data tell look-alikes apart.
constexpr double kTold = 8.0;

/// What the sensors show, with noise of these sizes.
std::vector<MeasuredExperiment> sensed(const std::vector<Experiment>& experiments,
                                       const std::vector<Record>& records,
                                       const std::vector<Eigen::VectorXd>& sigma,
                                       const BlindSet& set, Random* random) {
  std::vector<MeasuredExperiment> result;
  for (size_t i = 0; i < experiments.size(); ++i) {
    MeasuredExperiment measured;
    measured.experiment = experiments[i];
    measured.values = records[i].values;
    measured.sigma = sigma[i];
    const bool slow = !experiments[i].tip_forces.empty();
    for (int c = 0; c < measured.values.cols(); ++c) {
      addNoise(sigma[i][c], slow ? 0.0 : set.correlation, random, measured.values.col(c));
      measured.told.push_back(set.told);
    }
    result.push_back(measured);
  }
  return result;
}

std::vector<Record> recordsOf(const std::vector<Experiment>& experiments) {
  std::vector<Record> records;
  for (const Experiment& e : experiments) records.push_back(simulate(e, recordAccuracy(e)));
  return records;
}

void shorten(int steps, Experiment* e) {
  if (e->tip_forces.empty() || steps == 0) return;
  e->tip_forces.resize(steps);
  e->times = e->times.head(steps).eval();
}

void keepTip(Experiment* e) {
  const auto inner = [e](const Channel& channel) { return channel.s < e->cable.length; };
  e->channels.erase(std::remove_if(e->channels.begin(), e->channels.end(), inner),
                    e->channels.end());
}

}  // namespace

std::vector<std::string> blindSuites() {
  std::vector<std::string> names;
  for (const auto& [name, make] : suites()) names.push_back(name);
  return names;
}

namespace {

BlindSet tried(const BlindPlan& plan, CaseOf make, Random random) {
  constexpr double kWrongBy = 1.3;  // at most, what the set says of a stiffness
  BlindSet set;
  set.plan = plan;
  const Case one = make(plan, &random);
  set.label = one.label;
  set.expected = one.expected;
  RigMix mix = mixRigs(one.rigs, one.unseen_torsion, &random);
  for (Experiment& e : mix.seen) {
    shorten(one.steps, &e);
    if (one.tip_only) keepTip(&e);
  }
  const EffectScale scale = effectScale(mix.seen, mix.cable);

  std::vector<Variation> variations;
  std::vector<double> sizes;
  std::vector<EffectChoice> choices;
  std::vector<double> strengths;
  for (const EffectKind* kind : one.kinds) {
    variations.push_back(varied(*kind, scale, one.form, &random));
    Variation& cause = variations.back();
    if (one.fixed_size) cause.first = cause.largest = 1.0;
    const Strength strength = sizeFor(cause, plan.strength, plan.snr, mix.seen, scale);
    if (one.rival) {
      set.separation = separation(cause, strength.size, *one.rival, one.rival_form, plan.snr,
                                  mix.seen, scale, &random);
      // What the data do tell apart may be named.
      if (set.separation > kTold) set.expected.tolerated = {"named"};
    }
    sizes.push_back(strength.size);
    set.reached =
        set.reached == 0.0 ? strength.left.strength : std::min(set.reached, strength.left.strength);
    strengths = strength.left.experiments;
  }
  if (!sizes.empty() && set.reached < kWeak && set.expected.tolerated.empty())
    set.expected.tolerated = {"none", "ambiguous"};
  choices = choicesOf(variations, sizes, scale);
  if (!choices.empty()) mix.seen = withEffects(mix.seen, choices);
  mix.unseen.effects = choices;

  set.correlation = random.chance(0.5) ? random.uniform(0.2, 0.8) : 0.0;
  set.told = random.chance(0.5);
  MeasurementSet seen = newSet("blind", plan.seed, plan.snr);
  seen.truth = mix.cable;
  seen.uncertain = one.uncertain;
  seen.effects = choices;
  seen.EI_guess = mix.cable.EI * random.logUniform(1.0 / kWrongBy, kWrongBy);
  seen.GJ_guess = mix.cable.GJ * random.logUniform(1.0 / kWrongBy, kWrongBy);
  set.seen = set.unseen = seen;
  const std::vector<Record> records = recordsOf(mix.seen), hidden = recordsOf({mix.unseen});
  // Of the same motion's size as where the strength was measured.
  set.seen.experiments =
      sensed(mix.seen, records, noiseOf(mix.seen, records, plan.snr), set, &random);
  set.unseen.experiments =
      sensed({mix.unseen}, hidden, noiseOf({mix.unseen}, hidden, plan.snr), set, &random);
  set.strengths = strengths;
  const double period = 2.0 * std::acos(-1.0) / bendingFrequency(mix.cable);
  if (one.unknown_starts || (!one.known_starts && random.chance(0.25))) {
    for (MeasuredExperiment& e : set.seen.experiments) {
      if (e.experiment.name == "ringdown_small") {
        forgetStart(random.uniform(0.3, 1.0) * period, &e);
      }
    }
  }
  return set;
}

}  // namespace

BlindSet blindSet(const BlindPlan& plan) {
  constexpr int kTries = 5;
  const auto suite = suites().find(plan.suite);
  if (suite == suites().end()) {
    std::string known;
    for (const std::string& name : blindSuites()) known += " " + name;
    throw std::invalid_argument("unknown suite " + plan.suite + "; there are" + known);
  }
  Random random(plan.seed);
  for (int attempt = 1;; ++attempt) {
    // A rig may be impossible: a cable that does not get where it is to be held, say.
    const auto next = static_cast<std::uint64_t>(random.uniform(0.0, 9e15));
    try {
      return tried(plan, suite->second, Random(next));
    } catch (const std::runtime_error&) {
      if (attempt == kTries) throw;
    }
  }
}

}  // namespace cosserat_cable::generator
