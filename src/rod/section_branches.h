// The branches of one rod's section law, as a value: copying a rod copies their internal variables.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "cosserat_cable/rod/section_branch.h"
#include "dynamic_modulus.h"

namespace cosserat_cable::rod {

class SectionBranches {
 public:
  SectionBranches(const std::vector<std::shared_ptr<const SectionBranch>>& prototypes,
                  int elements) {
    for (const auto& prototype : prototypes) {
      branches_.push_back(prototype->Clone());
      branches_.back()->SetElements(elements);
    }
  }
  SectionBranches(const SectionBranches& other) {
    for (const auto& branch : other.branches_) branches_.push_back(branch->Clone());
  }
  SectionBranches(SectionBranches&&) noexcept = default;
  SectionBranches& operator=(SectionBranches&&) noexcept = default;

  bool empty() const { return branches_.empty(); }
  void ExchangeState(StateArchive* state) {
    for (auto& branch : branches_) branch->ExchangeState(state);
  }

  void BeginStep(double dt) {
    for (auto& branch : branches_) branch->BeginStep(dt);
  }
  SectionValue StepStiffness() const { return Sum(&SectionBranch::StepStiffness); }
  SectionValue StaticStiffness() const { return Sum(&SectionBranch::StaticStiffness); }
  SectionValue Offset(int element) const { return Sum(&SectionBranch::Offset, element); }
  void Commit(int element, const ElementStrain& strain) {
    for (auto& branch : branches_) branch->Commit(element, strain);
  }
  void Rest(int element, const ElementStrain& strain) {
    for (auto& branch : branches_) branch->Rest(element, strain);
  }
  double Energy(int element) const {
    double energy = 0;
    for (const auto& branch : branches_) energy += branch->Energy(element);
    return energy;
  }
  double DissipationRate(int element) const {
    double rate = 0;
    for (const auto& branch : branches_) rate += branch->DissipationRate(element);
    return rate;
  }
  /// Adds to the moduli of shear along a1 and a2, stretch, bending about a1 and a2, and twist.
  void AddTo(std::array<DynamicModulus, 6>* moduli) const {
    const SectionValue more = StaticStiffness();
    for (int k = 0; k < 6; ++k) (*moduli)[k].C += Component(more, k);
    for (const auto& branch : branches_)
      for (const SectionBranch::Relaxation& relaxation : branch->Relaxations())
        for (int k = 0; k < 6; ++k)
          if (const double G = Component(relaxation.stiffness, k); G != 0)
            (*moduli)[k].branches.push_back({G, relaxation.rate});
  }

 private:
  static double Component(const SectionValue& value, int k) {
    return k < 3 ? value.F[k] : value.M[k - 3];
  }

  template <class... Arguments>
  SectionValue Sum(SectionValue (SectionBranch::*value)(Arguments...) const,
                   Arguments... arguments) const {
    SectionValue sum;
    for (const auto& branch : branches_) sum += (branch.get()->*value)(arguments...);
    return sum;
  }

  std::vector<std::unique_ptr<SectionBranch>> branches_;
};

}  // namespace cosserat_cable::rod
