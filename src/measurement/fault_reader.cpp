#include "fault_reader.h"

#include <initializer_list>

#include "cosserat_cable/cable/fault_specs.h"
#include "cosserat_cable/input/map_reader.h"

namespace cosserat_cable {
namespace {

using Marks = std::map<std::string, SourceMark>;

// An entry's numbers: those that are given, with their marks.
class EntryReader {
 public:
  EntryReader(const YamlValue& value, const std::string& shape)
      : value_(value), map_(value, shape) {}

  void Number(const std::string& key, const NumberSpec& spec, double* number) {
    const YamlValue value = map_.Optional(key);
    Note(key, value);
    *number = value.Number(spec).value_or(*number);
  }
  void Tilt(Eigen::Vector3d* tilt) {
    const YamlValue value = map_.Optional("tilt");
    Note("tilt", value);
    *tilt = value.Vector3(TiltSpec()).value_or(*tilt);
  }
  YamlValue Optional(const std::string& key) {
    const YamlValue value = map_.Optional(key);
    Note(key, value);
    return value;
  }
  // To be called last.
  Marks Finish(const std::string& expected) {
    if (map_.ok() && marks_.empty()) value_.Report("got nothing that acts, expected " + expected);
    return marks_;
  }
  MapReader* map() { return &map_; }

 private:
  void Note(const std::string& key, const YamlValue& value) {
    if (value.given()) marks_[key] = value.mark();
  }

  YamlValue value_;
  MapReader map_;
  Marks marks_;
};

ClockFault ReadClock(const YamlValue& value) {
  ClockFault clock;
  clock.mark = value.mark();
  EntryReader entry(value, "a clock {scale: ..., delay: ...}");
  entry.Number("scale", ClockScaleSpec(), &clock.scale);
  entry.Number("delay", ClockDelaySpec(), &clock.delay);
  entry.Finish("at least one of scale, delay");
  return clock;
}

SensorFault ReadSensor(const YamlValue& value) {
  SensorFault sensor;
  sensor.mark = value.mark();
  EntryReader entry(value, "a sensor {channels: [...], scale: ..., tilt: [...], low_pass: ...}");
  const YamlValue channels = entry.map()->Optional("channels");
  const std::string expected = "a list of columns of the record";
  const std::vector<YamlValue> items = channels.Items(expected);
  for (const YamlValue& item : items) {
    const std::optional<std::string> name = item.Text("the name of a column");
    if (!name) continue;
    sensor.channels.push_back(*name);
    sensor.channel_marks.push_back(item.mark());
  }
  if (channels.IsList() && items.empty()) channels.ReportUnexpected(expected);
  entry.Number("scale", SensorScaleSpec(), &sensor.scale);
  entry.Tilt(&sensor.tilt);
  entry.Number("low_pass", TimeConstantSpec(), &sensor.low_pass);
  sensor.marks = entry.Finish("at least one of scale, tilt, low_pass");
  return sensor;
}

ClampMotionFault ReadClampMotion(const YamlValue& value) {
  ClampMotionFault clamp;
  clamp.mark = value.mark();
  EntryReader entry(value,
                    "a clamp {amplitude: ..., phase: ..., bracket: {frequency: ..., damping: ...}, "
                    "tilt: [...]}");
  entry.Number("amplitude", AmplitudeSpec(), &clamp.amplitude);
  entry.Number("phase", PhaseSpec(), &clamp.phase);
  entry.Tilt(&clamp.tilt);
  const YamlValue bracket = entry.Optional("bracket");
  if (bracket.given()) {
    MapReader map(bracket, "a bracket {frequency: ..., damping: ...}");
    const YamlValue frequency = map.Required("frequency"), damping = map.Required("damping");
    clamp.bracket_frequency = frequency.Number(FrequencySpec()).value_or(clamp.bracket_frequency);
    clamp.bracket_damping = damping.Number(BracketDampingSpec()).value_or(clamp.bracket_damping);
  }
  clamp.marks = entry.Finish("at least one of amplitude, phase, bracket, tilt");
  return clamp;
}

}  // namespace

CableKey<Faults> ReadFaults(const YamlValue& value) {
  if (!value.given()) return {};
  Faults faults;
  if (value.IsEmpty()) return {faults, value.mark()};
  MapReader map(value, "a map of faults: clock, sensor, base_motion");
  const YamlValue clock = map.Optional("clock");
  const YamlValue sensor = map.Optional("sensor");
  const YamlValue base_motion = map.Optional("base_motion");
  if (clock.given()) faults.clock = ReadClock(clock);
  const std::string expected = "a list of groups of channels";
  const std::vector<YamlValue> items = sensor.Items(expected);
  for (const YamlValue& item : items) faults.sensor.push_back(ReadSensor(item));
  if (sensor.IsList() && items.empty()) sensor.ReportUnexpected(expected);
  if (base_motion.given()) {
    MapReader clamps(base_motion, "clamps {a: {...}, b: {...}}");
    const YamlValue a = clamps.Optional("a"), b = clamps.Optional("b");
    if (a.given()) faults.a = ReadClampMotion(a);
    if (b.given()) faults.b = ReadClampMotion(b);
    if (clamps.ok() && !a.given() && !b.given())
      base_motion.Report("got nothing that acts, expected at least one of a, b");
  }
  return {faults, value.mark()};
}

}  // namespace cosserat_cable
