#include "cosserat_cable/rod/rod_batch.h"

#include <stdexcept>

#include "lane_access.h"
#include "rod_impl.h"
#include "time_step.h"

namespace cosserat_cable::rod {
struct RodBatch::Impl {
  Impl(const std::vector<Rod*>& all, std::shared_ptr<StepWorkspace<Lanes>> memory)
      : rods(all), workspace(std::move(memory)), w(*workspace) {}

  // Lanes without a rod repeat the first one's and are never active.
  Rod::Impl& OfLane(int lane) {
    return *rods[lane < static_cast<int>(rods.size()) ? lane : 0]->impl_;
  }

  /// State and law of a rod into its lane.
  void Gather(int lane, double dt) {
    Rod::Impl& rod = OfLane(lane);
    SetLane(&w.gravity, lane, rod.w.gravity);
    for (int i = 0; i < w.count; ++i) {
      SetLane(&w.mass[i], lane, rod.w.mass[i]);
      SetLane(&w.inertia[i], lane, rod.w.inertia[i]);
      SetLane(&w.node[i], lane, rod.w.node[i]);
      SetLane(&w.rate[i], lane, rod.w.rate[i]);
      SetLane(&w.algorithm[i], lane, rod.w.algorithm[i]);
    }
    SetLane(&w.law, lane, rod.LawOfStep(dt));
    for (int e = 0; e < w.count - 1; ++e) {
      const ElementOffset<double> offset = rod.Offset(e);
      w.chain.SetOffset(e, lane, offset.F, offset.M);
    }
    for (int end : {0, w.count - 1}) {
      SetLane(&w.trial[end], lane, rod.w.trial[end]);
      SetLane(&w.trial_rate[end], lane, rod.w.trial_rate[end]);
    }
  }

  /// The iterate of a lane becomes its rod's state.
  void Scatter(int lane) {
    Rod::Impl& rod = OfLane(lane);
    for (int i = 0; i < w.count; ++i) {
      NodeState& node = rod.w.node[i];
      node = GetLane(w.trial[i], lane);
      node.q = Normalized(node.q);  // rounding would add up over many steps
      rod.w.rate[i] = GetLane(w.trial_rate[i], lane);
      rod.w.algorithm[i] = GetLane(w.trial_algorithm[i], lane);
    }
    rod.TakeStresses(w, lane, false);
  }

  std::vector<Rod*> rods;
  std::shared_ptr<StepWorkspace<Lanes>> workspace;
  StepWorkspace<Lanes>& w;
};

RodBatch::RodBatch(const std::vector<Rod*>& rods, const RodBatch* sharing) {
  if (rods.empty() || rods.size() > kMaxRods)
    throw std::invalid_argument("a batch has one to four rods");
  for (const Rod* rod : rods)
    if (rod->elements() != rods.front()->elements() ||
        rod->model().held_a != rods.front()->model().held_a ||
        rod->model().held_b != rods.front()->model().held_b)
      throw std::invalid_argument("rods of a batch have equal elements and held ends");
  const int elements = rods.front()->elements();
  auto memory = sharing && sharing->impl_->w.count == elements + 1
                    ? sharing->impl_->workspace
                    : std::make_shared<StepWorkspace<Lanes>>(elements);
  impl_ = std::make_unique<Impl>(rods, std::move(memory));
}
RodBatch::~RodBatch() = default;
RodBatch::RodBatch(RodBatch&&) noexcept = default;
RodBatch& RodBatch::operator=(RodBatch&&) noexcept = default;

std::vector<SolveReport> RodBatch::Step(double dt, const std::vector<RodDrive>& drives) {
  Impl& m = *impl_;
  const int count = static_cast<int>(m.rods.size());
  bool active[kMaxRods] = {};
  const Load* loads[kMaxRods] = {};
  double lengths[kMaxRods];
  for (int l = 0; l < kMaxRods; ++l) {
    active[l] = l < count && drives[l].a;
    lengths[l] = m.OfLane(l).model.length;
    if (active[l]) {
      loads[l] = drives[l].load;
      m.OfLane(l).HoldEnds(*drives[l].a, *drives[l].b);
    }
    m.Gather(l, dt);
  }
  const Rod::Impl& any = m.OfLane(0);
  SolveReport reports[kMaxRods];
  SolveStep(StepCoefficients(dt), any.first_free(), any.last_free(), lengths, loads, active, &m.w,
            reports);
  for (int l = 0; l < count; ++l)
    if (reports[l].converged) m.Scatter(l);
  return {reports, reports + count};
}

}  // namespace cosserat_cable::rod
