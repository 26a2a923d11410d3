#include "cosserat_cable/rod/rod_batch.h"

#include <stdexcept>

#include "cosserat_cable/math/kernel.h"
#include "rod_impl.h"
#include "time_step.h"

namespace cosserat_cable::rod {

struct RodBatch::Impl {
  virtual ~Impl() = default;
  virtual const std::vector<SolveReport>& Step(double dt, const std::vector<RodDrive>& drives) = 0;
};

template <class T>
struct RodBatch::ImplInLanes : Impl {
  static constexpr int kLanes = kLaneCount<T>;

  explicit ImplInLanes(const std::vector<Rod*>& all)
      : rods(all), chain(ChainLayout::Side(all.front()->elements())), reports(all.size()) {
    for (int l = 0; l < kLanes; ++l) OfLane(l).FillMasses(l, chain.layout, &chain.masses);
    chain.SetHeld(OfLane(0).model.a.clamped(), OfLane(0).model.b.clamped());
  }

  // Lanes without a rod repeat the first one's and are never active.
  Rod::Impl& OfLane(int lane) {
    return *rods[lane < static_cast<int>(rods.size()) ? lane : 0]->impl_;
  }

  const std::vector<SolveReport>& Step(double dt, const std::vector<RodDrive>& drives) override {
    const int count = static_cast<int>(rods.size());
    const StepCoefficients c(dt);
    StepOfRod steps[kLanes];
    RodState states[kLanes];
    for (int l = 0; l < kLanes; ++l) {
      Rod::Impl& rod = OfLane(l);
      states[l] = rod.State();
      steps[l].ends = &rod.ends;
      if (l < count && drives[l].a) {
        steps[l] = {true, rod.model.length, drives[l].load, &rod.ends, {}, 0};
        rod.BeginStep(c, *drives[l].a, *drives[l].b);
      }
      rod.FillChain(l, &chain, &shear);
    }
    OffsetShear(shear, &chain);
    for (int l = 0; l < count; ++l) OfLane(l).AddBranches(l, &chain);
    Predict(c, states, &chain);
    for (int l = 0; l < kLanes; ++l) OfLane(l).HoldInChain(l, &chain);
    SolveStep(c, &chain, steps);
    for (int l = 0; l < kLanes; ++l)
      if (!steps[l].report.converged) shear.history[l] = nullptr;
    CommitShear(chain, &shear);
    const RodState* accepting[kLanes] = {};
    for (int l = 0; l < count; ++l) {
      reports[l] = steps[l].report;
      if (!reports[l].converged) {
        if (steps[l].active) OfLane(l).TakeBackStep();
        continue;
      }
      OfLane(l).TakeStep(chain, shear, l);
      accepting[l] = &states[l];
    }
    Accept(c, chain, accepting);
    for (int l = 0; l < count; ++l)
      if (accepting[l]) OfLane(l).AccountForStep(dt, steps[l].load_power);
    return reports;
  }

  std::vector<Rod*> rods;
  StepChain<T> chain;
  ShearLanes<T> shear;
  std::vector<SolveReport> reports;
};

int RodBatch::PreferredRods() {
  return HasWideVectors() ? kLaneCount<WideLanes> : kLaneCount<Lanes>;
}

RodBatch::RodBatch(const std::vector<Rod*>& rods) {
  if (rods.empty() || rods.size() > kMaxRods)
    throw std::invalid_argument("a batch has one to eight rods");
  for (const Rod* rod : rods)
    if (rod->elements() != rods.front()->elements() ||
        rod->model().a.clamped() != rods.front()->model().a.clamped() ||
        rod->model().b.clamped() != rods.front()->model().b.clamped())
      throw std::invalid_argument("rods of a batch have equal elements and clamped ends");
  for (const Rod* rod : rods)
    if (!rod->model().joints.empty())
      throw std::invalid_argument("a rod with joints is stepped by itself");
  if (rods.size() > kLaneCount<Lanes>)
    impl_ = std::make_unique<ImplInLanes<WideLanes>>(rods);
  else
    impl_ = std::make_unique<ImplInLanes<Lanes>>(rods);
}
RodBatch::~RodBatch() = default;
RodBatch::RodBatch(RodBatch&&) noexcept = default;
RodBatch& RodBatch::operator=(RodBatch&&) noexcept = default;

const std::vector<SolveReport>& RodBatch::Step(double dt, const std::vector<RodDrive>& drives) {
  return impl_->Step(dt, drives);
}

}  // namespace cosserat_cable::rod
