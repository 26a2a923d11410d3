// Which causes of a diagnosis are fitted, alone and together, and in which order.
#include <algorithm>
#include <map>

#include "diagnosis_work.h"

namespace cosserat_cable {
namespace {

// Part of a cause's best promise above which another start of it is fitted too, and how many; and
// another cause in its place beside others.
constexpr double kAsPromising = 0.6;
constexpr int kStarts = 2;
// Of what the best single cause promises to leave, what a pair may leave that is fitted before
// other single ones; and how many pairs.
constexpr double kPairLeaves = 0.5;
constexpr std::size_t kPromisingPairs = 3;
// The part of the misfit that a rival of a cause that leaves just noise must promise.
constexpr double kRivalPromise = 0.03;
// How many of the best fits go on to their ends; and what is too far from the aim, in parts of it.
constexpr int kContinued = 3;
constexpr double kFarFromAim = 3;

/// The numbers of a simpler cause among those of a trial.
Trial PartOf(const Trial& larger, const std::string& simpler) {
  const std::string own = "extensions." + simpler + ".";
  Trial part;
  part.cause = simpler;
  for (const TrialComponent& component : larger.components) {
    TrialComponent kept = component;
    kept.numbers.erase(std::remove_if(kept.numbers.begin(), kept.numbers.end(),
                                      [&](const HypothesisNumber& number) {
                                        return number.path.rfind(own, 0) != 0;
                                      }),
                       kept.numbers.end());
    if (!kept.numbers.empty()) part.components.push_back(kept);
  }
  return part;
}

}  // namespace

void DiagnosisWork::FitCandidates(const std::vector<Screened>& screened, int beside, int most,
                                  double part) {
  // A better one of its causes may take its place meanwhile.
  const std::shared_ptr<const FittedTrial> from = models_[static_cast<std::size_t>(beside)];
  const bool alone = from->trials.empty();
  const std::string stage = alone ? "candidates" : "pairs";
  std::vector<std::string> order;
  std::map<std::string, std::vector<const Screened*>> by_cause;
  for (const Screened& one : screened) {
    if (one.drop < kChance) continue;
    std::vector<const Screened*>& of = by_cause[one.trial.cause];
    if (of.empty()) order.push_back(one.trial.cause);
    const std::size_t starts = alone ? kStarts : 1;
    if (of.size() < starts && (of.empty() || one.drop > kAsPromising * of.front()->drop))
      of.push_back(&one);
  }
  // What another one contains is held against it.
  std::vector<std::string> chosen(
      order.begin(),
      order.begin() + std::min<std::ptrdiff_t>(most, static_cast<std::ptrdiff_t>(order.size())));
  for (const std::string& name : std::vector<std::string>(chosen))
    for (const std::string& simpler : FindCause(name)->contains)
      if (by_cause.count(simpler) > 0 &&
          std::find(chosen.begin(), chosen.end(), simpler) == chosen.end())
        chosen.push_back(simpler);
  // So is what such a score says nothing of.
  for (const std::string& name : order)
    if (alone && FindCause(name)->acts_by_square &&
        std::find(chosen.begin(), chosen.end(), name) == chosen.end())
      chosen.push_back(name);
  double done = 0;
  for (const std::string& name : chosen) {
    if (alone && !tried_.insert(name).second) continue;
    const bool explained = IsExplained();
    for (const Screened* one : by_cause[name]) {
      if (one != by_cause[name].front() && (explained || IsExplained(name, *from))) break;
      const bool promises_little = one->drop < kRivalPromise * from->point.cost;
      if (explained && promises_little && !(alone && FindCause(name)->acts_by_square)) break;
      if (OutOfTime() || !Tell((alone ? "trying " : "together with ") + name,
                               part + 0.3 * done / static_cast<double>(chosen.size())))
        return;
      std::vector<Trial> trials = from->trials;
      trials.push_back(one->trial);
      std::unique_ptr<FittedTrial> fitted = FitOneOrFromTheSet(trials, *from);
      if (!fitted) continue;
      if (fitted->point.ok && !fitted->point.interrupted) FitObstacleInTurns(*from, &fitted);
      Charge(stage, fitted->problem->count());
      if (fitted->point.ok && !fitted->point.interrupted) {
        FittedTrial* model = fitted.get();
        if (Keep(std::move(fitted))) Finish(model);
      } else if (alone) {
        failures_[name] = fitted->point.message;
      }
    }
    ++done;
  }
  LookAtTheBest();
}

void DiagnosisWork::FitPromisingPairs(const std::vector<Screened>& screened, double part) {
  const double misfit = AdequacyOf(baseline().point, seen_noise_).excess();
  if (screened.empty() || ShareOfBest() > kNearlyAll) return;
  const std::vector<ScreenedPair> pairs = ScreenPairs(screened);
  const double left_by_one = misfit - screened.front().drop;
  for (std::size_t k = 0; k < std::min(pairs.size(), kPromisingPairs); ++k) {
    if (misfit - pairs[k].drop > kPairLeaves * left_by_one || IsExplained()) break;
    // The best of very many pairs explains some of the noise, too.
    if (pairs[k].drop < screened.front().drop + 2 * kChance) break;
    const std::vector<Trial> trials = {screened[pairs[k].first].trial,
                                       screened[pairs[k].second].trial};
    if (OutOfTime() || !Tell("trying " + trials[0].cause + " and " + trials[1].cause, part)) return;
    std::unique_ptr<FittedTrial> fitted = FitOne(trials, baseline());
    if (!fitted) continue;
    Charge("pairs", fitted->problem->count());
    if (!fitted->point.ok || fitted->point.interrupted) continue;
    FittedTrial* model = fitted.get();
    if (Keep(std::move(fitted))) Finish(model);
  }
  LookAtTheBest();
}

/// The fits that promise to come nearest go on to their ends.
void DiagnosisWork::Continue(double part) {
  std::vector<FittedTrial*> open;
  const double aim = Aim();
  for (auto& model : models_) {
    const bool is_far = aim > 0 && model->point.cost > kFarFromAim * aim;
    if (!model->trials.empty() && !HasEnded(*model) && !is_far) open.push_back(model.get());
  }
  std::sort(open.begin(), open.end(), [](const FittedTrial* a, const FittedTrial* b) {
    return a->point.cost < b->point.cost;
  });
  if (open.size() > kContinued) open.resize(kContinued);
  if (!Tell("going on with the best", part)) return;
  for (FittedTrial* model : open) GoOn(model);
  LookAtTheBest();
}

void DiagnosisWork::FitFromSimpler() {
  for (const Cause& cause : Causes()) {
    if (cause.from_simpler.empty() || IsExplained(cause.name, baseline())) continue;
    if (begun_from_simpler_.count(cause.name) > 0) continue;
    const auto simpler = std::find_if(models_.begin(), models_.end(), [&](const auto& one) {
      return one->causes() == std::vector<std::string>{cause.contains.front()};
    });
    if (simpler == models_.end() || AdequacyOf((*simpler)->point, seen_noise_).adequate) continue;
    if (OutOfTime() || !Tell("beyond " + cause.contains.front() + ": " + cause.name, 0.55)) return;
    begun_from_simpler_.insert(cause.name);
    const FittedTrial& from = **simpler;
    scales_.simpler.clear();
    for (const char* axis : {"a.bending", "b.bending", "a.torsion", "b.torsion"}) {
      const double stiffness =
          from.point.ValueOf(std::string("extensions.clamp_compliance.") + axis);
      if (stiffness > 0) scales_.simpler[axis] = stiffness;
    }
    FitProblem& plain = *models_.front()->problem;
    const FitPoint there = plain.At(plain.StartFrom(from.point, {}));
    if (!there.ok) continue;
    const std::vector<Screened> starts = Screen(plain, there, TrialsFromSimpler(cause, scales_));
    int tried = 0;
    for (const Screened& start : starts) {
      if (tried++ == kStarts || OutOfTime() || IsExplained(cause.name, baseline())) break;
      std::unique_ptr<FittedTrial> fitted = FitOne({start.trial}, from);
      if (!fitted) continue;
      Charge("candidates", fitted->problem->count());
      if (fitted->point.ok && !fitted->point.interrupted) Keep(std::move(fitted));
    }
  }
  LookAtTheBest();
}

void DiagnosisWork::FitParts() {
  const Judgement judgement = Judged();
  if (judgement.best == 0) return;
  const FittedTrial& whole = model(judgement.best);
  std::vector<Trial> parts;
  if (whole.causes().size() > 1) {
    parts = whole.trials;
  } else {
    for (const Trial& larger : whole.trials)
      for (const std::string& simpler : FindCause(larger.cause)->contains) {
        // Found by itself, it may stand where its fit was cut off.
        for (const auto& one : models_)
          if (one->causes() == std::vector<std::string>{simpler} && !HasEnded(*one))
            GoOn(one.get());
        const Trial part = PartOf(larger, simpler);
        if (!part.components.empty()) parts.push_back(part);
      }
  }
  for (const Trial& trial : parts) {
    if (IsExplained(trial.cause, baseline())) continue;
    if (OutOfTime() || !Tell("without the rest: " + trial.cause, 0.7)) return;
    // From where it stands in the whole, which may lie beyond what its own search has seen.
    std::unique_ptr<FittedTrial> alone = FitOne({trial}, model(judgement.best));
    if (!alone) continue;
    Charge("removal", alone->problem->count());
    if (alone->point.ok && !alone->point.interrupted) Keep(std::move(alone));
  }
  LookAtTheBest();
}

void DiagnosisWork::FitRivalsOfParts(int most, double part) {
  const std::vector<Trial> parts = model(Judged().best).trials;
  if (parts.size() < 2) return;
  for (const Trial& replaced : parts) {
    std::vector<Trial> others;
    for (const Trial& trial : parts)
      if (trial.cause != replaced.cause) others.push_back(trial);
    const auto without = std::find_if(models_.begin(), models_.end(), [&](const auto& one) {
      return one->causes() == CausesOf(others);
    });
    if (others.empty() || without == models_.end()) continue;
    std::vector<Screened> rivals = ScreenAround(**without, "screening of pairs");
    double own = 0;
    for (const Screened& one : rivals)
      if (one.trial.cause == replaced.cause) own = std::max(own, one.drop);
    rivals.erase(std::remove_if(rivals.begin(), rivals.end(),
                                [&](const Screened& one) {
                                  return one.trial.cause == replaced.cause ||
                                         one.drop < kAsPromising * own;
                                }),
                 rivals.end());
    FitCandidates(rivals, static_cast<int>(without - models_.begin()), most, part);
  }
}

}  // namespace cosserat_cable
