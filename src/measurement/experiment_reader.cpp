#include "experiment_reader.h"

#include <algorithm>

#include "channel_reader.h"
#include "cosserat_cable/input/map_reader.h"
#include "end_reader.h"
#include "fault_reader.h"
#include "load_file.h"
#include "specimen_check.h"
#include "start_reader.h"

namespace cosserat_cable {
namespace {

// Names become names of files.
std::string ReadName(const YamlValue& value) {
  const std::optional<std::string> name = value.Text("a name");
  if (!name) return "";
  const bool strange = std::any_of(name->begin(), name->end(), [](char c) {
    return c == '/' || c == '\\' || static_cast<unsigned char>(c) < ' ';
  });
  if (strange || *name == "." || *name == "..")
    value.ReportUnexpected("a name that can be a file's, without slashes");
  return *name;
}

CableKeys ReadSpecimen(const YamlValue& value, Problems* problems) {
  MapReader map(value, "a map of a cable's keys");
  CableKeys keys = ReadCableKeys(&map);
  RefuseVehicleKeys(keys, problems);
  if (keys.uncertain.given()) {
    problems->Add(keys.uncertain.mark,
                  "got this of one specimen, expected it of the set's `cable`: what is adjusted "
                  "is common to all experiments");
  }
  return keys;
}

// What must hold between the keys of one experiment.
class ExperimentCheck {
 public:
  ExperimentCheck(const Experiment& experiment, Problems* problems)
      : experiment_(experiment), problems_(problems) {}

  void Run() {
    CheckStart();
    for (const Channel& channel : experiment_.channels) CheckChannel(channel);
    CheckTimes(experiment_.a.motion, experiment_.a.mark, "motion");
    CheckTimes(experiment_.b.motion, experiment_.b.mark, "motion");
  }

 private:
  void CheckStart() {
    using Kind = StartCondition::Kind;
    const StartCondition& start = experiment_.start;
    if (start.kind == Kind::kTwisted && !TurnsAboutAxis(experiment_.b)) {
      Add(start.mark, "twisted",
          "got this where end b is held about the axis, expected a disc or an end b that may turn");
    }
    if (start.kind != Kind::kRest && experiment_.quasi_static()) {
      problems_->Add(start.mark,
                     "got another start than rest of a quasi-static record (its first column is "
                     "`step`), expected {rest: true}");
    }
  }

  void CheckChannel(const Channel& channel) {
    const std::string quantity = ToString(channel.quantity);
    const bool moving = channel.quantity == Quantity::kVelocity ||
                        channel.quantity == Quantity::kAcceleration ||
                        channel.quantity == Quantity::kRate;
    if (moving && experiment_.quasi_static()) {
      Add(channel.mark, "quantity",
          "got '" + quantity + "' in a quasi-static record, where nothing moves");
    }
    const bool at_clamp =
        channel.quantity == Quantity::kForce || channel.quantity == Quantity::kMoment;
    const bool clamped = experiment_.b.kind == EndCondition::Kind::kClamp;
    if (at_clamp && channel.clamp == ClampSide::kB && !clamped)
      Add(channel.mark, "clamp", "got 'b', expected an end that a clamp holds");
  }

  // Files of one experiment have times, or all have steps.
  void CheckTimes(const std::optional<ClampMotion>& motion, const SourceMark& mark,
                  const std::string& key) {
    const bool known = motion && !motion->t.empty() && !experiment_.record.t.empty();
    if (!known || motion->quasi_static == experiment_.quasi_static()) return;
    const char* const column = experiment_.quasi_static() ? "step" : "t";
    Add(mark, key,
        "got '" + motion->file + "' with another first column than the record '" +
            experiment_.record.file + "', expected `" + column + "`");
  }

  void Add(const SourceMark& mark, const std::string& key, const std::string& message) {
    problems_->Add({mark.file, mark.line, mark.key + "." + key}, message);
  }

  const Experiment& experiment_;
  Problems* problems_;
};

void CheckLoadTimes(const Experiment& experiment, const YamlValue& load) {
  const ExperimentLoad& read = experiment.load;
  if (read.samples.empty() || read.file.empty() || experiment.record.t.empty()) return;
  if (read.quasi_static == experiment.quasi_static()) return;
  load.Report("got '" + read.file + "' with another first column than the record '" +
              experiment.record.file + "', expected `" +
              (experiment.quasi_static() ? "step" : "t") + "`");
}

}  // namespace

Experiment ReadExperiment(const YamlValue& value, const MeasurementSet& set, Problems* problems) {
  MapReader map(value, "a map of an experiment's keys");
  Experiment experiment;
  experiment.mark = value.mark();
  experiment.name = ReadName(map.Required("name"));
  const YamlValue kind = map.Optional("kind");
  const YamlValue specimen = map.Optional("specimen");
  const YamlValue gravity = map.Optional("gravity");
  const YamlValue a = map.Required("a");
  const YamlValue b = map.Required("b");
  const YamlValue start = map.Required("start");
  const YamlValue load = map.Optional("load");
  const YamlValue faults = map.Optional("faults");
  const YamlValue record = map.Required("record");
  const YamlValue channels = map.Required("channels");
  if (!map.ok()) return experiment;

  if (kind.given()) experiment.kind = kind.Text("a label").value_or("");
  experiment.specimen = ReadSpecimen(specimen, problems);
  experiment.specimen.faults = ReadFaults(faults);
  CableKeys cable = experiment.specimen;
  cable.FillFrom(set.cable);
  CheckSpecimen(cable, set.cable_mark, problems);
  const std::optional<double> length = cable.length.value;
  if (gravity.given()) {
    experiment.gravity_W = gravity.Vector3(NumberSpec::Any("m/s^2")).value_or(experiment.gravity_W);
  }
  experiment.a = ReadEnd(set.folder, a, ClampSide::kA, problems);
  experiment.b = ReadEnd(set.folder, b, ClampSide::kB, problems);
  experiment.start = ReadStart(start, length);
  experiment.load = ReadLoad(set.folder, load, length, problems);
  const std::vector<ChannelEntry> entries = ReadChannels(channels, length);
  for (const ChannelEntry& entry : entries) experiment.channels.push_back(entry.channel);
  experiment.record = ReadRecord(set.folder, record, entries, problems);
  ExperimentCheck(experiment, problems).Run();
  CheckLoadTimes(experiment, load);
  return experiment;
}

}  // namespace cosserat_cable
