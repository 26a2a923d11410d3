#include <algorithm>
#include <array>
#include <cmath>

#include "cosserat_cable/cable/cable_key_specs.h"
#include "cosserat_cable/cable/cable_keys.h"
#include "cosserat_cable/cable/contact_stiffness.h"
#include "cosserat_cable/input/number_text.h"
#include "extensions.h"
#include "parameter_spec.h"

namespace cosserat_cable {
namespace {

constexpr double kPi = 3.14159265358979323846;
// [kg/m^3] Ten times the densest metals: only a slip of units (g/m) is beyond.
constexpr double kDensest = 2e5;
// [Pa] Four times diamond: only a slip of units (N mm^2) is beyond.
constexpr double kStiffest = 5e12;

using Kind = DampingKey::Kind;

bool IsUnknown(const DampingKey& damping) { return damping.kind == Kind::kUnknown; }
bool IsUnknown(const std::array<DampingKey, 2>& pair) {
  return IsUnknown(pair[0]) || IsUnknown(pair[1]);
}

double ValueOf(const DampingKey& damping, double critical) {
  return damping.kind == Kind::kCritical ? critical : damping.value;
}

// Notes the problems of one cable, and whether there were any.
class Completion {
 public:
  Completion(const SourceMark& cable, Problems* problems) : cable_(cable), problems_(problems) {}

  bool ok() const { return ok_; }

  void Report(const SourceMark& where, const std::string& message) {
    problems_->Add(where, message);
    ok_ = false;
  }

  template <typename T>
  void Require(const CableKey<T>& key, const std::string& name, const std::string& expected) {
    if (!key.given()) {
      Report({cable_.file, cable_.line, cable_.key + "." + name}, "missing, expected " + expected);
    } else if (!key.value) {
      ok_ = false;  // reported when it was read
    }
  }

  template <typename T>
  void RequireKnown(const CableKey<T>& damping) {
    if (damping.given() && !damping.value) ok_ = false;
    if (!damping.value || !IsUnknown(*damping.value)) return;
    Report(damping.mark, "got nothing (unknown), expected a number: a simulation needs one");
  }

  // Reports a value that another one makes impossible. `why` follows the bound.
  void Bound(double value, double most, const SourceMark& mark, const std::string& why) {
    if (value <= most) return;
    Report(mark, "got " + FormatNumber(value) + ", expected at most " + FormatRounded(most) + why);
  }

 private:
  SourceMark cable_;
  Problems* problems_;
  bool ok_ = true;
};

void CheckPresence(const CableKeys& keys, Completion* check) {
  check->Require(keys.length, "length", LengthSpec().Expected());
  if (keys.width.given() || keys.height.given()) {
    check->Require(keys.width, "width", DiameterSpec().Expected());
    check->Require(keys.height, "height", DiameterSpec().Expected());
  } else {
    check->Require(keys.diameter, "diameter", DiameterSpec().Expected() + ", or width and height");
  }
  check->Require(keys.mass_per_length, "mass_per_length", MassPerLengthSpec().Expected());
  check->Require(keys.EI, "EI", BendingStiffnessSpec().Expected() + ", or EI1 and EI2");
  check->Require(keys.GJ, "GJ", BendingStiffnessSpec().Expected());
  check->Require(keys.eta_EI, "eta_EI",
                 BendingDampingSpec().Expected() + ", or eta_EI1 and eta_EI2");
  check->RequireKnown(keys.eta_EI);
  check->RequireKnown(keys.eta_GJ);
  check->RequireKnown(keys.eta_EA);
  check->RequireKnown(keys.eta_GA);
}

void CheckAlongLength(const CableKeys& keys, Completion* check) {
  if (!keys.length.value) return;
  const double length = *keys.length.value;
  for (const CableKey<double>* side : {&keys.diameter, &keys.width, &keys.height})
    if (side->value) check->Bound(*side->value, length / 2, side->mark, " [m], half the length");
  if (keys.apex_s.value) {
    check->Bound(*keys.apex_s.value, length, keys.apex_s.mark, " [m], the length");
  }
  if (!keys.masses.value) return;
  for (const LumpedMassKey& entry : *keys.masses.value) {
    check->Bound(entry.mass.s, length, entry.s_mark, " [m], the length");
  }
}

void CheckMaterial(const CableKeys& keys, Completion* check) {
  const std::optional<SectionShape> shape = ShapeOf(keys);
  if (!shape) return;
  const double area = shape->area();
  if (keys.mass_per_length.value) {
    check->Bound(*keys.mass_per_length.value, kDensest * area, keys.mass_per_length.mark,
                 " [kg/m], ten times a bar of the densest metal: is it in g/m?");
  }
  const std::string why = " [N m^2], four times a bar of diamond: is it in N mm^2?";
  const std::array<double, 2> stiffest = {kStiffest * area * shape->gyration1(),
                                          kStiffest * area * shape->gyration2()};
  if (keys.EI.value) {
    const auto& [EI1, EI2] = *keys.EI.value;
    // A strip has one that no round bar has.
    const std::string either =
        shape->flat() || EI1 == EI2 ? why : why + " Is the section flat (width and height)?";
    check->Bound(EI1, stiffest[0], keys.EI.mark, either);
    if (EI1 != EI2 || (shape->flat() && EI1 <= stiffest[0]))
      check->Bound(EI2, stiffest[1], keys.EI.second.line > 0 ? keys.EI.second : keys.EI.mark,
                   either);
  }
  // No section is stiffer in torsion than by its polar moment, with half the modulus.
  if (keys.GJ.value)
    check->Bound(*keys.GJ.value, 0.5 * (stiffest[0] + stiffest[1]), keys.GJ.mark, why);
}

void FillStiffness(const CableKeys& keys, CableModel* model) {
  model->EI1 = (*keys.EI.value)[0];
  model->EI2 = (*keys.EI.value)[1];
  model->GJ = *keys.GJ.value;
  const double d = model->diameter, w = model->width, h = model->height;
  const double by_bending = model->flat()
                                ? 12 * std::min(model->EI1 / (h * h), model->EI2 / (w * w))
                                : 16 * std::min(model->EI1, model->EI2) / (d * d);
  model->EA = keys.EA.value.value_or(by_bending);
  const double GA = model->EA / 3;
  const std::array<double, 2> shear = keys.GA.value.value_or(std::array<double, 2>{GA, GA});
  model->GA1 = shear[0];
  model->GA2 = shear[1];
}

// Eq. (10) of the source paper where the file says `critical` or nothing.
void FillDamping(const CableKeys& keys, CableModel* model) {
  const DampingKey critical{Kind::kCritical, 0};
  const double slowest = 4 * model->length / kPi;
  model->eta_EI1 = (*keys.eta_EI.value)[0].value;
  model->eta_EI2 = (*keys.eta_EI.value)[1].value;
  model->eta_GJ =
      ValueOf(keys.eta_GJ.value.value_or(critical), slowest * std::sqrt(model->rhoJ() * model->GJ));
  model->eta_EA = ValueOf(keys.eta_EA.value.value_or(critical),
                          slowest * std::sqrt(model->mass_per_length * model->EA));
  const std::array<DampingKey, 2> shear =
      keys.eta_GA.value.value_or(std::array<DampingKey, 2>{critical, critical});
  model->eta_GA1 = ValueOf(shear[0], 2 * std::sqrt(model->rhoI2() * model->GA1));
  model->eta_GA2 = ValueOf(shear[1], 2 * std::sqrt(model->rhoI1() * model->GA2));
}

void FillAvoid(const CableKeys& keys, CableModel* model) {
  if (!keys.avoid.value) return;
  for (const LinkKey& link : *keys.avoid.value) {
    model->avoid.push_back(link.name);
    if (link.use_visual.value_or(keys.use_visual.value.value_or(false)))
      model->avoid_visual.insert(link.name);
  }
}

void FillContact(const CableKeys& keys, CableModel* model) {
  const ContactKey key = keys.contact.value.value_or(ContactKey());
  model->contact.stiffness = key.stiffness.value_or(DefaultContactStiffness(*model));
  model->contact.smoothing = key.smoothing;
  model->contact.damping = key.damping;
}

void FillExtensions(const CableKeys& keys, CableModel* model) {
  if (!keys.extensions.value) return;
  for (const ExtensionKey& key : *keys.extensions.value) model->extensions.push_back(key.extension);
}

bool HasEntry(const CableModel& model, const std::string& path) {
  return std::any_of(model.extensions.begin(), model.extensions.end(),
                     [&](const CableExtension& extension) {
                       const std::string begin = ExtensionPrefix() + extension.name;
                       const char next = path.size() > begin.size() ? path[begin.size()] : ' ';
                       return path.rfind(begin, 0) == 0 && (next == '.' || next == '[');
                     });
}

/// Whether a search can make the entry of this number by itself, and a cable that may have it.
bool CanBeMade(const std::string& path, const Parameter& parameter, const CableKeys& keys) {
  std::vector<std::string> named;
  for (const UncertainKey& one : *keys.uncertain.value) named.push_back(one.name);
  if (!parameter.neutral && !CanBegin(path, named)) return false;
  CableKeys made = keys;
  const std::vector<double*> numbers = MakeExtensionNumbers(path, &made);
  for (double* number : numbers) *number = TypicalSize(path, keys);
  Problems found;
  if (!parameter.neutral) CheckExtensions(made, &found);
  return !numbers.empty() && found.empty();
}

// An extension that the cable does not have may be named where it has no effect at some value: that
// is where it starts from; or where all that it must have is named with it, and a size is enough to
// begin with.
void FillUncertain(const CableKeys& keys, CableModel* model, Problems* problems) {
  if (!keys.uncertain.value) return;
  const std::vector<std::string> numbers = ExtensionPaths(model->extensions);
  for (const UncertainKey& key : *keys.uncertain.value) {
    if (key.name.rfind(FaultPrefix(), 0) == 0) continue;  // of the record
    model->uncertain.push_back(key.name);
    if (key.name.rfind(ExtensionPrefix(), 0) != 0) continue;
    if (std::find(numbers.begin(), numbers.end(), key.name) != numbers.end()) continue;
    const std::optional<Parameter> known = FindParameter(key.name);
    if (known && !HasEntry(*model, key.name) && CanBeMade(key.name, *known, keys)) continue;
    if (known && !HasEntry(*model, key.name)) {
      problems->Add(key.mark, "got '" + key.name +
                                  "' of an extension that the cable does not have, expected it "
                                  "under `extensions`: its numbers are where the search begins, "
                                  "such as `extensions: {" +
                                  TypicalEntry(key.name, keys) + "}`");
      continue;
    }
    const std::string nearest = NearestWord(key.name, numbers);
    problems->Add(key.mark, "got '" + key.name + "', expected a number of the cable's extensions" +
                                (nearest.empty() ? "" : ": did you mean '" + nearest + "'?"));
  }
}

}  // namespace

std::optional<SectionShape> ShapeOf(const CableKeys& keys) {
  if (keys.width.value && keys.height.value)
    return SectionShape{0, *keys.width.value, *keys.height.value};
  if (keys.diameter.value) return SectionShape{*keys.diameter.value, 0, 0};
  return std::nullopt;
}

CableModel CompleteCable(const CableKeys& keys, const SourceMark& cable, Problems* problems) {
  Completion check(cable, problems);
  CheckPresence(keys, &check);
  CheckAlongLength(keys, &check);
  CheckMaterial(keys, &check);
  CheckExtensions(keys, problems);
  CableModel model;
  FillExtensions(keys, &model);
  FillUncertain(keys, &model, problems);
  if (!check.ok()) return model;

  model.length = *keys.length.value;
  const SectionShape shape = *ShapeOf(keys);
  model.diameter = shape.largest();
  model.width = shape.width;
  model.height = shape.height;
  model.mass_per_length = *keys.mass_per_length.value;
  FillStiffness(keys, &model);
  FillDamping(keys, &model);
  if (keys.masses.value) {
    for (const LumpedMassKey& entry : *keys.masses.value) model.masses.push_back(entry.mass);
  }
  model.apex_s = keys.apex_s.value.value_or(model.length / 2);
  model.elements = keys.elements.value.value_or(model.elements);
  FillAvoid(keys, &model);
  FillContact(keys, &model);
  return model;
}

}  // namespace cosserat_cable
