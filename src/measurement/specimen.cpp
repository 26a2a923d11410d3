#include "cosserat_cable/measurement/specimen.h"

namespace cosserat_cable {

CableKeys SpecimenKeys(const MeasurementSet& set, const Experiment& experiment) {
  CableKeys keys = experiment.specimen;
  keys.FillFrom(set.cable);
  return keys;
}

CableKeys SpecimenKeys(const MeasurementSet& set, const Experiment& experiment,
                       const CableKeys& cable_file) {
  // What is fitted goes by the file; what is known of the specimen, by the set.
  CableKeys fitted;
  fitted.EI = cable_file.EI;
  fitted.GJ = cable_file.GJ;
  fitted.EA = cable_file.EA;
  fitted.GA = cable_file.GA;
  fitted.eta_EI = cable_file.eta_EI;
  fitted.eta_GJ = cable_file.eta_GJ;
  fitted.eta_EA = cable_file.eta_EA;
  fitted.eta_GA = cable_file.eta_GA;
  fitted.extensions = cable_file.extensions;
  fitted.elements = cable_file.elements;
  fitted.FillFrom(SpecimenKeys(set, experiment));
  return fitted;
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

CableKeys LoadSpecimenFile(const std::string& path, Problems* problems) {
  MapReader file(LoadYamlFile(path, problems));
  file.Required("format").Integer(1, 1);
  const YamlValue cable = file.Required("cable");
  MapReader map(cable);
  return ReadCableKeys(&map);
}

}  // namespace cosserat_cable
