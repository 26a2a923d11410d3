#include <map>

#include "cosserat_cable/cable/cable_check.h"
#include "cosserat_cable/cable/cable_keys.h"
#include "cosserat_cable/cable/cable_model.h"
#include "cosserat_cable/cable/contact_stiffness.h"
#include "cosserat_cable/cable/section_file.h"
#include "cosserat_cable/input/map_reader.h"
#include "extensions.h"
#include "parameter_spec.h"

namespace cosserat_cable {
namespace {

constexpr int kFormat = 1;

using Types = std::map<std::string, CableKeys>;

void CheckFormat(const YamlValue& value) {
  if (!value.IsText(std::to_string(kFormat))) {
    value.ReportUnexpected("1, the version of the schema that is read here");
  }
}

Types ReadTypes(const YamlValue& value) {
  MapReader map(value, "a map of types by name");
  Types types;
  for (const auto& [name, entry] : map.Entries()) {
    MapReader keys(entry, "a map of a cable's keys");
    types[name] = ReadCableKeys(&keys);
  }
  return types;
}

const CableKeys* FindType(const YamlValue& value, const Types& types) {
  std::vector<std::string> names;
  for (const auto& type : types) names.push_back(type.first);
  if (value.given() && names.empty()) {
    value.ReportUnexpected("none: the file has no `types`");
    return nullptr;
  }
  const std::optional<std::string> name = value.OneOf(names);
  return name ? &types.at(*name) : nullptr;
}

ClampModel ReadClamp(const YamlValue& value, SourceMark* link_mark) {
  MapReader map(value, "a clamp {link: ..., pose: [...]}");
  ClampModel clamp;
  const YamlValue link = map.Required("link");
  if (link.given()) *link_mark = link.mark();
  clamp.link = link.Text("the name of a link").value_or("");
  clamp.X_LC = map.Required("pose").PoseOf().value_or(Pose());
  return clamp;
}

// Reads one cable and appends it, with its marks, to the file.
class CableReader {
 public:
  CableReader(const Types& types, SectionFiles* sections, CableFile* file, Problems* problems)
      : types_(types), sections_(*sections), file_(file), problems_(problems) {}

  void Read(const YamlValue& value) {
    MapReader map(value, "a map of a cable's keys");
    CableMarks marks;
    marks.cable = value.mark();
    const YamlValue type = map.Optional("type");
    const YamlValue name = file_->specimen ? map.Optional("name") : map.Required("name");
    const YamlValue reference = map.Optional("reference");
    // A specimen has both clamps or none.
    const bool clamped = !file_->specimen || map.Optional("a").given() || map.Optional("b").given();
    const YamlValue a = clamped ? map.Required("a") : map.Optional("a");
    const YamlValue b = clamped ? map.Required("b") : map.Optional("b");
    CableKeys keys = ReadCableKeys(&map);
    const CableKeys* type_keys = FindType(type, types_);
    if (type_keys) keys.FillFrom(*type_keys);
    // A type that is not there may have had the keys that are missing.
    const bool complete = map.ok() && (type_keys || !type.given());
    sections_.Apply(name.Name().value_or(""), &keys, problems_);
    RefuseUncertainFaults(keys);
    if (clamped) RefuseExtensionsOfRecords(keys, problems_);
    CableModel model = complete ? CompleteCable(keys, map.mark(), problems_) : CableModel();

    model.name = name.Name().value_or(file_->specimen ? "cable" : "");
    if (name.given()) marks.name = name.mark();
    CheckNameIsItsOwn(model.name, marks.name);
    if (clamped) {
      model.a = ReadClamp(a, &marks.a_link);
      model.b = ReadClamp(b, &marks.b_link);
    }
    model.reference = model.a.link;
    marks.reference = marks.a_link;
    if (reference.given()) {
      model.reference = reference.Text("the name of a link").value_or("");
      marks.reference = reference.mark();
    }
    if (keys.avoid.value) {
      for (const LinkKey& link : *keys.avoid.value) marks.avoid.push_back(link.mark);
    }
    // Now that the clamps are known. A type without a stiffness leaves it to each of its cables.
    const bool stiffness_given = keys.contact.value && keys.contact.value->stiffness;
    if (model.length > 0 && !stiffness_given)
      model.contact.stiffness = DefaultContactStiffness(model);
    if (model.length > 0 && !model.a.link.empty() && model.a.link == model.b.link) {
      CheckClampDistance(model, marks, (model.a.X_LC.p - model.b.X_LC.p).norm(), problems_);
    }
    file_->cables.push_back(model);
    file_->marks.push_back(marks);
  }

 private:
  void RefuseUncertainFaults(const CableKeys& keys) {
    if (!keys.uncertain.value) return;
    for (const UncertainKey& key : *keys.uncertain.value)
      if (key.name.rfind(FaultPrefix(), 0) == 0)
        problems_->Add(key.mark, "got '" + key.name +
                                     "', a fault of a record, expected it in the "
                                     "`uncertain` of a measurement set");
  }

  void CheckNameIsItsOwn(const std::string& name, const SourceMark& mark) {
    if (name.empty()) return;
    const auto inserted = name_lines_.emplace(name, mark.line);
    if (inserted.second) return;
    problems_->Add(mark, "got '" + name + "', expected a name of its own: the cable on line " +
                             std::to_string(inserted.first->second) + " has it");
  }

  const Types& types_;
  SectionFiles& sections_;
  CableFile* file_;
  Problems* problems_;
  std::map<std::string, int> name_lines_;
};

void ReadFile(const YamlValue& root, SectionFiles* sections, CableFile* file, Problems* problems) {
  MapReader map(root);
  CheckFormat(map.Required("format"));
  const Types types = ReadTypes(map.Optional("types"));
  const YamlValue specimen = map.Optional("cable");
  const YamlValue cables = map.Optional("cables");
  map.Refuse("faults", kFaultsOfACable);
  if (specimen.given() && cables.given()) {
    cables.Report("got this beside `cable`, expected either `cable` or `cables`");
  }
  file->specimen = specimen.given();
  CableReader reader(types, sections, file, problems);
  if (specimen.given()) reader.Read(specimen);
  if (cables.given()) {
    const std::string expected = "a list of at least one cable";
    file->specimen = false;
    const std::vector<YamlValue> items = cables.Items(expected);
    for (const YamlValue& item : items) reader.Read(item);
    if (cables.IsList() && items.empty()) cables.ReportUnexpected(expected);
  }
  std::vector<std::string> names;
  for (const CableModel& cable : file->cables) names.push_back(cable.name);
  sections->ReportUnused(names, problems);
  if (map.ok() && !specimen.given() && !cables.given()) {
    problems->Add(map.mark().file, map.mark().line, "cables",
                  "missing, expected `cables` (a list) or `cable` (one specimen)");
  }
}

}  // namespace

CableFile ReadCableFile(const YamlValue& root, Problems* problems) {
  CableFile file;
  SectionFiles sections({}, problems);
  ReadFile(root, &sections, &file, problems);
  return file;
}

CableFile LoadCableFile(const std::string& path, Problems* problems,
                        const std::vector<std::string>& section_texts) {
  CableFile file;
  Problems found;
  SectionFiles sections(section_texts, &found);
  const YamlValue root = LoadYamlFile(path, &found);
  if (root.given()) ReadFile(root, &sections, &file, &found);
  found.SortByLine();
  problems->Append(found);
  return file;
}

}  // namespace cosserat_cable
