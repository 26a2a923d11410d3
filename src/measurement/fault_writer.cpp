#include <cmath>

#include "cosserat_cable/input/number_text.h"
#include "fault_reader.h"

namespace cosserat_cable {
namespace {

std::string Quoted(const std::string& text) {
  std::string quoted;
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return '"' + quoted + '"';
}

// A map on one line, key by key.
class Flow {
 public:
  void Add(const std::string& key, const std::string& value) {
    text_ += (text_.empty() ? "" : ", ") + key + ": " + value;
  }
  void Add(const std::string& key, double value) { Add(key, FormatNumber(value)); }
  void Add(const std::string& key, const Eigen::Vector3d& v) {
    Add(key,
        "[" + FormatNumber(v[0]) + ", " + FormatNumber(v[1]) + ", " + FormatNumber(v[2]) + "]");
  }
  bool empty() const { return text_.empty(); }
  std::string text() const { return "{" + text_ + "}"; }

 private:
  std::string text_;
};

// What has no effect is left out: it may be what the experiment cannot have.
std::string Text(const SensorFault& sensor) {
  Flow flow;
  if (!sensor.channels.empty()) {
    std::string list;
    for (const std::string& name : sensor.channels)
      list += (list.empty() ? "" : ", ") + Quoted(name);
    flow.Add("channels", "[" + list + "]");
  }
  flow.Add("scale", sensor.scale);
  if (!sensor.tilt.isZero(0)) flow.Add("tilt", sensor.tilt);
  if (sensor.low_pass > 0) flow.Add("low_pass", sensor.low_pass);
  return flow.text();
}

std::string Text(const ClampMotionFault& clamp) {
  Flow flow;
  if (clamp.amplitude != 1) flow.Add("amplitude", clamp.amplitude);
  if (clamp.phase != 0) flow.Add("phase", clamp.phase);
  if (clamp.has_bracket()) {
    Flow bracket;
    bracket.Add("frequency", clamp.bracket_frequency);
    bracket.Add("damping", clamp.bracket_damping);
    flow.Add("bracket", bracket.text());
  }
  if (!clamp.tilt.isZero(0) || flow.empty()) flow.Add("tilt", clamp.tilt);
  return flow.text();
}

}  // namespace

std::string WriteFaults(const CableKey<Faults>& key, const std::string& indent) {
  if (!key.value) return "";
  const Faults& faults = *key.value;
  std::string text;
  const auto line = [&](const std::string& content) { text += indent + "  " + content + "\n"; };
  if (faults.clock) {
    Flow clock;
    clock.Add("scale", faults.clock->scale);
    clock.Add("delay", faults.clock->delay);
    line("clock: " + clock.text());
  }
  if (!faults.sensor.empty()) line("sensor:");
  for (const SensorFault& sensor : faults.sensor) line("  - " + Text(sensor));
  if (faults.a || faults.b) line("base_motion:");
  if (faults.a) line("  a: " + Text(*faults.a));
  if (faults.b) line("  b: " + Text(*faults.b));
  return indent + "faults:" + (text.empty() ? " {}\n" : "\n" + text);
}

}  // namespace cosserat_cable
