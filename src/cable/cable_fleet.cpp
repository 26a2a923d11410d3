#include "cosserat_cable/cable/cable_fleet.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "cable_simulation_impl.h"
#include "cosserat_cable/rod/rod_batch.h"

namespace cosserat_cable {

struct CableFleet::Impl {
  /// Cables that share a kernel; a lone one is stepped by itself, which is cheaper.
  struct Group {
    std::vector<std::size_t> members;
    std::optional<rod::RodBatch> batch;
  };

  std::vector<CableSimulation*> cables;
  std::vector<Group> groups;
};

CableFleet::CableFleet(const std::vector<CableSimulation*>& cables)
    : impl_(std::make_unique<Impl>()) {
  impl_->cables = cables;
  // What the rods of a batch have in common: the number of elements, and which ends are rigid.
  std::map<std::tuple<int, bool, bool>, std::vector<std::size_t>> alike;
  for (std::size_t i = 0; i < cables.size(); ++i) {
    const rod::RodModel& rod = cables[i]->impl_->rod.model();
    alike[{rod.elements, rod.a.clamped(), rod.b.clamped()}].push_back(i);
  }
  impl_->groups.reserve(cables.size());  // batches stay where they are while others share with them
  const rod::RodBatch* last_batch = nullptr;
  for (const auto& [kind, members] : alike)
    for (std::size_t first = 0; first < members.size(); first += rod::RodBatch::kMaxRods) {
      const std::size_t last = std::min(members.size(), first + rod::RodBatch::kMaxRods);
      Impl::Group group;
      group.members.assign(members.begin() + first, members.begin() + last);
      if (group.members.size() > 1) {
        std::vector<rod::Rod*> rods;
        for (std::size_t i : group.members) rods.push_back(&cables[i]->impl_->rod);
        group.batch.emplace(rods, last_batch);
      }
      impl_->groups.push_back(std::move(group));
      if (impl_->groups.back().batch) last_batch = &*impl_->groups.back().batch;
    }
}
CableFleet::~CableFleet() = default;
CableFleet::CableFleet(CableFleet&&) noexcept = default;
CableFleet& CableFleet::operator=(CableFleet&&) noexcept = default;

std::vector<StepOutcome> CableFleet::Step(double dt, const std::vector<const Surroundings*>& then) {
  std::vector<StepOutcome> outcomes(impl_->cables.size());
  for (Impl::Group& group : impl_->groups) {
    if (!group.batch) {
      const std::size_t i = group.members.front();
      if (then[i]) outcomes[i] = impl_->cables[i]->Step(dt, *then[i]);
      continue;
    }
    std::vector<rod::RodDrive> drives(group.members.size());
    for (std::size_t k = 0; k < drives.size(); ++k) {
      const std::size_t i = group.members[k];
      if (!then[i]) continue;
      if (!IsFinite(*then[i])) {
        outcomes[i] = RefuseNonFinite();
        continue;
      }
      CableSimulation::Impl& cable = *impl_->cables[i]->impl_;
      cable.SearchContact(dt, *then[i]);
      drives[k] = {&then[i]->a.X, &then[i]->b.X, cable.load()};
    }
    const std::vector<rod::SolveReport> reports = group.batch->Step(dt, drives);
    for (std::size_t k = 0; k < drives.size(); ++k) {
      if (!drives[k].a) continue;
      const std::size_t i = group.members[k];
      CableSimulation::Impl& cable = *impl_->cables[i]->impl_;
      outcomes[i].iterations = reports[k].iterations;
      if (reports[k].converged)
        cable.Accept(*then[i]);
      else
        outcomes[i] = cable.StepInParts(dt, *then[i], reports[k].iterations);
    }
  }
  return outcomes;
}

}  // namespace cosserat_cable
