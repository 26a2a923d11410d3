#include "diagnosis_work.h"

#include <algorithm>
#include <cmath>

#include "chosen_records.h"
#include "cosserat_cable/input/number_text.h"
#include "held_out.h"
#include "trial_obstacles.h"

namespace cosserat_cable {
namespace {

// Iterations of a candidate's fit; and of one that had not ended by then.
constexpr int kIterations = 8, kMoreIterations = 20;
// Of the best's sum of squares: what a rival may leave beyond, to be one.
constexpr double kAsGood = 0.5;
// Of the noise's sum of squares: too little for a cause.
constexpr double kNothing = 0.02;
// A noise level that the baseline shows to be this part smaller than the record alone did.
constexpr double kNoiseSettled = 0.03;
// How many of the best models are simulated more finely; and the misfit, in times the noise's
// variance, that takes no precision to see.
constexpr int kRefined = 3;
// Rounds of ever finer steps, as long as they move what is fitted.
constexpr int kSharper = 4;
constexpr double kMuchLeft = 36;
// Times the noise.
constexpr double kFar = 30;
// Unknowns of single records, their starts above all, that cost little to be fitted everywhere.
constexpr std::size_t kFewOfRecords = 30;
// A factor that the plain model has changed a stiffness by, from which a cause may not find back.
constexpr double kRanAway = 3;
// The part of the best promise, or of the misfit, for which a better place of an obstacle is looked
// for; how often after a fit, by which steps, and what another turn must leave at most.
constexpr double kPromisingObstacle = 0.5, kNearerSteps = 0.25, kGainOfTurn = 0.9;
constexpr int kObstacleTurns = 4;
const char* const kPlain = "plain";

/// Of trials with all that they begin with.
std::string NameOf(const std::vector<Trial>& trials) {
  if (trials.empty()) return kPlain;
  std::string name;
  for (const Trial& trial : trials) {
    name += (name.empty() ? "" : " and ") + trial.cause;
    for (const std::string& channel : trial.channels) name += " " + channel;
    for (const auto& [path, value] : trial.Values()) name += " " + path + "=" + FormatNumber(value);
  }
  return name;
}

/// Of a component, whatever its size.
std::string NameOf(const Trial& trial, const TrialComponent& component) {
  std::string name = trial.cause;
  for (const std::string& channel : trial.channels) name += " " + channel;
  for (const HypothesisNumber& number : component.numbers)
    name += " " + number.path + "=" + FormatNumber(number.times);
  return name;
}

}  // namespace

std::vector<std::string> FittedTrial::causes() const { return CausesOf(trials); }

int FittedTrial::parameters() const {
  int count = 0;
  for (const Trial& trial : trials) count += static_cast<int>(trial.FreePaths().size());
  return count;
}

bool FittedTrial::IsFar() const { return point.cost > kFar * kFar * std::max(1.0, point.samples); }

std::vector<std::string> FittedTrial::Held() const {
  std::vector<std::string> names;
  for (const Unknown& u : point.unknowns)
    if (IsFar() && u.experiment >= 0) names.push_back(u.name);
  if (names.size() <= kFewOfRecords) names.clear();
  return names;
}

bool FittedTrial::IsFaint() const {
  return std::any_of(trials.begin(), trials.end(), [&](const Trial& trial) {
    return trial.IsFaint([&](const std::string& path) { return point.ValueOf(path); });
  });
}

DiagnosisWork::DiagnosisWork(const MeasurementSet& set, const DiagnosisOptions& options)
    : whole_(set),
      set_(OfRecords(set, ChosenRecords(set))),
      options_(options),
      memory_(options.memory, set),
      noise_(NoiseOf(set_)) {
  if (set_.experiments.size() < set.experiments.size())
    diagnosis_.warnings.push_back("the set is large: " + std::to_string(set_.experiments.size()) +
                                  " of its " + std::to_string(set.experiments.size()) +
                                  " records were fitted, the others tell what is gained");
  if (memory_.begun_with() > 0)
    diagnosis_.warnings.push_back("an earlier diagnosis of this set was interrupted: " +
                                  std::to_string(memory_.begun_with()) +
                                  " of its fits were taken over");
}

bool DiagnosisWork::Stopping() const { return stopped_ || (options_.stop && options_.stop()); }

bool DiagnosisWork::Tell(const std::string& what, double part) {
  farthest_ = std::max(farthest_, part);
  if (options_.progress && !options_.progress(what, farthest_)) stopped_ = true;
  return !Stopping();
}

void DiagnosisWork::Charge(const std::string& stage, const SimulationCount& count) {
  const Clock::time_point now = Clock::now();
  auto& stages = diagnosis_.stages;
  auto place = std::find_if(stages.begin(), stages.end(),
                            [&](const DiagnosisStage& one) { return one.name == stage; });
  if (place == stages.end()) place = stages.insert(place, {stage, 0, {}});
  place->seconds += std::chrono::duration<double>(now - charged_at_).count();
  place->count += count;
  charged_at_ = now;
}

FitProblemOptions DiagnosisWork::ProblemOptions() const {
  FitProblemOptions options;
  options.unknowns.end_damping = false;
  options.noise = noise_.levels;
  options.stop = [this] { return Stopping() || OutOfTime(); };
  return options;
}

bool DiagnosisWork::FitBaseline(Problems* problems) {
  auto plain = std::make_unique<FittedTrial>();
  plain->set = set_;
  FitProblemOptions options = ProblemOptions();
  options.progress = [this](const std::string& what) { return Tell("plain model: " + what, 0.05); };
  plain->problem = std::make_unique<FitProblem>(set_, options, problems);
  if (!problems->empty()) return false;
  if (plain->problem->unknowns().size() == 0) {
    diagnosis_.message = "the set names nothing to be identified";
    return false;
  }
  if (const FitMemory::Fit* known = memory_.Find(kPlain)) {
    const FitPoint there = plain->problem->At(plain->problem->StartFrom({}, known->values));
    if (there.ok) plain->problem->Refine(there);
    if (there.ok) plain->point = plain->problem->FitFrom(there);
  }
  if (!plain->point.ok && !plain->point.interrupted) {
    plain->point = plain->problem->FitFromAfar();
    if (plain->point.ok && !plain->point.interrupted) memory_.Add(kPlain, plain->point);
  }
  Charge("baseline", plain->problem->count());
  if (!plain->point.ok) {
    diagnosis_.interrupted = Stopping();
    diagnosis_.message = "the plain model could not be fitted: " + plain->point.message;
    return false;
  }
  // What the model explains no longer hides the noise.
  const SetNoise better = NoiseOf(set_, plain->point.simulated);
  bool changed = false;
  for (std::size_t e = 0; e < better.levels.size(); ++e)
    changed = changed || ((noise_.levels[e] - better.levels[e]).array().abs() >
                          kNoiseSettled * noise_.levels[e].array())
                             .any();
  noise_ = better;
  if (changed) {
    options.noise = noise_.levels;
    auto again = std::make_unique<FitProblem>(set_, options, problems);
    again->ShareSteps(*plain->problem);
    FitPoint point = again->FitFrom(plain->point);
    if (point.ok) {
      plain->problem = std::move(again);
      plain->point = std::move(point);
    }
  }
  // As finely as any cause: what its steps are wrong by would be some cause's merit.
  RefineOne(plain.get());
  scales_ = FindMotionScales(*plain->problem, plain->point);
  models_.push_back(std::move(plain));
  LookAtTheBest();
  Charge("baseline");
  return true;
}

std::vector<Screened> DiagnosisWork::ScreenAround(const FittedTrial& base,
                                                  const std::string& stage) {
  if (!Tell("screening the causes", 0.2)) return {};
  std::vector<Trial> trials = AllTrials(set_, scales_);
  const bool whole = base.trials.empty() && !AdequacyOf(base.point, seen_noise_).adequate;
  const std::vector<Trial> obstacles = TrialObstacles(*base.problem, base.point, whole);
  trials.insert(trials.end(), obstacles.begin(), obstacles.end());
  const auto cannot_be_beside = [&](const Trial& trial) {
    return !std::all_of(base.trials.begin(), base.trials.end(),
                        [&](const Trial& there) { return trial.CanBeBeside(there); });
  };
  trials.erase(std::remove_if(trials.begin(), trials.end(), cannot_be_beside), trials.end());
  const SimulationCount before = base.problem->count();
  for (Trial& trial : trials)
    for (TrialComponent& component : trial.components)
      if (const auto size = sizes_.find(NameOf(trial, component)); size != sizes_.end())
        component.size = size->second;
  std::map<std::string, std::string> failures;
  std::vector<Screened> screened = Screen(*base.problem, base.point, std::move(trials), &failures);
  LookAroundTheBestObstacle(base, &screened);
  for (const Screened& one : screened)
    for (const TrialComponent& component : one.trial.components)
      sizes_[NameOf(one.trial, component)] = component.size;
  if (base.trials.empty()) {
    for (const Screened& one : screened) {
      promises_[one.trial.cause] = std::max(promises_[one.trial.cause], one.drop);
      failures.erase(one.trial.cause);
    }
    failures_ = failures;
  }
  Charge(stage, base.problem->count() - before);
  return screened;
}

/// A whole obstacle that promises most leads to a better one near it, before any fit begins there.
void DiagnosisWork::LookAroundTheBestObstacle(const FittedTrial& base,
                                              std::vector<Screened>* screened) const {
  const auto best = std::find_if(screened->begin(), screened->end(),
                                 [](const Screened& one) { return one.trial.cause == "contact"; });
  if (best == screened->end() || best->trial.components.front().grows()) return;
  if (best->drop < kPromisingObstacle * screened->front().drop) return;
  *best = BestObstacleNear(*base.problem, base.point, *best, 1, scales_.length);
  std::stable_sort(screened->begin(), screened->end(),
                   [](const Screened& a, const Screened& b) { return a.drop > b.drop; });
}

/// What follows an impact is too rough for derivatives alone: fits and searches for a better place
/// take turns, as long as they gain.
void DiagnosisWork::FitObstacleInTurns(const FittedTrial& from,
                                       std::unique_ptr<FittedTrial>* fitted) {
  const Trial& trial = (*fitted)->trials.back();
  if (trial.cause != "contact" || trial.components.front().grows()) return;
  FitProblem& plain = *from.problem;
  for (int turn = 0; turn < kObstacleTurns; ++turn) {
    FittedTrial& now = **fitted;
    if (ShareOf(now) < kPromisingObstacle || AdequacyOf(now.point, seen_noise_).adequate) return;
    const FitPoint there = plain.At(plain.StartFrom(now.point, {}));
    if (!there.ok || OutOfTime()) return;
    Screened start;
    start.trial = now.trials.back();
    for (HypothesisNumber& number : start.trial.components.front().numbers)
      if (const double value = now.point.ValueOf(number.path); std::isfinite(value))
        number.times = value;
    const Screened near = BestObstacleNear(plain, there, start, kNearerSteps, scales_.length);
    std::vector<Trial> trials = now.trials;
    trials.back() = near.trial;
    const std::map<std::string, double> place = near.trial.Values();
    std::unique_ptr<FittedTrial> next = FitOne(trials, now, place);
    if (!next || !next->point.ok || next->point.interrupted ||
        !(next->point.cost < kGainOfTurn * now.point.cost))
      return;
    *fitted = std::move(next);
  }
}

/// What a rival of a cause that leaves just noise must come near to.
double DiagnosisWork::Aim() const {
  double least = 0;
  for (const auto& model : models_)
    if (!model->trials.empty() && AdequacyOf(model->point, seen_noise_).adequate)
      least = least > 0 ? std::min(least, model->point.cost) : model->point.cost;
  return least > 0 ? std::max(least, models_.front()->point.samples) * (1 + kAsGood) : 0;
}

std::unique_ptr<FittedTrial> DiagnosisWork::FitOne(const std::vector<Trial>& trials,
                                                   const FittedTrial& from, const Also& also) {
  auto fitted = std::make_unique<FittedTrial>();
  fitted->trials = trials;
  fitted->set = WithTrials(set_, trials);
  FitProblemOptions options = ProblemOptions();
  options.max_iterations = kIterations;
  options.aim = Aim();
  options.quick = true;
  options.progress = [this](const std::string&) { return !Stopping(); };
  options.held = from.Held();
  fitted->held = !options.held.empty();
  Problems problems;
  fitted->problem = std::make_unique<FitProblem>(fitted->set, options, &problems);
  if (!problems.empty()) return nullptr;
  fitted->problem->ShareSteps(*from.problem);
  const std::string key = "from " + NameOf(from.trials) + (also.empty() ? "" : " and the set") +
                          " to " + NameOf(trials);
  if (const FitMemory::Fit* known = memory_.Find(key)) {
    fitted->point = fitted->problem->At(fitted->problem->StartFrom({}, known->values));
    fitted->point.at_minimum = known->at_minimum;
  } else {
    fitted->point = fitted->problem->FitFrom(from.point, also);
    if (fitted->point.ok && !fitted->point.interrupted) memory_.Add(key, fitted->point);
  }
  return fitted;
}

/// A simpler model that has run away, to where nothing moves the records, say, is no place to begin
/// from: then the set's own values are tried as well.
std::unique_ptr<FittedTrial> DiagnosisWork::FitOneOrFromTheSet(const std::vector<Trial>& trials,
                                                               const FittedTrial& from) {
  std::unique_ptr<FittedTrial> fitted = FitOne(trials, from);
  if (!fitted || fitted->point.interrupted || from.IsFar()) return fitted;
  if (fitted->point.ok && AdequacyOf(fitted->point, seen_noise_).adequate) return fitted;
  Also also;
  for (std::size_t i = 0; i < from.point.unknowns.size(); ++i) {
    const Unknown& u = from.point.unknowns[i];
    if (u.kind != Unknown::Kind::kCable || u.damping || !u.start_known || !(u.start > 0)) continue;
    const double ratio = from.point.values[static_cast<Eigen::Index>(i)] / u.start;
    if (!(ratio < kRanAway && ratio > 1 / kRanAway)) also[u.name] = u.start;
  }
  if (also.empty() || OutOfTime()) return fitted;
  std::unique_ptr<FittedTrial> other = FitOne(trials, from, also);
  if (!other || !other->point.ok || other->point.interrupted) return fitted;
  return fitted->point.ok && fitted->point.cost <= other->point.cost ? std::move(fitted)
                                                                     : std::move(other);
}

/// Whether one of the causes leaves nothing but noise.
bool DiagnosisWork::IsExplained() const {
  return std::any_of(models_.begin() + 1, models_.end(),
                     [&](const auto& one) { return AdequacyOf(one->point, seen_noise_).adequate; });
}

/// Whether a cause, beside others, leaves nothing but noise already: no other start does better.
bool DiagnosisWork::IsExplained(const std::string& name, const FittedTrial& beside) const {
  std::vector<Trial> trials = beside.trials;
  trials.emplace_back().cause = name;
  const std::vector<std::string> causes = CausesOf(trials);
  return std::any_of(models_.begin(), models_.end(), [&](const auto& one) {
    return one->causes() == causes && AdequacyOf(one->point, seen_noise_).adequate;
  });
}

bool DiagnosisWork::Keep(std::unique_ptr<FittedTrial> model) {
  const std::vector<std::string> causes = model->causes();
  for (auto& one : models_) {
    if (one->causes() != causes) continue;
    // Several hypotheses of a cause together must be worth their more numbers.
    const int more = model->parameters() - one->parameters();
    const bool better = model->point.cost + kChance * more < one->point.cost;
    if (better) one = std::move(model);
    return better;
  }
  models_.push_back(std::move(model));
  return true;
}

bool DiagnosisWork::HasEnded(const FittedTrial& model) const {
  return model.point.at_minimum && !(model.held && model.Held().empty());
}

/// To its end.
void DiagnosisWork::GoOn(FittedTrial* model) {
  if (OutOfTime() || !Tell("going on with " + model->causes().front(), 0)) return;
  const SimulationCount before = model->problem->count();
  model->problem->SetMaxIterations(kMoreIterations);
  model->problem->SetAim(Aim());
  const std::vector<std::string> held = model->Held();
  model->held = !held.empty();
  if (!model->held) model->problem->SetHeld({});
  FitPoint point = model->problem->FitFrom(model->point);
  Charge("candidates", model->problem->count() - before);
  if (point.ok && !point.interrupted) model->point = std::move(point);
}

/// What explains nearly all is worth its end at once: the others may be spared then.
void DiagnosisWork::Finish(FittedTrial* model) {
  if (ShareOf(*model) < kNearlyAll) return;
  if (!HasEnded(*model)) GoOn(model);
  if (!IsExplained() && !OutOfTime()) RefineOne(model);
}

void DiagnosisWork::RefineOne(FittedTrial* model) {
  if (model->refined || model->point.cost > kMuchLeft * model->point.samples) return;
  model->refined = true;
  const SimulationCount before = model->problem->count();
  model->problem->SetMaxIterations(kMoreIterations);
  for (int round = 0; round < kSharper; ++round) {
    model->problem->Refine(model->point);
    FitPoint point = model->problem->FitFrom(model->point);
    if (!point.ok || point.interrupted) break;
    model->point = std::move(point);
    if (OutOfTime() || !model->problem->Sharpen(model->point)) break;
  }
  Charge("finer steps", model->problem->count() - before);
}

void DiagnosisWork::FinishAnswer() {
  const int best = Judged().best;
  if (best == 0) return;
  const std::shared_ptr<FittedTrial> answer = models_[static_cast<std::size_t>(best)];
  if (!HasEnded(*answer)) GoOn(answer.get());
  if (!OutOfTime()) RefineOne(answer.get());
  LookAtTheBest();
}

void DiagnosisWork::RefineBest() {
  std::vector<FittedTrial*> order;
  for (auto& model : models_) order.push_back(model.get());
  std::sort(order.begin(), order.end(), [](const FittedTrial* a, const FittedTrial* b) {
    return a->point.cost < b->point.cost;
  });
  int refined = 0;
  for (FittedTrial* model : order) {
    if (refined++ == kRefined || OutOfTime() || !Tell("finer steps", 0.75)) break;
    RefineOne(model);
  }
  LookAtTheBest();
}

/// Of what the best model leaves, which is nearest to noise: how far it is correlated, and how
/// large the noise is that it no longer hides.
void DiagnosisWork::LookAtTheBest() {
  const auto best =
      std::min_element(models_.begin(), models_.end(),
                       [](const auto& a, const auto& b) { return a->point.cost < b->point.cost; });
  correlations_ = CorrelationsOf((*best)->point);
  seen_noise_ = NoiseOf(set_, (*best)->point.simulated);
}

Difference DiagnosisWork::DifferenceBetween(int worse, int better) const {
  return DifferenceOf(model(worse).point.residuals, model(better).point.residuals, correlations_);
}

bool DiagnosisWork::LeavesNothing(int i) const {
  const Adequacy adequacy = AdequacyOf(model(i).point, seen_noise_);
  return adequacy.excess() < std::max(kNothing * adequacy.expected, 2 * adequacy.sd);
}

double DiagnosisWork::ShareOf(const FittedTrial& model) const {
  const Adequacy plain = AdequacyOf(models_.front()->point, seen_noise_);
  return (plain.chi2 - AdequacyOf(model.point, seen_noise_).chi2) / std::max(plain.excess(), 1.0);
}

double DiagnosisWork::ShareOfBest() const {
  double share = 0;
  for (const auto& model : models_) share = std::max(share, ShareOf(*model));
  return share;
}

Judgement DiagnosisWork::Judged() const {
  std::vector<Contender> contenders;
  for (const auto& model : models_)
    contenders.push_back({model->causes(), model->parameters(),
                          AdequacyOf(model->point, seen_noise_), model->IsFaint()});
  std::map<int, Records> predicted;
  const auto predictions = [&](int i) -> const Records& {
    if (!predicted.count(i)) predicted[i] = LinearisedHeldOut(model(i).point);
    return predicted[i];
  };
  return Judge(
      contenders, [this](int worse, int better) { return DifferenceBetween(worse, better); },
      [&](int worse, int better) {
        return DifferenceOf(predictions(worse), predictions(better), correlations_);
      });
}

Diagnosis DiagnosisWork::Failed() {
  diagnosis_.seconds = Seconds();
  return diagnosis_;
}

}  // namespace cosserat_cable
