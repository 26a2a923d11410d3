#include "cosserat_cable/cable/section_file.h"

#include <algorithm>
#include <cmath>

#include "cosserat_cable/input/map_reader.h"
#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {
namespace {

// How the options of programs are named in messages.
constexpr const char* kOption = "section";
// Outlines that differ by more are of other cables.
constexpr double kSameOutline = 0.02;

/// What differs between two outlines, in words; empty where nothing does, or one says nothing.
std::string OtherOutline(const CableKeys& cable, const CableKeys& specimen) {
  const auto differs = [](const CableKey<double>& a, const CableKey<double>& b) {
    return a.value && b.value && std::abs(*a.value - *b.value) > kSameOutline * *a.value;
  };
  const auto text = [](const char* name, const CableKey<double>& a, const CableKey<double>& b) {
    return std::string(name) + " " + FormatNumber(*b.value) + " m, this cable " +
           FormatNumber(*a.value) + " m";
  };
  if (differs(cable.diameter, specimen.diameter))
    return text("a diameter of", cable.diameter, specimen.diameter);
  if (differs(cable.width, specimen.width)) return text("a width of", cable.width, specimen.width);
  if (differs(cable.height, specimen.height))
    return text("a height of", cable.height, specimen.height);
  return "";
}

}  // namespace

CableKeys LoadSpecimenFile(const std::string& path, Problems* problems) {
  MapReader file(LoadYamlFile(path, problems));
  file.Required("format").Integer(1, 1);
  const YamlValue cable = file.Required("cable");
  MapReader map(cable);
  return ReadCableKeys(&map);
}

CableKeys WithFitted(const CableKeys& cable, const CableKeys& specimen) {
  CableKeys keys;
  keys.EI = specimen.EI;
  keys.GJ = specimen.GJ;
  keys.EA = specimen.EA;
  keys.GA = specimen.GA;
  keys.eta_EI = specimen.eta_EI;
  keys.eta_GJ = specimen.eta_GJ;
  keys.eta_EA = specimen.eta_EA;
  keys.eta_GA = specimen.eta_GA;
  keys.extensions = specimen.extensions;
  keys.elements = specimen.elements;
  keys.FillFrom(cable);
  return keys;
}

SectionFiles::SectionFiles(const std::vector<std::string>& texts, Problems* problems) {
  for (const std::string& text : texts) {
    Section section;
    section.text = text;
    const std::size_t equals = text.find('=');
    // A path may have one too.
    const bool named = equals != std::string::npos && text.find('/') > equals;
    if (named) section.cable = text.substr(0, equals);
    section.path = named ? text.substr(equals + 1) : text;
    const bool twice = std::any_of(sections_.begin(), sections_.end(),
                                   [&](const Section& one) { return one.cable == section.cable; });
    if (twice)
      problems->Add("", 0, kOption,
                    "got '" + text + "', a second section " +
                        (named ? "for '" + section.cable + "'" : "for all cables"));
    section.keys = LoadSpecimenFile(section.path, problems);
    sections_.push_back(std::move(section));
  }
}

void SectionFiles::Apply(const std::string& name, CableKeys* keys, Problems* problems) {
  Section* own = nullptr;
  for (Section& section : sections_)
    if (section.cable == name || (section.cable.empty() && !own)) own = &section;
  if (!own) return;
  own->used = true;
  if (const std::string other = OtherOutline(*keys, own->keys); !other.empty())
    problems->Add("", 0, kOption,
                  "got '" + own->text + "' for '" + name + "', a specimen with " + other +
                      ": expected one of the same kind");
  *keys = WithFitted(*keys, own->keys);
}

void SectionFiles::ReportUnused(const std::vector<std::string>& cables, Problems* problems) const {
  for (const Section& section : sections_) {
    if (section.used || section.cable.empty()) continue;
    const std::string nearest = NearestWord(section.cable, cables);
    problems->Add("", 0, kOption,
                  "got '" + section.text + "', expected the name of a cable before '='" +
                      (nearest.empty() ? "" : ": did you mean '" + nearest + "'?"));
  }
}

}  // namespace cosserat_cable
