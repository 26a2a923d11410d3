#include "cosserat_cable/rod/rod_batch.h"

#include <stdexcept>

#include "rod_impl.h"
#include "time_step.h"

namespace cosserat_cable::rod {
struct RodBatch::Impl {
  explicit Impl(const std::vector<Rod*>& all)
      : rods(all), chain(ChainLayout::Side(all.front()->elements())), reports(all.size()) {
    for (int l = 0; l < kMaxRods; ++l) OfLane(l).FillMasses(l, chain.layout, &chain.masses);
  }

  // Lanes without a rod repeat the first one's and are never active.
  Rod::Impl& OfLane(int lane) {
    return *rods[lane < static_cast<int>(rods.size()) ? lane : 0]->impl_;
  }

  std::vector<Rod*> rods;
  StepChain<Lanes> chain;
  std::vector<SolveReport> reports;
};

RodBatch::RodBatch(const std::vector<Rod*>& rods) {
  if (rods.empty() || rods.size() > kMaxRods)
    throw std::invalid_argument("a batch has one to four rods");
  for (const Rod* rod : rods)
    if (rod->elements() != rods.front()->elements() ||
        rod->model().a.clamped() != rods.front()->model().a.clamped() ||
        rod->model().b.clamped() != rods.front()->model().b.clamped())
      throw std::invalid_argument("rods of a batch have equal elements and clamped ends");
  for (const Rod* rod : rods)
    if (!rod->model().joints.empty())
      throw std::invalid_argument("a rod with joints is stepped by itself");
  impl_ = std::make_unique<Impl>(rods);
}
RodBatch::~RodBatch() = default;
RodBatch::RodBatch(RodBatch&&) noexcept = default;
RodBatch& RodBatch::operator=(RodBatch&&) noexcept = default;

const std::vector<SolveReport>& RodBatch::Step(double dt, const std::vector<RodDrive>& drives) {
  Impl& m = *impl_;
  StepChain<Lanes>& chain = m.chain;
  const int count = static_cast<int>(m.rods.size());
  const StepCoefficients c(dt);
  StepOfRod steps[kMaxRods];
  RodState states[kMaxRods];
  for (int l = 0; l < kMaxRods; ++l) {
    Rod::Impl& rod = m.OfLane(l);
    states[l] = rod.State();
    steps[l].ends = &rod.ends;
    if (l < count && drives[l].a) {
      steps[l] = {true, rod.model.length, drives[l].load, &rod.ends, {}, 0};
      rod.BeginStep(c, *drives[l].a, *drives[l].b);
    }
    rod.FillChain(l, &chain);
  }
  chain.SetHeld(m.OfLane(0).model.a.clamped(), m.OfLane(0).model.b.clamped());
  Predict(c, states, &chain);
  for (int l = 0; l < kMaxRods; ++l) m.OfLane(l).HoldInChain(l, &chain);
  SolveStep(c, &chain, steps);
  const RodState* accepting[kMaxRods] = {};
  for (int l = 0; l < count; ++l) {
    m.reports[l] = steps[l].report;
    if (!m.reports[l].converged) {
      if (steps[l].active) m.OfLane(l).TakeBackStep();
      continue;
    }
    m.OfLane(l).TakeStep(chain, l);
    accepting[l] = &states[l];
  }
  Accept(c, chain, accepting);
  for (int l = 0; l < count; ++l)
    if (accepting[l]) m.OfLane(l).AccountForStep(dt, steps[l].load_power);
  return m.reports;
}

}  // namespace cosserat_cable::rod
