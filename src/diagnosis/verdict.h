// The verdict, from how well each contender fits: no simulation here.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cosserat_cable/diagnosis/diagnosis.h"
#include "goodness.h"

namespace cosserat_cable {

/// The plain model (no causes), or one with some.
struct Contender {
  std::vector<std::string> causes;
  int parameters = 0;  ///< that it adds to the plain model's
  Adequacy adequacy;
  bool faint = false;  ///< its sizes are too small to be what its name says
};

struct Judgement {
  Verdict verdict = Verdict::kUnexplained;
  int best = 0;                       ///< the contender that is named, or fits best
  std::vector<int> rivals;            ///< that cannot be told from it; the plain model may be one
  std::vector<std::string> rejected;  ///< by contender: why not; empty for best and rivals
};

/// By how much one contender fits worse than another.
using DifferenceBetween = std::function<Difference(int worse, int better)>;

/// Whether a contender turns into another one where some of its numbers vanish.
bool Contains(const std::vector<std::string>& larger, const std::vector<std::string>& smaller);

/// The first contender is the plain model. `heldout`: the difference of what they predict of
/// records that were left out.
Judgement Judge(const std::vector<Contender>& contenders, const DifferenceBetween& difference,
                const DifferenceBetween& heldout);

}  // namespace cosserat_cable
