#include "cosserat_cable/measurement/specimen.h"

#include "cosserat_cable/cable/section_file.h"

namespace cosserat_cable {

CableKeys SpecimenKeys(const MeasurementSet& set, const Experiment& experiment) {
  CableKeys keys = experiment.specimen;
  keys.FillFrom(set.cable);
  return keys;
}

CableKeys SpecimenKeys(const MeasurementSet& set, const Experiment& experiment,
                       const CableKeys& cable_file) {
  return WithFitted(SpecimenKeys(set, experiment), cable_file);
}

CableKeys WithoutUnknownDamping(CableKeys keys) {
  const auto set = [](DampingKey* key) {
    if (key->kind == DampingKey::Kind::kUnknown) *key = {DampingKey::Kind::kNumber, 0.0};
  };
  for (auto* single : {&keys.eta_GJ, &keys.eta_EA})
    if (single->value) set(&*single->value);
  for (auto* pair : {&keys.eta_EI, &keys.eta_GA})
    if (pair->value)
      for (DampingKey& key : *pair->value) set(&key);
  return keys;
}

Specimen MakeSpecimen(const CableKeys& keys, const Experiment& experiment, Problems* problems) {
  Specimen specimen;
  specimen.cable = CompleteCable(keys, experiment.mark, problems);
  specimen.disc_inertia = experiment.b.disc.inertia;
  specimen.faults = keys.faults.value.value_or(Faults());
  return specimen;
}

}  // namespace cosserat_cable
