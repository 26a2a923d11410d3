// What a diagnosis tells once its fits have ended.
#include <algorithm>
#include <cmath>

#include "advice.h"
#include "chosen_records.h"
#include "cosserat_cable/cable/parameters.h"
#include "cosserat_cable/fit/information.h"
#include "cosserat_cable/input/number_text.h"
#include "diagnosis_work.h"
#include "held_out.h"

namespace cosserat_cable {
namespace {

// A fit without one record begins where that of all ended.
constexpr int kHeldOutIterations = 4;

std::string List(const std::vector<std::string>& names, const std::string& last) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " " + last + " " : ", ") + names[i];
  return text;
}

std::string WordsOf(const std::string& name) {
  const Cause* cause = FindCause(name);
  return cause ? cause->words + " (" + name + ")" : name;
}

/// "nothing (none)", or all of its causes.
std::string WordsOf(const FittedTrial& model) {
  if (model.trials.empty()) return "nothing (none)";
  std::vector<std::string> words;
  for (const std::string& name : model.causes()) words.push_back(WordsOf(name));
  return List(words, "and");
}

/// The noise of all channels of the set's first quantity, rms.
double NoiseFloor(const MeasurementSet& set, const NoiseLevels& levels) {
  const Quantity quantity = set.experiments.front().channels.front().quantity;
  double squares = 0, samples = 0;
  for (std::size_t e = 0; e < set.experiments.size(); ++e)
    for (std::size_t c = 0; c < set.experiments[e].channels.size(); ++c) {
      if (set.experiments[e].channels[c].quantity != quantity) continue;
      const auto n = static_cast<double>(set.experiments[e].record.t.size());
      squares += n * std::pow(levels[e][static_cast<Eigen::Index>(c)], 2);
      samples += n;
    }
  return samples > 0 ? std::sqrt(squares / samples) : 0;
}

/// The last rows of each, as many as `like` has: what was begun with its first samples is judged on
/// the others.
Records EndsOf(const Records& all, const Records& like) {
  Records ends;
  for (std::size_t e = 0; e < like.size(); ++e)
    ends.push_back(all[e].bottomRows(std::min(all[e].rows(), like[e].rows())));
  return ends;
}

}  // namespace

/// What the form of the causes' laws leaves open, as a standard deviation: of a cause's own numbers
/// a part, and of the cable's the same part of what the cause has moved them by.
double DiagnosisWork::SdOfForm(const FittedTrial& model, const std::string& name,
                               double value) const {
  double variance = 0;
  for (const Trial& trial : model.trials) {
    const std::vector<std::string> own = trial.FreePaths();
    const bool is_own = std::count(own.begin(), own.end(), name) > 0;
    const double moved = is_own ? value : value - baseline().point.ValueOf(name);
    if (std::isfinite(moved)) variance += std::pow(FindCause(trial.cause)->form * moved, 2);
  }
  return std::sqrt(variance) / kNormal95;
}

std::map<std::string, FoundParameter> DiagnosisWork::FoundIn(const FittedTrial& model) const {
  std::map<std::string, FoundParameter> found;
  std::vector<std::vector<NoiseColour>> colours;
  for (const Eigen::MatrixXd& left : model.point.residuals) {
    colours.emplace_back();
    for (Eigen::Index c = 0; c < left.cols(); ++c) colours.back().push_back(ColourOf(left.col(c)));
  }
  const Information information =
      InformationOf(model.problem->model(), model.point.jacobian, colours);
  const Determination determination =
      Determine(model.problem->model(), model.point.values, information);
  for (int i = 0; i < static_cast<int>(model.point.unknowns.size()); ++i) {
    const Unknown& u = model.point.unknowns[static_cast<std::size_t>(i)];
    if (u.kind != Unknown::Kind::kCable) continue;
    FoundParameter& one = found[u.name];
    one.value = model.point.values[i];
    one.unit = u.unit;
    one.reason = determination.reasons[static_cast<std::size_t>(i)];
    if (!one.reason.empty()) continue;
    const double of_noise = std::sqrt(std::max(0.0, determination.covariance(i, i))) * u.scale;
    one.sd = std::hypot(of_noise, SdOfForm(model, u.name, one.value));
  }
  return found;
}

Records DiagnosisWork::HeldOut(const FittedTrial& of) const {
  FitProblemOptions options = ProblemOptions();
  options.stop = [this] { return Stopping() || Seconds() > options_.time_budget; };
  options.max_iterations = kHeldOutIterations;
  options.held = of.Held();
  if (set_.experiments.size() == whole_.experiments.size())
    return ExactHeldOut({of.set, of.point, *of.problem}, options);
  options.held.clear();
  options.noise.clear();
  return PredictOthers(WithTrials(whole_, of.trials), ChosenRecords(whole_), of.point, options);
}

/// The whole set with what was found in a part of it.
MeasurementSet DiagnosisWork::Filled(const FittedTrial& of) const {
  const MeasurementSet part = of.problem->unknowns().FilledSet(of.point.values);
  MeasurementSet filled = whole_;
  filled.cable = part.cable;
  for (Experiment& experiment : filled.experiments)
    for (const Experiment& fitted : part.experiments)
      if (fitted.name == experiment.name) experiment = fitted;
  return filled;
}

void DiagnosisWork::ReportCandidates(const Judgement& judgement) {
  const Adequacy plain = AdequacyOf(baseline().point, seen_noise_);
  const Records best_heldout = LinearisedHeldOut(model(judgement.best).point);
  // Of a large set, the plain model has predicted records that candidates have not.
  const bool all_fitted = set_.experiments.size() == whole_.experiments.size();
  const Records plain_heldout = all_fitted ? plain_heldout_ : LinearisedHeldOut(baseline().point);
  for (int i = 1; i < static_cast<int>(models_.size()); ++i) {
    const FittedTrial& of = model(i);
    Candidate candidate;
    candidate.causes = of.causes();
    candidate.fitted = true;
    const Adequacy adequacy = AdequacyOf(of.point, seen_noise_);
    candidate.chi2 = adequacy.chi2;
    candidate.samples = of.point.samples;
    candidate.log_likelihood = LikelihoodOf(of.point).log_likelihood;
    candidate.parameters = of.parameters();
    candidate.adequate = adequacy.adequate;
    if (plain.excess() > 0)
      candidate.share = std::clamp((plain.chi2 - adequacy.chi2) / plain.excess(), -1.0, 1.0);
    if (candidate.causes.size() == 1 && plain.excess() > 0)
      candidate.promise = std::min(1.0, promises_[candidate.causes.front()] / plain.excess());
    const Difference worse = DifferenceBetween(i, judgement.best);
    candidate.worse = worse.value;
    candidate.worse_se = worse.se;
    const Records own = LinearisedHeldOut(of.point);
    const Difference heldout = DifferenceOf(own, best_heldout, correlations_);
    candidate.heldout = heldout.value;
    candidate.heldout_se = heldout.se;
    if (const auto gain = GainOf(plain_heldout, EndsOf(own, plain_heldout)))
      candidate.gain = gain->value;
    candidate.rejected = judgement.rejected[static_cast<std::size_t>(i)];
    candidate.found = FoundIn(of);
    diagnosis_.candidates.push_back(std::move(candidate));
  }
  std::stable_sort(diagnosis_.candidates.begin(), diagnosis_.candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.chi2 < b.chi2; });
  for (const Cause& cause : Causes()) {
    const bool fitted = std::any_of(
        diagnosis_.candidates.begin(), diagnosis_.candidates.end(),
        [&](const Candidate& one) { return one.causes == std::vector<std::string>{cause.name}; });
    if (fitted) continue;
    Candidate candidate;
    candidate.causes = {cause.name};
    const auto promise = promises_.find(cause.name);
    if (promise != promises_.end() && plain.excess() > 0)
      candidate.promise = std::min(1.0, promise->second / plain.excess());
    candidate.rejected =
        failures_.count(cause.name) ? "it cannot be simulated: " + failures_.at(cause.name)
        : promise == promises_.end()
            ? "no record of this set shows it, or nothing of this kind can be simulated here"
        : OutOfTime() && !tried_.count(cause.name)
            ? "not fitted: the time budget was spent"
            : "not fitted: to first order it explains " +
                  FormatRounded(100 * candidate.promise, 2) + " % of the misfit";
    diagnosis_.candidates.push_back(std::move(candidate));
  }
}

void DiagnosisWork::ReportGain(const Judgement& judgement) {
  const Records& plain = plain_heldout_;
  double squares = 0, samples = 0;
  for (const Eigen::MatrixXd& one : plain) {
    squares += one.squaredNorm();
    samples += static_cast<double>(one.size());
  }
  if (samples > 0) diagnosis_.rms_baseline = std::sqrt(squares / samples) * diagnosis_.noise_floor;
  if (judgement.best != 0 && diagnosis_.verdict == Verdict::kNamed) {
    diagnosis_.gain = GainOf(plain, HeldOut(model(judgement.best)));
    if (diagnosis_.gain) {
      diagnosis_.gain->rms_baseline *= diagnosis_.noise_floor;
      diagnosis_.gain->rms_extended *= diagnosis_.noise_floor;
    }
  }
  Charge("held-out records");
}

void DiagnosisWork::ReportRecords(const Judgement& judgement) {
  for (std::size_t e = 0; e < set_.experiments.size(); ++e) {
    const Experiment& experiment = set_.experiments[e];
    RecordView view;
    view.experiment = experiment.name;
    view.t = experiment.record.t;
    for (const Channel& channel : experiment.channels) view.columns.push_back(channel.column);
    view.measured = experiment.record.values;
    view.baseline = baseline().point.simulated[e];
    if (judgement.best != 0) view.extended = model(judgement.best).point.simulated[e];
    view.noise = seen_noise_.levels[e];
    diagnosis_.records.push_back(std::move(view));
  }
}

void DiagnosisWork::Advise(const Judgement& judgement) {
  if (!options_.advise || judgement.verdict != Verdict::kAmbiguous || !Tell("advice", 0.9)) return;
  std::vector<const FittedTrial*> rivals;
  for (const int r : judgement.rivals) rivals.push_back(&model(r));
  diagnosis_.next_experiment = NextExperiment(set_, noise_.levels, scales_, model(judgement.best),
                                              rivals, [this] { return Stopping(); });
  Charge("advice");
}

void DiagnosisWork::Say(const Judgement& judgement) {
  const std::string left = "The recalibrated plain model leaves " +
                           FormatRounded(diagnosis_.baseline_times_noise, 3) + " times the noise";
  std::string& sentence = diagnosis_.sentence;
  const bool untried = std::any_of(
      diagnosis_.candidates.begin(), diagnosis_.candidates.end(), [](const Candidate& one) {
        return !one.fitted && one.rejected.find("time budget") != std::string::npos;
      });
  if (untried)
    diagnosis_.warnings.push_back(
        "the time budget was spent before all causes were tried: --time-budget gives more");
  switch (diagnosis_.verdict) {
    case Verdict::kNone:
      sentence = left + ": nothing is missing that these records show.";
      break;
    case Verdict::kNamed:
      sentence = left + "; with " + WordsOf(model(judgement.best)) + " it leaves " +
                 FormatRounded(diagnosis_.extended_times_noise, 3) + " times the noise.";
      break;
    case Verdict::kAmbiguous: {
      std::vector<std::string> answers = {WordsOf(model(judgement.best))};
      for (const int r : judgement.rivals) answers.push_back(WordsOf(model(r)));
      sentence = left +
                 ". The records cannot tell which of these is at work: " + List(answers, "or") +
                 ".";
      break;
    }
    case Verdict::kUnexplained:
      sentence = left + (untried ? ", and the time budget was spent before all causes were tried"
                         : diagnosis_.interrupted
                             ? ", and the work was interrupted before all causes were tried"
                             : ", and no cause of the library accounts for it");
      if (judgement.best != 0)
        sentence += ": the best, " + List(model(judgement.best).causes(), "and") + ", leaves " +
                    FormatRounded(diagnosis_.extended_times_noise, 3) + " times the noise";
      sentence += ".";
      break;
  }
}

Diagnosis DiagnosisWork::Report() {
  Judgement judgement = Judged();
  if (!noise_.known && judgement.verdict == Verdict::kUnexplained) {
    // Without a level of its own, what is left may be the noise.
    judgement.verdict = Verdict::kAmbiguous;
    if (judgement.best != 0) judgement.rivals = {0};
  }
  diagnosis_.ok = true;
  diagnosis_.interrupted = Stopping();
  if (diagnosis_.interrupted)
    diagnosis_.warnings.push_back(
        "interrupted: the verdict is on the causes that were tried until then");
  diagnosis_.verdict = judgement.verdict;
  diagnosis_.noise_known = noise_.known;
  diagnosis_.noise_floor = NoiseFloor(set_, seen_noise_.levels);
  const FittedTrial& best = model(judgement.best);
  const auto times = [this](const FittedTrial& of) {
    return std::sqrt(AdequacyOf(of.point, seen_noise_).chi2 / std::max(1.0, of.point.samples));
  };
  diagnosis_.baseline_times_noise = times(baseline());
  const Likelihood likelihood = LikelihoodOf(baseline().point);
  diagnosis_.baseline_log_likelihood = likelihood.log_likelihood;
  diagnosis_.baseline_freedom = likelihood.freedom;
  diagnosis_.extended_times_noise = times(best);
  diagnosis_.baseline = FoundIn(baseline());
  if (judgement.verdict == Verdict::kNamed || judgement.verdict == Verdict::kAmbiguous)
    diagnosis_.causes = judgement.best == 0 ? std::vector<std::string>{"none"} : best.causes();
  diagnosis_.baseline_cable = baseline().problem->unknowns().FilledKeys(baseline().point.values);
  diagnosis_.has_extended = judgement.best != 0 && (judgement.verdict == Verdict::kNamed ||
                                                    judgement.verdict == Verdict::kAmbiguous);
  if (diagnosis_.has_extended) {
    diagnosis_.extended_causes = best.causes();
    diagnosis_.extended = FoundIn(best);
    diagnosis_.extended_set = Filled(best);
  }
  for (const int r : judgement.rivals)
    for (const std::string& name : r == 0 ? std::vector<std::string>{"none"} : model(r).causes())
      if (!std::count(diagnosis_.causes.begin(), diagnosis_.causes.end(), name))
        diagnosis_.causes.push_back(name);
  if (!noise_.known)
    diagnosis_.warnings.push_back(
        "the noise of a channel is not known and cannot be told from its record: give its sigma; "
        "until then nothing can be called unexplained");
  if (set_.experiments.size() == 1)
    diagnosis_.warnings.push_back(
        "the set has one experiment: its last part was predicted from its first, which shows less "
        "than a record of its own would");
  if (!Stopping()) plain_heldout_ = HeldOut(baseline());
  ReportCandidates(judgement);
  if (!Stopping()) ReportGain(judgement);
  ReportRecords(judgement);
  Advise(judgement);
  Say(judgement);
  if (!diagnosis_.interrupted && !OutOfTime()) memory_.Forget();
  diagnosis_.seconds = Seconds();
  return diagnosis_;
}

}  // namespace cosserat_cable
