#include "verdict.h"

#include <algorithm>
#include <cmath>

#include "cosserat_cable/causes/cause.h"
#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {
namespace {

// A difference of sums of squares that one more parameter does not make by chance, among all that
// were tried; and for each parameter beyond.
constexpr double kSignificant = 25, kPerParameter = 4;
// Standard errors of a paired difference.
constexpr double kBeyondError = 3, kBeyondErrorHeldOut = 2;
// A law that is right in kind explains this part of the misfit at least, and leaves so many times
// the noise's variance at most.
constexpr double kExplained = 0.97, kMostLeft = 6;
// And somewhat less of it, where no more than half of the noise's variance is left beyond it.
constexpr double kExplainedOfFaint = 0.95, kNearNoise = 1.5;
// Of what a part of it leaves, what several causes together explain where they do not leave noise.
constexpr double kExplainedBeyondPart = 0.9;
// What a rival leaves beyond the noise, by what the best leaves, where neither leaves just noise.
constexpr double kFarWorse = 2.5;

/// Part of what a simpler model leaves beyond the noise that a contender explains.
double ShareOf(const Contender& contender, const Contender& simpler) {
  const double misfit = simpler.adequacy.excess();
  return misfit > 0 ? (simpler.adequacy.chi2 - contender.adequacy.chi2) / misfit : 0.0;
}

/// Whether these are some of the causes of a contender that has more.
bool IsPartOf(const Contender& part, const Contender& whole) {
  return !part.causes.empty() && part.causes.size() < whole.causes.size() &&
         std::all_of(part.causes.begin(), part.causes.end(), [&](const std::string& name) {
           return std::count(whole.causes.begin(), whole.causes.end(), name) > 0;
         });
}

std::string Times(const Contender& contender) {
  return FormatRounded(std::sqrt(contender.adequacy.times()), 3) + " times the noise";
}

// Part of what a simpler model leaves beyond the noise that is left by one which is worth its more.
constexpr double kHardlyAny = 0.5;
// Part of what a simpler model leaves that is too little to be worth more.
constexpr double kOfLeft = 0.1;
// Of the noise's variance: what a cause must gain per sample of some record, where the plain model
// leaves as good as noise. No simulation is nearer to a real cable, nor to another simulation.
constexpr double kMaterial = 0.1;
// Part of the noise's sum of squares that a law may be wrong by in form.
constexpr double kOfAdequate = 0.05;

class Court {
 public:
  Court(const std::vector<Contender>& contenders, const DifferenceBetween& difference,
        const DifferenceBetween& heldout)
      : contenders_(contenders), difference_(difference), heldout_(heldout) {
    judgement_.rejected.resize(contenders.size());
  }

  Judgement Hear() {
    FindBest();
    const Contender& best = Of(judgement_.best);
    if (judgement_.best == 0) {
      judgement_.verdict = best.adequacy.adequate ? Verdict::kNone : Verdict::kUnexplained;
    } else {
      judgement_.verdict = Explains(judgement_.best) ? Verdict::kNamed : Verdict::kUnexplained;
    }
    for (int r = 0; r < Count(); ++r)
      if (r != judgement_.best) Try(r);
    if (judgement_.verdict == Verdict::kNamed && !judgement_.rivals.empty())
      judgement_.verdict = Verdict::kAmbiguous;
    if (judgement_.verdict == Verdict::kUnexplained) judgement_.rivals.clear();
    return judgement_;
  }

 private:
  int Count() const { return static_cast<int>(contenders_.size()); }
  const Contender& Of(int i) const { return contenders_[static_cast<std::size_t>(i)]; }
  double Needed(int worse, int better) const {
    const int more = std::max(1, Of(better).parameters - Of(worse).parameters);
    return kSignificant + kPerParameter * (more - 1);
  }
  /// Times the noise's variance that may be left by what is right in kind: next to none, but of one
  /// law of the cable, or beside a law whose kind differs in form. What no law describes is easily
  /// shared out among two, and a fault of a record has one form only.
  static double MostLeft(const Contender& one) {
    bool differs = false, of_cable = true;
    for (const std::string& name : one.causes) {
      const Cause* cause = FindCause(name);
      differs = differs || (cause && cause->form > 0);
      of_cable = of_cable && cause && cause->law.has_value();
    }
    return differs || (of_cable && one.causes.size() < 2) ? kMostLeft : kNearNoise;
  }
  /// Whether a contender leaves just noise, or is right in kind.
  bool Explains(int i) const {
    const Contender& one = Of(i);
    if (one.adequacy.adequate) return true;
    const double share = ShareOf(one, Of(0)), left = one.adequacy.times();
    const bool in_kind = (share > kExplained && left < MostLeft(one)) ||
                         (share > kExplainedOfFaint && left < kNearNoise);
    return in_kind && std::none_of(contenders_.begin(), contenders_.end(), [&](const auto& part) {
             return IsPartOf(part, one) && ShareOf(one, part) < kExplainedBeyondPart;
           });
  }
  static bool IsMaterial(const Difference& fitted) { return fitted.most_per_sample > kMaterial; }
  bool Beats(int better, int worse) const {
    const Difference fitted = difference_(worse, better);
    if (!(fitted.value > Needed(worse, better))) return false;
    if (worse != 0 || !Of(0).adequacy.adequate) return true;
    if (!IsMaterial(fitted)) return false;
    // What is added to a plain model that leaves as good as noise must predict better, too.
    const Difference predicted = heldout_(worse, better);
    return predicted.value > kBeyondErrorHeldOut * predicted.se;
  }
  /// Whether a larger model is worth its more: where the simpler one with a cause leaves as good as
  /// noise, the rest may be what any law is wrong by in form, and it must show in predictions too.
  bool IsWorthIt(int larger, int simpler) const {
    if (!Beats(larger, simpler)) return false;
    if (simpler == 0) return true;
    const Adequacy& left = Of(simpler).adequacy;
    // Far from the noise, predictions by derivatives say nothing.
    if (!left.adequate && Of(larger).adequacy.excess() < kHardlyAny * left.excess()) return true;
    if (!(heldout_(simpler, larger).value > 0)) return false;
    const double gained = difference_(simpler, larger).value;
    return gained > (left.adequate ? kOfAdequate * left.expected : kOfLeft * left.excess());
  }

  /// The best fit; then the simplest of what it contains and does not clearly beat.
  void FindBest() {
    int best = 0;
    double most = 0;
    for (int i = 1; i < Count(); ++i) {
      if (Of(i).faint || !Beats(i, 0)) continue;
      const double gained = difference_(0, i).value - kPerParameter * Of(i).parameters;
      if (gained <= most) continue;
      most = gained;
      best = i;
    }
    for (bool simpler = true; simpler;) {
      simpler = false;
      for (int p = 0; p < Count() && !simpler; ++p) {
        if (p == best || Of(p).faint || !Contains(Of(best).causes, Of(p).causes)) continue;
        const bool explains_instead = IsPartOf(Of(p), Of(best)) && Explains(p) && !Explains(best);
        if (IsWorthIt(best, p) && !explains_instead) continue;
        best = p;
        simpler = true;
      }
    }
    judgement_.best = best;
  }

  void Try(int r) {
    const int b = judgement_.best;
    const Contender &rival = Of(r), &best = Of(b), &plain = Of(0);
    std::string& reason = judgement_.rejected[static_cast<std::size_t>(r)];
    const Difference worse = difference_(r, b);
    if (r == 0) {
      // Beaten, or it would be the best; but perhaps in one stretch only.
      if (rival.adequacy.adequate && worse.value < kBeyondError * worse.se)
        judgement_.rivals.push_back(r);
      else
        reason = "it leaves " + Times(rival);
      return;
    }
    if (!Beats(r, 0)) {
      const Difference gained = difference_(0, r);
      const bool is_small =
          gained.value > Needed(0, r) && plain.adequacy.adequate && !IsMaterial(gained);
      reason = !is_small
                   ? "it improves the fit by no more than chance does"
                   : "what it improves is " + FormatRounded(100 * gained.most_per_sample, 2) +
                         " % of the noise's variance at most in any record: too little to tell "
                         "from what a simulation is wrong by";
      return;
    }
    if (rival.faint) {
      reason = "its size is far too small for such a fault: it stands for something else";
      return;
    }
    if (b != 0 && Contains(rival.causes, best.causes)) {
      reason = "it contains the simpler answer, and what it adds is too little";
      return;
    }
    if (!Explains(r)) {
      reason = "it explains " + FormatRounded(100 * std::max(0.0, ShareOf(rival, plain)), 3) +
               " % of the misfit, and leaves " + Times(rival);
      return;
    }
    const bool clearly = worse.value > Needed(r, b) && worse.value > kBeyondError * worse.se;
    const bool only_best_is_noise =
        worse.value > Needed(r, b) && best.adequacy.adequate && !rival.adequacy.adequate;
    const bool far = !best.adequacy.adequate && worse.value > Needed(r, b) &&
                     rival.adequacy.excess() > kFarWorse * std::max(0.0, best.adequacy.excess());
    if (clearly || only_best_is_noise || far) {
      reason = "it leaves " + Times(rival) + " where the best leaves " + Times(best) +
               ": worse by " + FormatRounded(worse.value, 3) + " noise variances, standard error " +
               FormatRounded(worse.se, 2);
      return;
    }
    judgement_.rivals.push_back(r);
  }

  const std::vector<Contender>& contenders_;
  const DifferenceBetween& difference_;
  const DifferenceBetween& heldout_;
  Judgement judgement_;
};

}  // namespace

bool Contains(const std::vector<std::string>& larger, const std::vector<std::string>& smaller) {
  if (larger == smaller) return false;
  std::vector<std::string> left = larger;
  for (const std::string& name : smaller) {
    const auto holds = [&](const std::string& one) {
      if (one == name) return true;
      const Cause* cause = FindCause(one);
      return cause && std::count(cause->contains.begin(), cause->contains.end(), name) > 0;
    };
    const auto place = std::find_if(left.begin(), left.end(), holds);
    if (place == left.end()) return false;
    left.erase(place);
  }
  return true;
}

Judgement Judge(const std::vector<Contender>& contenders, const DifferenceBetween& difference,
                const DifferenceBetween& heldout) {
  return Court(contenders, difference, heldout).Hear();
}

}  // namespace cosserat_cable
