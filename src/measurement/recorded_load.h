// An experiment's known forces on its cable, as a load.
#pragma once

#include "cosserat_cable/measurement/measurement_set.h"
#include "cosserat_cable/rod/load.h"

namespace cosserat_cable {

/// Those of a file are linear between its times, before and after as at the first and last one. The
/// rod's time is the file's: [s], or the step.
class RecordedLoad final : public rod::Load {
 public:
  /// The load has samples, and outlives this. `length`: of the rod, unstressed [m].
  RecordedLoad(const ExperimentLoad& load, double length) : load_(load), length_(length) {}

  void Evaluate(const rod::Centreline& rod, rod::LoadSink* sink) const override;
  double Energy(const rod::Centreline& rod) const override;

 private:
  /// Calls `use(element, xi, force_W)` for each force at the rod's time.
  template <class Use>
  void ForEach(const rod::Centreline& rod, const Use& use) const;

  const ExperimentLoad& load_;
  double length_;
};

}  // namespace cosserat_cable
