// The numbers of faults by their paths.
#include <algorithm>

#include "cosserat_cable/cable/fault_specs.h"
#include "parameter_spec.h"

namespace cosserat_cable {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// One number of an entry of type T.
template <class T>
struct Field {
  const char* path;
  NumberSpec spec;
  double neutral;
  double& (*number)(T& fault);
};

const std::vector<Field<ClockFault>>& ClockFields() {
  static const std::vector<Field<ClockFault>> fields = {
      {"scale", ClockScaleSpec(), 0, [](ClockFault& f) -> double& { return f.scale; }},
      {"delay", ClockDelaySpec(), 0, [](ClockFault& f) -> double& { return f.delay; }}};
  return fields;
}

const std::vector<Field<SensorFault>>& SensorFields() {
  using F = SensorFault;
  static const std::vector<Field<F>> fields = {
      {"scale", SensorScaleSpec(), 1, [](F& f) -> double& { return f.scale; }},
      {"tilt[0]", TiltSpec(), 0, [](F& f) -> double& { return f.tilt[0]; }},
      {"tilt[1]", TiltSpec(), 0, [](F& f) -> double& { return f.tilt[1]; }},
      {"tilt[2]", TiltSpec(), 0, [](F& f) -> double& { return f.tilt[2]; }},
      {"low_pass", TimeConstantSpec(), 0, [](F& f) -> double& { return f.low_pass; }}};
  return fields;
}

const std::vector<Field<ClampMotionFault>>& ClampFields() {
  using F = ClampMotionFault;
  static const std::vector<Field<F>> fields = {
      {"amplitude", AmplitudeSpec(), 1, [](F& f) -> double& { return f.amplitude; }},
      {"phase", PhaseSpec(), 0, [](F& f) -> double& { return f.phase; }},
      {"bracket.frequency", FrequencySpec(), kInfinity,
       [](F& f) -> double& { return f.bracket_frequency; }},
      {"bracket.damping", BracketDampingSpec(), F().bracket_damping,
       [](F& f) -> double& { return f.bracket_damping; }},
      {"tilt[0]", TiltSpec(), 0, [](F& f) -> double& { return f.tilt[0]; }},
      {"tilt[1]", TiltSpec(), 0, [](F& f) -> double& { return f.tilt[1]; }},
      {"tilt[2]", TiltSpec(), 0, [](F& f) -> double& { return f.tilt[2]; }}};
  return fields;
}

// Takes `begin` from the front of a path.
bool Take(const std::string& begin, std::string* path) {
  if (path->rfind(begin, 0) != 0) return false;
  path->erase(0, begin.size());
  return true;
}

// Calls `act(fields, entry, rest)` for the entry that the path is of: `entry(faults, make)` finds
// it, and makes it where it is to, or is null; `rest` is the path in it.
template <class Act>
void WithEntry(const std::string& path, const Act& act) {
  const auto in = [](auto* entry, bool make) {
    if (!*entry && make) entry->emplace();
    return *entry ? &**entry : nullptr;
  };
  const auto clock = [&](Faults* all, bool make) { return in(&all->clock, make); };
  const auto a = [&](Faults* all, bool make) { return in(&all->a, make); };
  const auto b = [&](Faults* all, bool make) { return in(&all->b, make); };
  std::string rest = path;
  if (!Take(FaultPrefix(), &rest)) return;
  if (Take("clock.", &rest)) return act(ClockFields(), clock, rest);
  if (Take("base_motion.a.", &rest)) return act(ClampFields(), a, rest);
  if (Take("base_motion.b.", &rest)) return act(ClampFields(), b, rest);
  if (!Take("sensor", &rest)) return;
  const std::optional<std::size_t> index = TakeIndex(&rest);
  if (!index || !Take(".", &rest)) return;
  const auto sensor = [&](Faults* all, bool make) -> SensorFault* {
    if (*index == all->sensor.size() && make) all->sensor.emplace_back();
    return *index < all->sensor.size() ? &all->sensor[*index] : nullptr;
  };
  act(SensorFields(), sensor, rest);
}

double* Number(const std::string& path, bool make, Faults* faults) {
  double* number = nullptr;
  WithEntry(path, [&](const auto& fields, const auto& entry, const std::string& rest) {
    for (const auto& field : fields) {
      if (rest != field.path) continue;
      if (auto* found = entry(faults, make)) number = &field.number(*found);
    }
  });
  return number;
}

}  // namespace

const std::string& FaultPrefix() {
  static const std::string prefix = "faults.";
  return prefix;
}

std::vector<std::string> FaultPaths(const CableKeys& keys) {
  std::vector<std::string> paths;
  const auto add = [&](const std::string& entry, const auto& fields) {
    for (const auto& field : fields) paths.push_back(FaultPrefix() + entry + "." + field.path);
  };
  const std::size_t sensors = keys.faults.value ? keys.faults.value->sensor.size() : 0;
  add("clock", ClockFields());
  for (std::size_t i = 0; i < std::max<std::size_t>(1, sensors); ++i)
    add("sensor[" + std::to_string(i) + "]", SensorFields());
  add("base_motion.a", ClampFields());
  add("base_motion.b", ClampFields());
  return paths;
}

std::optional<Parameter> FindFaultParameter(const std::string& path) {
  std::optional<Parameter> found;
  WithEntry(path, [&](const auto& fields, const auto&, const std::string& rest) {
    for (const auto& field : fields) {
      if (rest != field.path) continue;
      found = MakeParameter(path, field.spec.unit(), field.spec);
      // A damping ratio alone does nothing, whatever it is.
      if (rest != "bracket.damping") found->neutral = field.neutral;
    }
  });
  return found;
}

bool CanMakeFault(const std::string& path, const CableKeys& keys) {
  CableKeys copy = keys;
  return MakeFaultNumber(path, &copy) != nullptr;
}

double* FaultNumber(const std::string& path, CableKeys* keys) {
  if (!keys->faults.value) return nullptr;
  return Number(path, false, &*keys->faults.value);
}

double* MakeFaultNumber(const std::string& path, CableKeys* keys) {
  if (!FindFaultParameter(path)) return nullptr;
  Faults faults = keys->faults.value.value_or(Faults());
  if (!Number(path, true, &faults)) return nullptr;
  keys->faults.value = faults;
  MarkAsSet(&keys->faults.mark, "faults");
  return Number(path, true, &*keys->faults.value);
}

}  // namespace cosserat_cable
