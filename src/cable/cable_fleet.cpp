#include "cosserat_cable/cable/cable_fleet.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "cable_simulation_impl.h"
#include "cosserat_cable/math/lanes.h"
#include "cosserat_cable/rod/rod_batch.h"

namespace cosserat_cable {
namespace {

std::size_t RatioRoundedUp(std::size_t a, std::size_t b) { return (a + b - 1) / b; }

/// How many of `cables` alike go together at most. Fewer than four cost as much as four.
std::size_t GroupLimit(std::size_t cables, int threads) {
  return std::clamp<std::size_t>(RatioRoundedUp(cables, static_cast<std::size_t>(threads)),
                                 kLaneCount<Lanes>,
                                 static_cast<std::size_t>(rod::RodBatch::PreferredRods()));
}

}  // namespace

struct CableFleet::Impl {
  /// Cables that share a kernel.
  struct Group {
    std::vector<std::size_t> members;
    std::optional<rod::RodBatch> batch;  // none: of a cable that goes by itself
    std::vector<rod::RodDrive> drives;
  };

  std::vector<CableSimulation*> cables;
  std::vector<Group> groups;
};

CableFleet::CableFleet(const std::vector<CableSimulation*>& cables, int threads, LoneCable lone)
    : impl_(std::make_unique<Impl>()) {
  impl_->cables = cables;
  // What the rods of a batch have in common: the number of elements, and how ends are held.
  std::map<std::tuple<int, bool, bool, bool, bool>, std::vector<std::size_t>> alike;
  for (std::size_t i = 0; i < cables.size(); ++i) {
    const rod::RodModel& rod = cables[i]->impl_->rod.model();
    alike[{rod.elements, rod.a.clamped(), rod.b.clamped(), rod.a.partly_held(),
           rod.b.partly_held()}]
        .push_back(i);
  }
  for (const auto& [kind, members] : alike) {
    // As even as can be.
    const std::size_t count = RatioRoundedUp(members.size(), GroupLimit(members.size(), threads));
    for (std::size_t g = 0; g < count; ++g) {
      Impl::Group group;
      group.members.assign(members.begin() + g * members.size() / count,
                           members.begin() + (g + 1) * members.size() / count);
      if (group.members.size() > 1 || lone == LoneCable::kInLanes) {
        std::vector<rod::Rod*> rods;
        for (std::size_t i : group.members) rods.push_back(&cables[i]->impl_->rod);
        group.batch.emplace(rods);
        group.drives.resize(rods.size());
      }
      impl_->groups.push_back(std::move(group));
    }
  }
}
CableFleet::~CableFleet() = default;
CableFleet::CableFleet(CableFleet&&) noexcept = default;
CableFleet& CableFleet::operator=(CableFleet&&) noexcept = default;

std::size_t CableFleet::group_count() const { return impl_->groups.size(); }
const std::vector<std::size_t>& CableFleet::members(std::size_t group) const {
  return impl_->groups[group].members;
}

void CableFleet::StepGroup(std::size_t index, double dt,
                           const std::vector<const Surroundings*>& then,
                           std::vector<StepOutcome>* outcomes) {
  Impl::Group& group = impl_->groups[index];
  if (!group.batch) {
    if (then[0]) (*outcomes)[0] = impl_->cables[group.members[0]]->Step(dt, *then[0]);
    return;
  }
  for (std::size_t k = 0; k < group.members.size(); ++k) {
    group.drives[k] = {};
    if (!then[k]) continue;
    if (!IsFinite(*then[k])) {
      (*outcomes)[k] = RefuseNonFinite();
      continue;
    }
    CableSimulation::Impl& cable = *impl_->cables[group.members[k]]->impl_;
    cable.TakeSection(*then[k]);
    cable.SearchContact(dt, *then[k]);
    group.drives[k] = {&then[k]->a.X, &then[k]->b.X, cable.LoadIn(*then[k])};
  }
  const std::vector<rod::SolveReport>& reports = group.batch->Step(dt, group.drives);
  for (std::size_t k = 0; k < group.members.size(); ++k) {
    if (!group.drives[k].a) continue;
    CableSimulation::Impl& cable = *impl_->cables[group.members[k]]->impl_;
    if (reports[k].converged) {
      (*outcomes)[k] = StepOutcome();
      (*outcomes)[k].iterations = reports[k].iterations;
      cable.Accept(*then[k]);
    } else {
      (*outcomes)[k] = cable.StepInParts(dt, *then[k], reports[k].iterations);
    }
  }
}

std::vector<StepOutcome> CableFleet::Step(double dt, const std::vector<const Surroundings*>& then) {
  std::vector<StepOutcome> all(impl_->cables.size());
  for (std::size_t g = 0; g < group_count(); ++g) {
    std::vector<const Surroundings*> of_group;
    for (const std::size_t i : members(g)) of_group.push_back(then[i]);
    std::vector<StepOutcome> outcomes(of_group.size());
    StepGroup(g, dt, of_group, &outcomes);
    for (std::size_t k = 0; k < outcomes.size(); ++k) all[members(g)[k]] = std::move(outcomes[k]);
  }
  return all;
}

}  // namespace cosserat_cable
