#include "cosserat_cable/rod/rod_batch.h"

#include <stdexcept>

#include "cosserat_cable/math/kernel.h"
#include "rod_impl.h"

namespace cosserat_cable::rod {

struct RodBatch::Impl {
  virtual ~Impl() = default;
  virtual const std::vector<SolveReport>& Step(double dt, const std::vector<RodDrive>& drives) = 0;
};

template <class T>
struct RodBatch::ImplInLanes : Impl {
  explicit ImplInLanes(const std::vector<Rod*>& all)
      : rods(all),
        impls(all.size()),
        reports(all.size()),
        stepper(ChainLayout::Side(all.front()->elements()), *all.front()->impl_) {
    for (const Rod* rod : all)
      if (!rod->model().laws.empty()) stepper.SetNonlinear();
  }

  const std::vector<SolveReport>& Step(double dt, const std::vector<RodDrive>& drives) override {
    // A rod that was assigned to has another one.
    for (std::size_t l = 0; l < rods.size(); ++l) impls[l] = rods[l]->impl_.get();
    stepper.Step(dt, static_cast<int>(rods.size()), impls.data(), drives.data(), reports.data());
    return reports;
  }

  std::vector<Rod*> rods;
  std::vector<Rod::Impl*> impls;
  std::vector<SolveReport> reports;
  ChainStepper<T> stepper;
};

int RodBatch::PreferredRods() {
  return HasWideVectors() ? kLaneCount<WideLanes> : kLaneCount<Lanes>;
}

RodBatch::RodBatch(const std::vector<Rod*>& rods) {
  if (rods.empty() || rods.size() > kMaxRods)
    throw std::invalid_argument("a batch has one to eight rods");
  const RodModel& first = rods.front()->model();
  for (const Rod* rod : rods)
    if (rod->elements() != first.elements || rod->model().a.clamped() != first.a.clamped() ||
        rod->model().b.clamped() != first.b.clamped())
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
