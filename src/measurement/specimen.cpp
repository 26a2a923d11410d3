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

Specimen MakeSpecimen(const CableKeys& keys, const Experiment& experiment, Problems* problems) {
  Specimen specimen;
  specimen.cable = CompleteCable(keys, experiment.mark, problems);
  specimen.disc_inertia = experiment.b.disc.inertia;
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
