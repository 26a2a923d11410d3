// A set of one record: a cable that was pulled aside and let go.
#pragma once

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "../measurement/rigs.h"

namespace cosserat_cable::testing {

constexpr double kPulledNoise = 2e-5;  // [m]

/// By `deflection` [m]; the record is what the specimen does, without noise.
inline MeasurementSet Pulled(double deflection, const Specimen& specimen) {
  MeasurementSet set;
  Problems problems;
  MapReader map(YamlValue::Root("set",
                                YAML::Load("length: 0.25\ndiameter: 0.006\nmass_per_length: 0.05\n"
                                           "EI: 0.003\nGJ: 0.0019\neta_EI: 1.0e-5\neta_GJ: 4.0e-6\n"
                                           "uncertain: [EI, eta_EI]\n"),
                                &problems));
  set.cable = ReadCableKeys(&map);
  EXPECT_TRUE(problems.empty()) << problems.ToString();
  Experiment experiment = RingDown(deflection, 0.5, 101);
  experiment.channels[0].sigma = kPulledNoise;
  const SimulatedRecord record = SimulateRefined(experiment, specimen, {}).record;
  EXPECT_TRUE(record.ok) << record.message;
  experiment.record.values = record.values;
  set.experiments = {experiment};
  return set;
}

}  // namespace cosserat_cable::testing
