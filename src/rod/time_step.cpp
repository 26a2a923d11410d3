#include "time_step.h"

#include <algorithm>
#include <cmath>

#include "chain_ends.h"
#include "chain_load.h"

namespace cosserat_cable::rod {
namespace {

constexpr int kMaxIterations = 24;
// From this iteration on, a correction that is not smaller than this part of the one before leads
// nowhere.
constexpr int kImpatientFrom = 8;
constexpr double kNoContraction = 0.9;
// Newton stops where the error still left, last correction times contraction, is below this
// fraction of the length (and rad): 2e-10 m for a 200 mm cable. A step that just misses it and one
// that just meets it, as of one rod with others beside it and alone, are then 1e-6 mm apart at most
// for cables of up to a metre.
constexpr double kTolerance = 1e-9;
// A correction this small is converged whatever the contraction.
constexpr double kRoundOff = 1e-12;
// The factors of the first iteration serve the second; whoever needs a third gets fresh ones. A
// fixed rule, so that no rod sees what its neighbours in the lanes need.
constexpr int kRefactorFrom = 3;
// From this iteration on, factors are as precise as everything else.
constexpr int kExactFrom = 5;

/// Of squares over the nodes of one rod with this `sum`: the amplitude of a wave, which is the
/// square root of twice their mean.
template <class T>
double Amplitude(const T& sum, int rod, const ChainLayout& layout) {
  const double total = layout.halves ? GetLane(sum, 0) + GetLane(sum, 1) : GetLane(sum, rod);
  return std::sqrt(2 * total / (layout.elements + 1));
}
template <class T>
bool IsPositive(const T& x, int rod, bool halves) {
  return halves ? GetLane(x, 0) > 0 && GetLane(x, 1) > 0 : GetLane(x, rod) > 0;
}

}  // namespace

template <class T>
void SolveStep(const StepCoefficients& c, StepChain<T>* chain, StepOfRod* rods) {
  constexpr int kLanes = kLaneCount<T>;
  const bool halves = chain->layout.halves;
  const int count = halves ? 1 : kLanes;
  bool running[kLanes];
  double previous[kLanes] = {};
  for (int r = 0; r < count; ++r) {
    running[r] = rods[r].active;
    rods[r].report = SolveReport();
  }
  const auto any_running = [&] {
    return std::any_of(running, running + count, [](bool x) { return x; });
  };
  const auto add_loads = [&](bool tangent, bool with_ends, const auto& wanted) {
    chain->loaded = false;
    for (int r = 0; r < count; ++r) {
      const bool ends = with_ends && rods[r].ends->active();
      if ((!rods[r].load && !ends) || !wanted(r)) continue;
      if (!chain->loaded) ClearLoads(chain);
      chain->loaded = true;
      if (rods[r].load)
        rods[r].load_power =
            AddLoad(*rods[r].load, ChainView<T>(chain, r, rods[r].time, rods[r].ends), r, tangent,
                    c.velocity_by_increment, chain);
      if (ends) AddEnds(c, *rods[r].ends, r, tangent, chain);
    }
  };

  const auto add_laws = [&](bool tangent, const auto& wanted) {
    if (!chain->nonlinear) return;
    if (tangent) ClearLaws(chain);
    for (int r = 0; r < count; ++r)
      if (rods[r].laws.laws && wanted(r)) AddLaws(c, rods[r].laws, r, tangent, chain);
  };

  ImposedAttitudes imposed[kLanes];
  const auto impose_ends = [&] {
    for (int r = 0; r < count; ++r) {
      const EndParts& ends = *rods[r].ends;
      if (running[r]) {
        ImposeEnds(c, ends, r, chain);
        imposed[r].Keep(ends, r, *chain);
      } else if (rods[r].report.converged) {
        imposed[r].PutBack(ends, r, chain);
      }
    }
  };

  // What holds an end in part is so stiff that its rounding in float would hold the rest as well.
  const bool partly_held =
      std::any_of(rods, rods + count, [](const StepOfRod& rod) { return rod.ends->active(); });
  const auto keep_running = [&] {
    T keep(1.0);
    for (int r = 0; r < count; ++r)
      if (!running[r])
        for (int l = 0; l < kLanes; ++l)
          if (halves || l == r) SetLane(&keep, l, 0.0);
    return keep;
  };

  for (int iteration = 1; iteration <= kMaxIterations && any_running(); ++iteration) {
    const bool fresh = iteration == 1 || iteration >= kRefactorFrom;
    add_loads(fresh, true, [&](int r) { return running[r]; });
    add_laws(fresh, [&](int r) { return running[r]; });
    ChainCorrection<T> size;
    bool definite[kLanes];
    const auto solve = [&](auto* solver, auto pivot) {
      EliminateForward(c, fresh, chain, solver, &pivot);
      for (int r = 0; r < count; ++r) definite[r] = IsPositive(pivot, r, halves);
      CorrectBackward(c, keep_running(), *solver, chain, &size);
    };
    if (iteration < kExactFrom && !partly_held)
      solve(&chain->quick, Quick<T>(1.0));
    else
      solve(&chain->exact, T(1.0));
    impose_ends();
    for (int r = 0; r < count; ++r) {
      if (!running[r]) continue;
      SolveReport& report = rods[r].report;
      report.iterations = iteration;
      report.correction = std::max(Amplitude(size.translation, r, chain->layout) / rods[r].length,
                                   Amplitude(size.rotation, r, chain->layout));
      if (!std::isfinite(report.correction) || !definite[r]) {
        running[r] = false;
        continue;
      }
      const double contraction = previous[r] > 0 ? report.correction / previous[r] : 1.0;
      report.converged =
          report.correction < kRoundOff || contraction * report.correction < kTolerance;
      running[r] = !report.converged &&
                   (iteration < kImpatientFrom || contraction < kNoContraction);
      previous[r] = report.correction;
    }
  }

  // What the clamps exert is not a load: it is what their nodes lack.
  add_loads(false, false, [&](int r) { return rods[r].report.converged; });
  add_laws(false, [&](int r) { return rods[r].report.converged; });
}

template void SolveStep(const StepCoefficients&, StepChain<WideLanes>*, StepOfRod*);
template void SolveStep(const StepCoefficients&, StepChain<Lanes>*, StepOfRod*);
template void SolveStep(const StepCoefficients&, StepChain<LanePair>*, StepOfRod*);

}  // namespace cosserat_cable::rod
