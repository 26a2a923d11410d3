#include "cosserat_cable/fit/unknowns.h"

#include <algorithm>
#include <cmath>

#include "cosserat_cable/cable/parameters.h"
#include "cosserat_cable/input/number_text.h"
#include "cosserat_cable/measurement/fault_check.h"
#include "start_shapes.h"

namespace cosserat_cable {
namespace {

constexpr double kPi = 3.14159265358979323846;
// No cable's damping is as far from the first guess as this factor, and no stiffness.
constexpr double kFarthest = 1e3, kFarthestStiffness = 30;
// What is sought for from where it hardly shows ends where it does.
constexpr double kFarthestOfEntry = 1e6;

bool HasDisc(const Experiment& experiment) {
  return experiment.b.kind == EndCondition::Kind::kDisc;
}

double TorsionFrequency(const CableKeys& keys, const Experiment& experiment) {
  const double L = keys.length.value.value_or(0.2), GJ = GetParameter("GJ", keys).value_or(0.01);
  const double rhoJ = keys.mass_per_length.value.value_or(0.1) *
                      ShapeOf(keys).value_or(SectionShape{0.01, 0, 0}).polar();
  if (HasDisc(experiment)) return std::sqrt(GJ / (L * (experiment.b.disc.inertia + rhoJ * L / 3)));
  return kPi / (2 * L) * std::sqrt(GJ / rhoJ);
}

/// Where nothing is known of a parameter: what makes a marked difference to this experiment; 0
/// where the key has a value or a default in any case, or the experiment cannot show it.
double TypicalSizeIn(const std::string& name, const CableKeys& keys, const Experiment& experiment) {
  if (name.rfind("eta_EI", 0) == 0) return TypicalSize(name, keys);
  if (name == "eta_GJ")
    return 2 * kTypicalDamping * GetParameter("GJ", keys).value_or(0.01) /
           TorsionFrequency(keys, experiment);
  if (name == kEndDamping) {
    if (!HasDisc(experiment)) return 0;
    return 2 * kTypicalDamping * TorsionFrequency(keys, experiment) * experiment.b.disc.inertia / 2;
  }
  if (IsFault(name) && !CanHaveFault(name, experiment)) return 0;
  return IsOfEntry(name) ? TypicalSize(name, keys) : 0;
}

Unknown::Scaling ScalingOf(const Parameter& parameter) {
  if (!IsOfEntry(parameter.path) || parameter.sign == ParameterSign::kSigned)
    return Unknown::Scaling::kLinear;
  for (const char* unit : {"N m/rad", "N/m", "Hz"})
    if (parameter.unit == unit) return Unknown::Scaling::kReciprocal;
  return parameter.sign == ParameterSign::kPositive && !parameter.neutral
             ? Unknown::Scaling::kLogarithmic
             : Unknown::Scaling::kLinear;
}

/// Of any extension: `s` is a place on the cable.
bool IsArcLength(const Parameter& parameter) {
  return parameter.unit == "m" && parameter.path.size() > 2 &&
         parameter.path.compare(parameter.path.size() - 2, 2, ".s") == 0;
}

}  // namespace

double VariableOf(const Unknown& unknown, double value) {
  const double relative = value / unknown.scale;
  switch (unknown.scaling) {
    case Unknown::Scaling::kReciprocal:
      return 1 / relative;
    case Unknown::Scaling::kLogarithmic:
      return 1 + std::log(relative);
    case Unknown::Scaling::kLinear:
      break;
  }
  return relative;
}

double ValueOf(const Unknown& unknown, double variable) {
  switch (unknown.scaling) {
    case Unknown::Scaling::kReciprocal:
      return unknown.scale / variable;
    case Unknown::Scaling::kLogarithmic:
      return unknown.scale * std::exp(variable - 1);
    case Unknown::Scaling::kLinear:
      break;
  }
  return unknown.scale * variable;
}

double VariableSlope(const Unknown& unknown, double variable) {
  switch (unknown.scaling) {
    case Unknown::Scaling::kReciprocal:
      return -1 / (variable * variable);
    case Unknown::Scaling::kLogarithmic:
      return std::exp(variable - 1);
    case Unknown::Scaling::kLinear:
      break;
  }
  return 1;
}

Unknowns::Unknowns(const MeasurementSet& set, const UnknownOptions& options, Problems* problems)
    : set_(set) {
  for (const Experiment& experiment : set_.experiments)
    keys_.push_back(SpecimenKeys(set_, experiment));
  std::vector<std::string> names = {"EI", "GJ", "eta_EI", "eta_GJ"};
  if (set_.cable.uncertain.value) {
    names.clear();
    for (const UncertainKey& key : *set_.cable.uncertain.value) names.push_back(key.name);
  }
  const bool moves = std::any_of(set_.experiments.begin(), set_.experiments.end(),
                                 [](const Experiment& e) { return !e.quasi_static(); });
  if (moves) AddUnknownDampings(&names);
  const bool disc =
      std::any_of(set_.experiments.begin(), set_.experiments.end(),
                  [](const Experiment& e) { return HasDisc(e) && !e.quasi_static(); });
  const bool twist_damping = std::count(names.begin(), names.end(), "eta_GJ") > 0;
  if (disc && twist_damping && options.end_damping &&
      !std::count(names.begin(), names.end(), kEndDamping))
    names.push_back(kEndDamping);
  for (const std::string& name : names) AddCable(name, problems);
  for (const ParameterScatter& scatter : options.scatter) AddScatter(scatter);

  for (std::size_t e = 0; e < set_.experiments.size(); ++e) {
    const Experiment& experiment = set_.experiments[e];
    for (std::size_t c = 0; c < experiment.channels.size(); ++c) {
      if (!experiment.channels[c].unknown_offset) continue;
      Unknown offset;
      offset.kind = Unknown::Kind::kOffset;
      offset.name = experiment.name + "/" + experiment.channels[c].column + ".offset";
      offset.experiment = static_cast<int>(e);
      offset.index = static_cast<int>(c);
      const auto column = experiment.record.values.col(c);
      offset.scale = std::max(column.maxCoeff() - column.minCoeff(), 1e-12);
      all_.push_back(offset);
    }
    if (options.clamp_sd > 0)
      for (int axis : {0, 1}) {
        Unknown tilt;
        tilt.kind = Unknown::Kind::kTilt;
        tilt.name = experiment.name + "/tilt_a" + std::to_string(axis + 1);
        tilt.unit = "rad";
        tilt.scale = tilt.prior_sd = options.clamp_sd;
        tilt.experiment = static_cast<int>(e);
        tilt.index = axis;
        all_.push_back(tilt);
      }
    if (options.length_sd > 0) {
      Unknown length;
      length.kind = Unknown::Kind::kLength;
      length.name = experiment.name + "/length";
      length.unit = "m";
      length.scale = length.prior_sd = options.length_sd;
      length.experiment = static_cast<int>(e);
      all_.push_back(length);
    }
  }
  if (!problems->empty()) return;
  for (std::size_t e = 0; e < set_.experiments.size(); ++e) {
    shapes_.emplace_back();
    if (set_.experiments[e].start.kind == StartCondition::Kind::kUnknown)
      AddSwing(static_cast<int>(e));
  }
}

/// What the set says to be unknown is looked for, listed or not. Of a pair: as one where nothing
/// tells the two apart.
void Unknowns::AddUnknownDampings(std::vector<std::string>* names) const {
  const auto listed = [&](const std::string& name) {
    return std::count(names->begin(), names->end(), name) > 0;
  };
  const auto unknown = [&](const std::string& name) {
    return IsUnknownParameter(name, set_.cable) ||
           std::any_of(set_.experiments.begin(), set_.experiments.end(),
                       [&](const Experiment& e) { return IsUnknownParameter(name, e.specimen); });
  };
  for (const std::string name : {"eta_GJ", "eta_EA"})
    if (unknown(name) && !listed(name)) names->push_back(name);
  for (const std::string name : {"eta_EI", "eta_GA"}) {
    if (listed(name)) continue;
    const std::string first = name + "1", second = name + "2";
    if (unknown(first) && unknown(second) && !listed(first) && !listed(second)) {
      names->push_back(name);
      continue;
    }
    for (const std::string& one : {first, second})
      if (unknown(one) && !listed(one)) names->push_back(one);
  }
}

void Unknowns::AddCable(const std::string& name, Problems* problems) {
  const std::optional<Parameter> parameter = FindParameter(name);
  if (!parameter) return;  // the set's reader has refused it
  Unknown unknown;
  unknown.name = name;
  unknown.unit = parameter->unit;
  unknown.damping = parameter->damping;
  unknown.sign = parameter->sign;
  unknown.scaling = ScalingOf(*parameter);
  std::optional<double> given = GetParameter(name, set_.cable);
  double typical = 0;
  for (std::size_t e = 0; e < set_.experiments.size(); ++e) {
    const Experiment& experiment = set_.experiments[e];
    if (name == kDiscInertia) {
      if (HasDisc(experiment)) given = experiment.b.disc.inertia;
      continue;
    }
    if (IsFault(name) && !given) given = GetParameter(name, experiment.specimen);
    typical = std::max(typical, TypicalSizeIn(name, keys_[e], experiment));
  }
  if (!given && typical == 0) given = DefaultOf(name);
  const std::optional<double>& neutral = parameter->neutral;
  // What is not there starts where it has no effect, unless it can only go one way from there.
  const bool from_neutral = neutral && std::isfinite(*neutral) &&
                            (parameter->sign == ParameterSign::kSigned || *neutral != 0);
  // So does what may go either way from nothing, of an extension that is not there at all.
  const bool from_zero = !from_neutral && !given && IsOfEntry(name) && !IsFault(name) &&
                         parameter->sign == ParameterSign::kSigned;
  unknown.start_known = given.has_value();
  unknown.start = given && std::isfinite(*given) ? *given
                  : from_neutral                 ? *neutral
                  : from_zero                    ? 0.0
                                                 : typical;
  unknown.scale = from_neutral ? std::max(std::abs(unknown.start - *neutral), typical)
                               : std::max(std::abs(unknown.start), unknown.damping ? typical : 0.0);
  if (parameter->sign != ParameterSign::kPositive && !(unknown.scale > 0)) unknown.scale = typical;
  if (!(unknown.scale > 0)) {
    problems->Add(set_.cable_mark, "got '" + name +
                                       "' as uncertain, but it has no value to start "
                                       "from and no experiment that could show it");
    return;
  }
  const bool entry = IsOfEntry(name);
  const double far = unknown.scale * (entry ? kFarthestOfEntry : kFarthest);
  const double far_stiffness = entry ? kFarthestOfEntry : kFarthestStiffness;
  unknown.upper =
      std::min(parameter->upper,
               parameter->sign == ParameterSign::kPositive ? unknown.scale * far_stiffness : far);
  unknown.lower = std::max(parameter->lower, parameter->sign == ParameterSign::kSigned ? -far
                                             : parameter->sign == ParameterSign::kPositive
                                                 ? unknown.scale / far_stiffness
                                                 : 0.0);
  // Beyond the end of the shortest cable nothing can be simulated.
  if (IsArcLength(*parameter))
    for (const CableKeys& keys : keys_)
      unknown.upper = std::min(unknown.upper, keys.length.value.value_or(unknown.upper));
  if (unknown.scaling != Unknown::Scaling::kLinear)
    unknown.lower = std::max(unknown.lower, unknown.scale / kFarthestOfEntry);
  all_.push_back(unknown);
}

/// A default that follows from others: as complete keys would have it.
std::optional<double> Unknowns::DefaultOf(const std::string& name) const {
  Problems unused;
  CableKeys filled = set_.cable;
  for (const char* damping : {"eta_EI", "eta_GJ"})
    if (!GetParameter(damping, filled)) SetParameter(damping, 0, &filled);
  const CableModel cable = CompleteCable(filled, set_.cable_mark, &unused);
  if (name.rfind("EA", 0) == 0) return cable.EA;
  if (name.rfind("GA", 0) == 0) return cable.GA1;
  if (name.rfind("eta_EA", 0) == 0) return cable.eta_EA;
  if (name.rfind("eta_GA", 0) == 0) return cable.eta_GA1;
  return std::nullopt;
}

void Unknowns::AddScatter(const ParameterScatter& scatter) {
  const int of = Find(scatter.name);
  if (of < 0 || !(scatter.sd > 0)) return;
  for (std::size_t e = 0; e < set_.experiments.size(); ++e) {
    if (!Concerns(of, static_cast<int>(e))) continue;
    Unknown unknown;
    unknown.kind = Unknown::Kind::kScatter;
    unknown.name = set_.experiments[e].name + "/" + scatter.name + ".scatter";
    unknown.unit = all_[of].unit;
    unknown.scale = all_[of].scale;
    unknown.prior_sd = scatter.sd;
    unknown.experiment = static_cast<int>(e);
    unknown.index = of;
    all_.push_back(unknown);
  }
}

void Unknowns::AddSwing(int e) {
  const Experiment& experiment = set_.experiments[e];
  Problems problems;
  const Specimen specimen = MakeSpecimen(e, StartValues(), &problems);
  if (!problems.empty()) return;
  for (StartShape& start : StartShapes(experiment, specimen)) {
    const std::size_t k = shapes_[e].size();
    const double w = std::max(start.shape.w, 1.0);
    shapes_[e].push_back(std::move(start.shape));
    for (const Unknown::Kind kind : {Unknown::Kind::kSwing, Unknown::Kind::kSpeed}) {
      Unknown swing;
      swing.kind = kind;
      swing.name = experiment.name + (kind == Unknown::Kind::kSwing ? "/swing" : "/speed") +
                   std::to_string(k + 1);
      swing.prior_sd = start.size * (kind == Unknown::Kind::kSpeed ? w : 1.0);
      swing.scale = 0.1 * swing.prior_sd;
      swing.experiment = e;
      swing.index = static_cast<int>(k);
      all_.push_back(swing);
    }
  }
}

void Unknowns::ShareShapes(const Unknowns& other, int experiment) {
  for (std::size_t e = 0; e < shapes_.size(); ++e) {
    const std::size_t there = experiment >= 0 ? static_cast<std::size_t>(experiment) : e;
    if (there >= other.shapes_.size() || shapes_[e].size() != other.shapes_[there].size()) continue;
    shapes_[e] = other.shapes_[there];
    for (Unknown& own : all_) {
      const bool swings = own.kind == Unknown::Kind::kSwing || own.kind == Unknown::Kind::kSpeed;
      if (!swings || own.experiment != static_cast<int>(e)) continue;
      const int same = other.Find(own.name);
      if (same < 0) continue;
      own.prior_sd = other.all_[same].prior_sd;
      own.scale = other.all_[same].scale;
    }
  }
}

Eigen::VectorXd Unknowns::StartValues() const {
  Eigen::VectorXd values(size());
  for (int i = 0; i < size(); ++i) values[i] = all_[i].start;
  return values;
}

bool Unknowns::Concerns(int unknown, int e) const {
  const Unknown& u = all_[unknown];
  if (u.kind != Unknown::Kind::kCable) return u.experiment == e;
  const Experiment& experiment = set_.experiments[e];
  if (u.name == kDiscInertia || u.name == kEndDamping)
    return HasDisc(experiment) && !experiment.quasi_static();
  if (IsFault(u.name)) return FaultConcerns(u.name, e);
  if (u.damping && experiment.quasi_static()) return false;
  return !GivesParameter(u.name, experiment.specimen) ||
         IsUnknownParameter(u.name, experiment.specimen);
}

/// A fault that stands somewhere is one of the experiments that have it; one that stands nowhere,
/// of all whose faults are not said otherwise.
bool Unknowns::FaultConcerns(const std::string& name, int e) const {
  if (!CanHaveFault(name, set_.experiments[e])) return false;
  if (GivesParameter(name, keys_[e])) return true;
  const bool stands = std::any_of(keys_.begin(), keys_.end(), [&](const CableKeys& keys) {
    return GivesParameter(name, keys);
  });
  return !stands && !set_.experiments[e].specimen.faults.given();
}

Specimen Unknowns::MakeSpecimen(int e, const Eigen::VectorXd& values, Problems* problems) const {
  return MakeSpecimen(e, values, {}, problems);
}

Specimen Unknowns::MakeSpecimen(int e, const Eigen::VectorXd& values, const Setting& also,
                                Problems* problems) const {
  const Experiment& experiment = set_.experiments[e];
  CableKeys keys = keys_[e];
  double inertia = experiment.b.disc.inertia;
  Eigen::Vector3d tilt = Eigen::Vector3d::Zero();
  for (int i = 0; i < values.size(); ++i) {
    const Unknown& u = all_[i];
    if (!Concerns(i, e)) continue;
    if (u.kind == Unknown::Kind::kTilt) tilt[u.index] += values[i];
    if (u.kind == Unknown::Kind::kLength && keys.length.value) *keys.length.value += values[i];
    if (u.kind == Unknown::Kind::kScatter) {
      const Unknown& of = all_[u.index];
      SetParameter(of.name, std::max(of.lower, values[u.index] + values[i]), &keys);
    }
    if (u.kind != Unknown::Kind::kCable) continue;
    if (u.name == kDiscInertia)
      inertia = values[i];
    else
      SetParameter(u.name, values[i], &keys);
  }
  for (const auto& [name, value] : also.numbers)
    if (!IsFault(name) || CanHaveFault(name, experiment)) SetParameter(name, value, &keys);
  if (!also.channels.empty() && keys.faults.value && !keys.faults.value->sensor.empty())
    keys.faults.value->sensor.back().channels = also.channels;
  if (experiment.quasi_static()) keys = WithoutUnknownDamping(keys);
  Specimen specimen = cosserat_cable::MakeSpecimen(keys, experiment, problems);
  specimen.disc_inertia = inertia;
  specimen.tilt_a = tilt;
  if (e >= static_cast<int>(shapes_.size()) || shapes_[e].empty()) return specimen;

  Swing& swing = specimen.swing;
  const std::size_t nodes = shapes_[e].front().displacement.size();
  for (auto* part :
       {&swing.displacement, &swing.rotation, &swing.velocity, &swing.angular_velocity})
    part->assign(nodes, Eigen::Vector3d::Zero());
  for (int i = 0; i < values.size(); ++i) {
    const Unknown& u = all_[i];
    if (u.experiment != e) continue;
    const bool speed = u.kind == Unknown::Kind::kSpeed;
    if (!speed && u.kind != Unknown::Kind::kSwing) continue;
    const SwingShape& shape = shapes_[e][u.index];
    for (std::size_t n = 0; n < nodes; ++n) {
      (speed ? swing.velocity : swing.displacement)[n] += values[i] * shape.displacement[n];
      (speed ? swing.angular_velocity : swing.rotation)[n] += values[i] * shape.rotation[n];
    }
  }
  return specimen;
}

double Unknowns::OffsetOf(int experiment, int channel, const Eigen::VectorXd& values) const {
  double offset = 0;
  for (int i = 0; i < size(); ++i)
    if (all_[i].kind == Unknown::Kind::kOffset && all_[i].experiment == experiment &&
        all_[i].index == channel)
      offset += values[i];
  return offset;
}

CableKeys Unknowns::FilledKeys(const Eigen::VectorXd& values) const {
  CableKeys keys = set_.cable;
  for (int i = 0; i < size(); ++i) {
    const Unknown& u = all_[i];
    if (u.kind != Unknown::Kind::kCable || u.name == kDiscInertia) continue;
    const bool of_experiments = IsFault(u.name) && !GivesParameter(u.name, keys) &&
                                std::any_of(keys_.begin(), keys_.end(), [&](const CableKeys& of) {
                                  return GivesParameter(u.name, of);
                                });
    if (!of_experiments) SetParameter(u.name, values[i], &keys);
  }
  return keys;
}

MeasurementSet Unknowns::FilledSet(const Eigen::VectorXd& values) const {
  MeasurementSet set = set_;
  set.cable = FilledKeys(values);
  for (int i = 0; i < size(); ++i) {
    const Unknown& u = all_[i];
    if (u.kind != Unknown::Kind::kCable) continue;
    for (std::size_t e = 0; e < set.experiments.size(); ++e) {
      Experiment& experiment = set.experiments[e];
      if (!Concerns(i, static_cast<int>(e))) continue;
      if (u.name == kDiscInertia) experiment.b.disc.inertia = values[i];
      if (IsFault(u.name) && GivesParameter(u.name, experiment.specimen))
        SetParameter(u.name, values[i], &experiment.specimen);
    }
  }
  return set;
}

int Unknowns::Find(const std::string& name) const {
  for (int i = 0; i < size(); ++i)
    if (all_[i].name == name) return i;
  return -1;
}

}  // namespace cosserat_cable
