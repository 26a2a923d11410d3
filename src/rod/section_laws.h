// The laws of one rod's section that are not linear over a step, as a value: copying a rod copies
// their internal variables.
#pragma once

#include <memory>
#include <vector>

#include "cosserat_cable/rod/section_law.h"

namespace cosserat_cable::rod {

inline SectionValue Split(const SectionVector& v) { return {v.head<3>(), v.tail<3>()}; }

class SectionLaws {
 public:
  SectionLaws(const std::vector<std::shared_ptr<const SectionLaw>>& prototypes, int elements)
      : elements_(elements) {
    for (const auto& prototype : prototypes) {
      laws_.push_back(prototype->Clone());
      answers_to_gamma_ |= prototype->answers_to_gamma();
    }
    Reset();
  }
  SectionLaws(const SectionLaws& other)
      : elements_(other.elements_), answers_to_gamma_(other.answers_to_gamma_) {
    for (const auto& law : other.laws_) laws_.push_back(law->Clone());
  }
  SectionLaws(SectionLaws&&) noexcept = default;
  SectionLaws& operator=(SectionLaws&&) noexcept = default;

  bool empty() const { return laws_.empty(); }
  void ExchangeState(StateArchive* state) {
    for (auto& law : laws_) law->ExchangeState(state);
  }
  bool answers_to_gamma() const { return answers_to_gamma_; }

  void Reset() {
    for (auto& law : laws_) law->Reset(elements_);
  }
  void BeginStep(double dt) {
    for (auto& law : laws_) law->BeginStep(dt);
  }
  SectionResponse Evaluate(int element, const ElementStrain& strain, double rate_by_strain) const {
    SectionResponse sum;
    for (const auto& law : laws_) law->Evaluate(element, strain, rate_by_strain, &sum);
    return sum;
  }
  double Potential(int element, const ElementStrain& strain) const {
    double sum = 0;
    for (const auto& law : laws_) sum += law->Potential(element, strain);
    return sum;
  }
  /// Returns what is dissipated, per length [J/m].
  double Commit(int element, const ElementStrain& strain) {
    double sum = 0;
    for (auto& law : laws_) sum += law->Commit(element, strain);
    return sum;
  }
  void Rest(int element, const ElementStrain& strain) {
    for (auto& law : laws_) law->Rest(element, strain);
  }
  double Energy(int element, const ElementStrain& strain) const {
    double sum = 0;
    for (const auto& law : laws_) sum += law->Energy(element, strain);
    return sum;
  }
  SectionMatrix SmallTangent(int element, const ElementStrain& strain) const {
    SectionMatrix sum = SectionMatrix::Zero();
    for (const auto& law : laws_) sum += law->SmallTangent(element, strain);
    return sum;
  }

 private:
  int elements_;
  bool answers_to_gamma_ = false;
  std::vector<std::unique_ptr<SectionLaw>> laws_;
};

}  // namespace cosserat_cable::rod
