// `faults` of sets and experiments: read, written, and what cannot be is named.
#include <gtest/gtest.h>

#include "cosserat_cable/cable/parameters.h"
#include "cosserat_cable/measurement/experiment_simulation.h"
#include "cosserat_cable/measurement/fault_check.h"
#include "cosserat_cable/measurement/specimen.h"
#include "measurement/set_folder.h"

namespace cosserat_cable {
namespace {

const std::string kYaml = "measurement.yaml:";

// Line 10 and on are these, before the experiments.
std::string WithSetFaults(const std::string& faults) {
  return Replaced(AllSets(), "experiments:\n", faults + "experiments:\n");
}
std::string WithFaultsOf(const std::string& experiment, const std::string& faults) {
  const std::string name = "  - name: " + experiment + "\n";
  return Replaced(AllSets(), name, name + "    faults: " + faults + "\n");
}
std::string Said(const std::string& text) {
  SetFolder folder;
  WriteAll(&folder, text);
  return folder.Said();
}
MeasurementSet Loaded(const std::string& text) {
  SetFolder folder;
  WriteAll(&folder, text);
  return folder.LoadGood();
}

const char* const kAllFaults =
    "faults:\n"
    "  clock: {scale: 1.0e-3, delay: -0.002}\n"
    "  sensor:\n"
    "    - {channels: [tip_x, apex], scale: 1.02, tilt: [0.01, 0, -0.02], low_pass: 0.005}\n"
    "    - {scale: 0.99}\n"
    "  base_motion:\n"
    "    a: {amplitude: 1.1, phase: 0.2, bracket: {frequency: 25, damping: 0.03}, tilt: [0, 0.1, "
    "0]}\n"
    "    b: {amplitude: 0.9}\n";

TEST(Faults, AreReadWithTheirDefaults) {
  const MeasurementSet set = Loaded(WithSetFaults(kAllFaults));
  const Faults& faults = *set.cable.faults.value;
  EXPECT_EQ(faults.clock->scale, 1e-3);
  EXPECT_EQ(faults.clock->delay, -0.002);
  ASSERT_EQ(faults.sensor.size(), 2u);
  EXPECT_EQ(faults.sensor[0].channels, (std::vector<std::string>{"tip_x", "apex"}));
  EXPECT_EQ(faults.sensor[0].tilt, Eigen::Vector3d(0.01, 0, -0.02));
  EXPECT_EQ(faults.sensor[0].low_pass, 0.005);
  EXPECT_TRUE(faults.sensor[1].channels.empty());
  EXPECT_EQ(faults.sensor[1].scale, 0.99);
  EXPECT_EQ(faults.sensor[1].low_pass, 0);
  EXPECT_EQ(faults.a->amplitude, 1.1);
  EXPECT_EQ(faults.a->phase, 0.2);
  EXPECT_EQ(faults.a->bracket_frequency, 25);
  EXPECT_EQ(faults.a->bracket_damping, 0.03);
  EXPECT_EQ(faults.b->amplitude, 0.9);
  EXPECT_FALSE(faults.b->has_bracket());
  // All experiments go by them.
  for (const Experiment& experiment : set.experiments)
    EXPECT_EQ(SpecimenKeys(set, experiment).faults.value->clock->scale, 1e-3);
}

TEST(Faults, OfAnExperimentReplaceTheSetsAsAWhole) {
  const std::string text =
      Replaced(WithSetFaults("faults: {clock: {scale: 0.1}, sensor: [{scale: 2}]}\n"),
               "  - name: arch\n", "  - name: arch\n    faults: {clock: {delay: 0.5}}\n");
  const MeasurementSet set =
      Loaded(Replaced(text, "  - name: pendulum\n", "  - name: pendulum\n    faults: {}\n"));
  const auto of = [&](std::size_t e) {
    return *SpecimenKeys(set, set.experiments[e]).faults.value;
  };
  EXPECT_EQ(of(0).clock->scale, 0.1);
  EXPECT_FALSE(of(1).clock);
  EXPECT_EQ(of(2).clock->scale, 0);
  EXPECT_EQ(of(2).clock->delay, 0.5);
  EXPECT_TRUE(of(2).sensor.empty());
}

TEST(Faults, ReadBackAsTheyAreWritten) {
  const std::string text =
      Replaced(WithSetFaults(kAllFaults), "  - name: pendulum\n",
               "  - name: pendulum\n    faults: {sensor: [{channels: [phi_dot], scale: "
               "1.2345678901234567, low_pass: 0.0123456789012345678}]}\n");
  const MeasurementSet set =
      Loaded(Replaced(text, "  - name: swinging\n", "  - name: swinging\n    faults: {}\n"));
  SetFolder copy;
  WriteMeasurementSet(set, copy.path());
  const MeasurementSet read = copy.LoadGood();
  const auto expect_same = [](const CableKeys& first, const CableKeys& second) {
    EXPECT_EQ(first.faults.given(), second.faults.given());
    if (!first.faults.value) return;
    for (const std::string& path : FaultPaths(first)) {
      const auto value = GetParameter(path, first);
      // What has no effect may be left out.
      const auto other = GetParameter(path, second);
      EXPECT_EQ(value, other) << path;
    }
    ASSERT_EQ(first.faults.value->sensor.size(), second.faults.value->sensor.size());
    for (std::size_t i = 0; i < first.faults.value->sensor.size(); ++i)
      EXPECT_EQ(first.faults.value->sensor[i].channels, second.faults.value->sensor[i].channels);
  };
  expect_same(set.cable, read.cable);
  for (std::size_t e = 0; e < set.experiments.size(); ++e)
    expect_same(set.experiments[e].specimen, read.experiments[e].specimen);
  EXPECT_TRUE(read.experiments[4].specimen.faults.given()) << "{} is not nothing";
  EXPECT_FALSE(read.experiments[0].specimen.faults.given());
}

TEST(FaultMistakes, KeysAndNumbers) {
  EXPECT_EQ(Said(WithFaultsOf("ringdown_small", "{clokc: {scale: 0}}")),
            kYaml + "12: experiments[0].faults.clokc: got an unknown key, did you mean 'clock'?\n");
  EXPECT_EQ(
      Said(WithFaultsOf("ringdown_small", "{clock: {scale: 2}}")),
      kYaml + "12: experiments[0].faults.clock.scale: got 2, expected a number in [-0.5, 1]\n");
  EXPECT_EQ(Said(WithFaultsOf("ringdown_small", "{clock: {}}")),
            kYaml +
                "12: experiments[0].faults.clock: got nothing that acts, expected at least one of "
                "scale, delay\n");
  EXPECT_EQ(Said(WithFaultsOf("ringdown_small", "{sensor: {scale: 1}}")),
            kYaml +
                "12: experiments[0].faults.sensor: got a map, expected a list of groups of "
                "channels\n");
  EXPECT_EQ(Said(WithFaultsOf("ringdown_small", "{sensor: [{tilt: [0, 45, 0]}]}")),
            kYaml +
                "12: experiments[0].faults.sensor[0].tilt[1]: got 45, expected a number in [-3.2, "
                "3.2] [rad]: is it in degrees?\n");
  EXPECT_EQ(Said(WithFaultsOf("arch", "{base_motion: {}}")),
            kYaml +
                "30: experiments[2].faults.base_motion: got nothing that acts, expected at least "
                "one of a, b\n");
  EXPECT_EQ(Said(WithFaultsOf("arch", "{base_motion: {a: {bracket: {frequency: 20}}}}")),
            kYaml +
                "30: experiments[2].faults.base_motion.a.bracket.damping: missing, expected a "
                "number in [0, 10]\n");
}

TEST(FaultMistakes, WhatTheExperimentCannotHave) {
  EXPECT_EQ(Said(WithFaultsOf("ringdown_small", "{sensor: [{channels: [tip_y], scale: 2}]}")),
            kYaml +
                "12: experiments[0].faults.sensor[0].channels[0]: got 'tip_y', expected the column "
                "of a channel: did you mean 'tip_x'?\n");
  EXPECT_EQ(Said(WithFaultsOf("pendulum", "{sensor: [{tilt: [0, 0.1, 0]}]}")),
            kYaml +
                "22: experiments[1].faults.sensor[0].tilt: got a tilt of channels without position "
                "axes (angle, rate), expected one of channels with an `axis`\n");
  EXPECT_EQ(Said(WithFaultsOf("ringdown_small", "{base_motion: {b: {tilt: [0, 0, 0.1]}}}")),
            kYaml +
                "12: experiments[0].faults.base_motion.b: got the motion of an end that no clamp "
                "holds, expected {pose: [...]} or {motion: FILE} there\n");
  EXPECT_EQ(Said(WithFaultsOf("ringdown_small", "{base_motion: {a: {phase: 0.1}}}")),
            kYaml +
                "12: experiments[0].faults.base_motion.a.phase: got this of a clamp that stands "
                "still, expected a `motion` of that end: a fixed `pose` can be tilted only\n");
  const std::string no_time =
      "got this of a quasi-static record (its first column is `step`), which has no time\n";
  EXPECT_EQ(Said(WithFaultsOf("steps",
                              "{clock: {scale: 0.1}, sensor: [{low_pass: 0.3}], "
                              "base_motion: {b: {phase: 1, amplitude: 2}}}")),
            kYaml + "40: experiments[3].faults.clock: " + no_time + kYaml +
                "40: experiments[3].faults.sensor[0].low_pass: " + no_time + kYaml +
                "40: experiments[3].faults.base_motion.b.phase: " + no_time);
}

TEST(FaultMistakes, OfTheSetAreThoseThatNoExperimentCanHave) {
  // The pendulum has no axes and the steps no time, but others have.
  EXPECT_EQ(Said(WithSetFaults(kAllFaults)), "");
  EXPECT_EQ(Said(WithSetFaults("faults: {sensor: [{channels: [tipx], scale: 2}]}\n")),
            kYaml +
                "10: faults.sensor[0].channels[0]: got 'tipx', expected the column of a channel: "
                "did you mean 'tip_x'?\n");
}

TEST(FaultMistakes, BelongElsewhere) {
  EXPECT_EQ(Said(Replaced(AllSets(), "  GJ: 0.0090\n", "  GJ: 0.0090\n  faults: {}\n")),
            kYaml +
                "8: cable.faults: got faults of a record, expected them in a measurement set "
                "(measurement.yaml): beside its `cable`, or of one experiment\n");
}

std::string WithUncertain(const std::string& names) {
  return Replaced(AllSets(), "  GJ: 0.0090\n", "  GJ: 0.0090\n  uncertain: [" + names + "]\n");
}

TEST(Faults, CanBeUncertainWhetherOrNotTheyAreThere) {
  const MeasurementSet set =
      Loaded(WithUncertain("EI, faults.clock.scale, 'faults.sensor[0].tilt[1]', "
                           "faults.base_motion.a.bracket.frequency"));
  EXPECT_EQ(set.cable.uncertain.value->at(1).name, "faults.clock.scale");
  EXPECT_EQ(Said(WithUncertain("faults.clock.skale")),
            kYaml +
                "8: cable.uncertain[0]: got 'faults.clock.skale', expected a number of `faults`: "
                "did you mean 'faults.clock.scale'?\n");
  EXPECT_EQ(Said(WithUncertain("'faults.sensor[1].scale'")),
            kYaml +
                "8: cable.uncertain[0]: got 'faults.sensor[1].scale', expected a number of "
                "`faults`: did you mean 'faults.sensor[0].scale'?\n");
  EXPECT_EQ(Said(WithUncertain("D_E")),
            kYaml +
                "8: cable.uncertain[0]: got 'D_E', expected it by its path: "
                "'extensions.clamp_damping.b.torsion'\n");
  SetFolder folder;
  folder
      .Write("measurement.yaml",
             Replaced(std::string(kHead) + kRingdown, "  GJ: 0.0090\n",
                      "  GJ: 0.0090\n  uncertain: [faults.base_motion.b.phase]\n"))
      .Write("ringdown_small.csv", kRingdownCsv);
  EXPECT_EQ(folder.Said(),
            kYaml +
                "8: cable.uncertain[0]: got 'faults.base_motion.b.phase', which no experiment of "
                "the set can show, expected a fault that one of them can have\n");
}

TEST(Faults, AreInTheSpecimensThatAreMade) {
  const MeasurementSet set = Loaded(Replaced(WithSetFaults("faults: {clock: {scale: 0.1}}\n"),
                                             "  eta_GJ: null\n", "  eta_GJ: 1.0e-4\n"));
  Problems problems;
  const Experiment& experiment = set.experiments[0];
  const Specimen specimen = MakeSpecimen(SpecimenKeys(set, experiment), experiment, &problems);
  EXPECT_EQ(problems.ToString(), "");
  EXPECT_EQ(specimen.faults.clock->scale, 0.1);
}

TEST(Faults, AreExplainedInATemplateThatLoads) {
  Problems problems;
  const MeasurementSet set = LoadMeasurementSet(
      std::string(COSSERAT_CABLE_SOURCE_DIR) + "/config/sets/template", &problems);
  EXPECT_EQ(problems.ToString(), "");
  const Faults& faults = *set.cable.faults.value;
  EXPECT_TRUE(faults.clock && faults.sensor.size() == 2 && faults.a);
  Specimen specimen =
      MakeSpecimen(SpecimenKeys(set, set.experiments[0]), set.experiments[0], &problems);
  SimulationOptions options;
  options.elements = 10;
  options.until = 0.02;
  const SimulatedRecord record =
      SimulateExperiment(set.experiments[0], {specimen}, options).front();
  EXPECT_TRUE(record.ok) << record.message;
}

}  // namespace
}  // namespace cosserat_cable
