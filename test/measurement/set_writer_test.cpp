// A set that is written reads back to the same.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "measurement/set_folder.h"

namespace cosserat_cable {
namespace {

void ExpectSame(const Pose& a, const Pose& b) {
  EXPECT_EQ(a.p, b.p);
  EXPECT_EQ(a.q.coeffs(), b.q.coeffs());
}

void ExpectSame(const EndCondition& a, const EndCondition& b) {
  EXPECT_EQ(a.kind, b.kind);
  ExpectSame(a.pose, b.pose);
  EXPECT_EQ(a.translation_free, b.translation_free);
  EXPECT_EQ(a.rotation_free, b.rotation_free);
  EXPECT_EQ(a.roll_unknown, b.roll_unknown);
  EXPECT_EQ(a.disc.inertia, b.disc.inertia);
  EXPECT_EQ(a.disc.mass, b.disc.mass);
  EXPECT_EQ(a.disc.guided, b.disc.guided);
  ASSERT_EQ(a.motion.has_value(), b.motion.has_value());
  if (!a.motion) return;
  EXPECT_EQ(a.motion->file, b.motion->file);
  EXPECT_EQ(a.motion->quasi_static, b.motion->quasi_static);
  EXPECT_EQ(a.motion->t, b.motion->t);
  ASSERT_EQ(a.motion->poses.size(), b.motion->poses.size());
  for (std::size_t i = 0; i < a.motion->poses.size(); ++i)
    ExpectSame(a.motion->poses[i], b.motion->poses[i]);
}

void ExpectSame(const StartCondition& a, const StartCondition& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.held.s, b.held.s);
  EXPECT_EQ(a.held.position_W, b.held.position_W);
  EXPECT_EQ(a.twisted, b.twisted);
  ASSERT_EQ(a.near.has_value(), b.near.has_value());
  if (!a.near) return;
  EXPECT_EQ(a.near->s, b.near->s);
  EXPECT_EQ(a.near->position_W, b.near->position_W);
}

void ExpectSame(const Channel& a, const Channel& b) {
  EXPECT_EQ(a.column, b.column);
  EXPECT_EQ(a.quantity, b.quantity);
  EXPECT_EQ(a.s, b.s);
  EXPECT_EQ(a.clamp, b.clamp);
  EXPECT_EQ(a.axis, b.axis);
  EXPECT_EQ(a.in_frame_a, b.in_frame_a);
  EXPECT_EQ(a.sigma, b.sigma);
  EXPECT_EQ(a.unknown_offset, b.unknown_offset);
}

void ExpectSame(const ExperimentLoad& a, const ExperimentLoad& b) {
  EXPECT_EQ(a.file, b.file);
  EXPECT_EQ(a.quasi_static, b.quasi_static);
  ASSERT_EQ(a.samples.size(), b.samples.size());
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    EXPECT_EQ(a.samples[i].t, b.samples[i].t);
    EXPECT_EQ(a.samples[i].s, b.samples[i].s);
    EXPECT_EQ(a.samples[i].force_W, b.samples[i].force_W);
  }
}

void ExpectSame(const MeasurementSet& a, const MeasurementSet& b) {
  // The keys' text has every number to the last bit; the writer of vehicles' files is tested so.
  EXPECT_EQ(WriteCableKeys(a.cable, ""), WriteCableKeys(b.cable, ""));
  ASSERT_EQ(a.experiments.size(), b.experiments.size());
  for (std::size_t i = 0; i < a.experiments.size(); ++i) {
    const Experiment& first = a.experiments[i];
    const Experiment& second = b.experiments[i];
    EXPECT_EQ(first.name, second.name);
    EXPECT_EQ(first.kind, second.kind);
    EXPECT_EQ(WriteCableKeys(first.specimen, ""), WriteCableKeys(second.specimen, ""));
    EXPECT_EQ(first.gravity_W, second.gravity_W);
    ExpectSame(first.a, second.a);
    ExpectSame(first.b, second.b);
    ExpectSame(first.start, second.start);
    ExpectSame(first.load, second.load);
    ASSERT_EQ(first.channels.size(), second.channels.size());
    for (std::size_t k = 0; k < first.channels.size(); ++k)
      ExpectSame(first.channels[k], second.channels[k]);
    EXPECT_EQ(first.record.file, second.record.file);
    EXPECT_EQ(first.record.quasi_static, second.record.quasi_static);
    EXPECT_EQ(first.record.t, second.record.t);
    EXPECT_EQ(first.record.values, second.record.values);
  }
}

TEST(SetWriter, WritesEverythingThatTheFormatKnows) {
  SetFolder folder, copy;
  WriteAll(&folder, Replaced(AllSets(), "  GJ: 0.0090\n",
                             "  GJ: 0.0090\n"
                             "  EA: 2500\n"
                             "  GA1: 1000\n"
                             "  GA2: 1100.1\n"
                             "  eta_EA: critical\n"
                             "  eta_GA: 0\n"
                             "  masses: [{s: 0.1, mass: 0.002}]\n"
                             "  uncertain: [EI, disc.inertia, 'extensions.maxwell[0].EI']\n"
                             "  elements: 30\n"
                             "  extensions: {maxwell: [{tau: 0.1, EI: 0.001}]}\n"));
  const MeasurementSet set = folder.LoadGood();
  const std::string inside = copy.path() + "/new/one";  // is made
  WriteMeasurementSet(set, inside);
  Problems problems;
  const MeasurementSet read = LoadMeasurementSet(inside, &problems);
  ASSERT_EQ(problems.ToString(), "");
  ExpectSame(set, read);
  EXPECT_EQ(read.cable.elements.value, 30);
  EXPECT_EQ(read.cable.eta_GJ.value->kind, DampingKey::Kind::kUnknown);
  EXPECT_EQ(read.cable.extensions.value->size(), 1u);
  EXPECT_EQ(read.cable.uncertain.value->at(2).name, "extensions.maxwell[0].EI");
}

// Finite doubles of all sizes.
rc::Gen<double> Doubles() {
  return rc::gen::map(rc::gen::pair(rc::gen::arbitrary<double>(), rc::gen::inRange(-300, 300)),
                      [](const std::pair<double, int>& pair) {
                        const double value = std::ldexp(pair.first, pair.second);
                        return std::isfinite(value) ? value : pair.first;
                      });
}

TEST(SetWriter, KeepsEveryBitOfEveryNumber) {
  SetFolder folder;
  WriteAll(&folder, std::string(kHead) + kRingdown);
  const MeasurementSet good = folder.LoadGood();
  constexpr char kSeed[] = "seed=20240611 max_success=50";
  ASSERT_EQ(setenv("RC_PARAMS", kSeed, 1), 0);
  EXPECT_TRUE(rc::check("a record of any numbers", [&] {
    MeasurementSet set = good;
    Experiment& experiment = set.experiments[0];
    const auto values = *rc::gen::container<std::vector<double>>(8, Doubles());
    for (int i = 0; i < 8; ++i) experiment.record.values(i / 2, i % 2) = values[i];
    // Times, too, as far from zero as a record may begin.
    experiment.record.t = {std::clamp(values[0], -1e12, 1e12), 0, 0, 0};
    for (int i = 1; i < 4; ++i)
      experiment.record.t[i] =
          std::nextafter(experiment.record.t[i - 1], std::numeric_limits<double>::max());
    experiment.gravity_W = {values[1], values[2], values[3]};
    experiment.start.held.position_W = {values[4], values[5], values[6]};
    SetFolder copy;
    WriteMeasurementSet(set, copy.path());
    const MeasurementSet read = copy.LoadGood();
    RC_ASSERT(read.experiments[0].record.values == experiment.record.values);
    RC_ASSERT(read.experiments[0].record.t == experiment.record.t);
    RC_ASSERT(read.experiments[0].gravity_W == experiment.gravity_W);
    RC_ASSERT(read.experiments[0].start.held.position_W == experiment.start.held.position_W);
  }));
}

TEST(SetWriter, NamesFilesAfterTheirExperiment) {
  SetFolder folder, copy;
  WriteAll(&folder, std::string(kHead) + kArch);
  MeasurementSet set = folder.LoadGood();
  set.experiments[0].record.file = "";
  set.experiments[0].a.motion->file = "";
  WriteMeasurementSet(set, copy.path());
  const MeasurementSet read = copy.LoadGood();
  EXPECT_EQ(read.experiments[0].record.file, "arch.csv");
  EXPECT_EQ(read.experiments[0].a.motion->file, "arch_a.csv");
  EXPECT_EQ(read.experiments[0].b.motion->file, "shaker.csv");
}

TEST(SetWriter, RefusesWhatWouldNotReadBack) {
  SetFolder folder, copy;
  WriteAll(&folder, std::string(kHead) + kArch);
  const MeasurementSet good = folder.LoadGood();
  MeasurementSet set = good;
  set.experiments[0].record.file = "../arch.csv";
  EXPECT_THROW(WriteMeasurementSet(set, copy.path()), std::runtime_error);
  set = good;
  set.experiments[0].b.motion->poses[0].p.x() = 1;  // shares its file with end a
  EXPECT_THROW(WriteMeasurementSet(set, copy.path()), std::runtime_error);
  set = good;
  set.experiments[0].channels[0].column = "a,b";
  EXPECT_THROW(WriteMeasurementSet(set, copy.path()), std::runtime_error);
  set = good;
  set.experiments[0].record.values(0, 0) = std::nan("");
  EXPECT_THROW(WriteMeasurementSet(set, copy.path()), std::runtime_error);
  EXPECT_TRUE(std::filesystem::is_empty(copy.path())) << "nothing half written";
  EXPECT_THROW(WriteMeasurementSet(good, "/proc/no/such"), std::runtime_error);
}

}  // namespace
}  // namespace cosserat_cable
