#include "cosserat_cable/diagnosis/diagnosis.h"

#include <algorithm>
#include <set>

#include "diagnosis_work.h"

namespace cosserat_cable {
namespace {

// Causes that are fitted alone, and together with the best.
constexpr int kFirstCandidates = 4, kMostCandidates = 10, kMostPairs = 3, kAll = 19;
// How many single causes pairs are begun from.
constexpr std::size_t kPairsFrom = 2;
// Part of the misfit that a first cause explains from which a second is looked for at once, before
// causes that promise little.
constexpr double kWorthASecondNow = 0.4;
// What a second cause must promise, in noise variances, beside a first that leaves just noise.
constexpr double kWorthASecond = 40;

/// The best fits together with a second cause. `begun`: causes from which that was done.
void FitPairs(std::set<std::string>* begun, DiagnosisWork* work) {
  std::vector<int> singles;
  const int models = work->count();
  for (int i = 1; i < models; ++i)
    if (work->model(i).causes().size() == 1) singles.push_back(i);
  std::sort(singles.begin(), singles.end(),
            [&](int a, int b) { return work->model(a).point.cost < work->model(b).point.cost; });
  if (singles.size() > kPairsFrom) singles.resize(kPairsFrom);
  for (const int single : singles) {
    if (!begun->insert(work->model(single).causes().front()).second) continue;
    work->FitCandidates(work->ScreenAround(work->model(single), "screening of pairs"), single,
                        kMostPairs, 0.6);
  }
  work->FitParts();
  work->Continue(0.7);
  work->RefineBest();
}

}  // namespace

const char* ToString(Verdict verdict) {
  switch (verdict) {
    case Verdict::kNone:
      return "none";
    case Verdict::kNamed:
      return "named";
    case Verdict::kAmbiguous:
      return "ambiguous";
    case Verdict::kUnexplained:
      return "unexplained";
  }
  return "";
}

Diagnosis Diagnose(const MeasurementSet& set, const DiagnosisOptions& options, Problems* problems) {
  DiagnosisWork work(set, options);
  if (!work.FitBaseline(problems)) return work.Failed();
  const std::vector<Screened> screened = work.ScreenAround(work.baseline(), "screening");
  work.FitCandidates(screened, 0, kFirstCandidates, 0.25);
  work.FitPromisingPairs(screened, 0.3);
  work.FitCandidates(screened, 0, kMostCandidates, 0.32);
  work.FitFromSimpler();
  work.Continue(0.4);
  work.RefineBest();
  std::set<std::string> begun;
  // Two causes of a size: each explains a good part, and the right one is there already.
  const bool is_half_seen = work.ShareOfBest() > kWorthASecondNow;
  if (is_half_seen && work.Judged().verdict == Verdict::kUnexplained) FitPairs(&begun, &work);
  if (work.Judged().verdict == Verdict::kUnexplained) {
    // Far from the plain model its derivatives promise little of what is right.
    work.FitCandidates(screened, 0, kAll, 0.4);
    work.FitFromSimpler();
    work.Continue(0.6);
    work.RefineBest();
  }
  if (work.Judged().verdict != Verdict::kUnexplained) work.FitParts();
  const Judgement first = work.Judged();
  if (work.Stopping()) return work.Report();
  if (first.verdict == Verdict::kUnexplained) {
    FitPairs(&begun, &work);
  } else if (first.verdict == Verdict::kNamed && !work.LeavesNothing(first.best)) {
    std::vector<Screened> second = work.ScreenAround(work.model(first.best), "screening of pairs");
    second.erase(std::remove_if(second.begin(), second.end(),
                                [](const Screened& one) { return one.drop < kWorthASecond; }),
                 second.end());
    work.FitCandidates(second, first.best, kMostPairs, 0.6);
  }
  work.FitRivalsOfParts(kMostPairs, 0.8);
  work.FinishAnswer();
  return work.Report();
}

}  // namespace cosserat_cable
