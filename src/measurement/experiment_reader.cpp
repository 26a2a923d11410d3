#include "experiment_reader.h"

#include <algorithm>

#include "channel_reader.h"
#include "cosserat_cable/input/map_reader.h"
#include "cosserat_cable/input/number_text.h"
#include "end_reader.h"
#include "fault_reader.h"
#include "load_file.h"
#include "specimen_check.h"
#include "start_reader.h"

namespace cosserat_cable {
namespace {

// Half a day. Longer ones are quasi-static, or have the times of two clocks; a thousand steps in
// each second would fill the memory [s].
constexpr double kLongest = 5e4;

/// When the samples of a file are; nothing where they have steps, or there is one time only, which
/// holds always.
struct Span {
  std::string file;
  double begin = 0, end = 0;  // [s]
  std::string Text() const {
    return "from " + FormatRounded(begin, 10) + " to " + FormatRounded(end, 10) + " s";
  }
};

std::optional<Span> SpanOf(const std::string& file, bool quasi_static,
                           const std::vector<double>& t) {
  if (quasi_static || t.empty() || !(t.back() > t.front())) return {};
  return Span{file, t.front(), t.back()};
}

std::optional<Span> SpanOf(const ExperimentLoad& load) {
  std::vector<double> t;
  if (!load.samples.empty()) t = {load.samples.front().t, load.samples.back().t};
  return SpanOf(load.file, load.quasi_static || load.file.empty(), t);
}

/// What is wrong with the times of a file beside the record's; empty where nothing is.
std::string ClockProblem(const Span& of, const Span& record) {
  if (of.end - of.begin > kLongest)
    return "got '" + of.file + "' with times " + of.Text() + ", expected at most " +
           FormatNumber(kLongest) + " s";
  if (of.end >= record.begin && of.begin <= record.end) return "";
  return "got '" + of.file + "' with times " + of.Text() + ", expected them within the record's '" +
         record.file + "', " + record.Text() + ": where these are two clocks, take " +
         FormatRounded(record.begin - of.begin, 10) +
         " s off the record's times, so that both begin together, or as much less as one began "
         "later";
}

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
    CheckClocks();
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

  // Outside of its samples a clamp stands and a load is constant: nothing else would show it.
  void CheckClocks() {
    const Record& record = experiment_.record;
    const std::optional<Span> recorded = SpanOf(record.file, record.quasi_static, record.t);
    if (!recorded) return;
    bool good = true;
    const auto check = [&](const std::optional<Span>& span, const SourceMark& mark,
                           const std::string& key) {
      const std::string problem = span ? ClockProblem(*span, *recorded) : "";
      if (problem.empty()) return;
      Add(mark, key, problem);
      good = false;
    };
    for (const EndCondition* end : {&experiment_.a, &experiment_.b})
      if (end->motion)
        check(SpanOf(end->motion->file, end->motion->quasi_static, end->motion->t), end->mark,
              "motion");
    check(SpanOf(experiment_.load), experiment_.mark, "load");
    const double begin = std::min(recorded->begin, experiment_.start_time());
    if (good && recorded->end - begin > kLongest)
      Add(experiment_.mark, "record",
          "got times up to " + FormatRounded(recorded->end, 10) + " s after a start at " +
              FormatRounded(begin, 10) + " s, expected at most " + FormatNumber(kLongest) +
              " s: are they in ms? A test that is slow has a first column `step`");
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
