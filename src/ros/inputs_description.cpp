#include <cstdio>
#include <sstream>

#include "cosserat_cable/ros/inputs.h"
#include "json.h"

namespace cosserat_cable {
namespace {

/// What a cable is kept clear of.
std::size_t CountBodies(const Inputs& inputs, const CableModel& cable) {
  std::size_t count = 0;
  for (const std::string& link : cable.avoid)
    if (FindBody(inputs.bodies, cable, link)) ++count;
  return count;
}

}  // namespace

std::string Describe(const Inputs& inputs) {
  std::ostringstream text;
  char line[256];
  text << "vehicle '" << inputs.vehicle.name << "': " << inputs.vehicle.links.size() << " links, "
       << inputs.vehicle.joints.size() << " joints, " << inputs.bodies.size()
       << " bodies that cables avoid, with " << inputs.triangles << " triangles\n";
  for (std::size_t i = 0; i < inputs.cables.cables.size(); ++i) {
    const CableModel& cable = inputs.cables.cables[i];
    std::snprintf(line, sizeof line, "cable '%s': %g mm, %s to %s, %d elements", cable.name.c_str(),
                  1e3 * cable.length, cable.a.link.c_str(), cable.b.link.c_str(), cable.elements);
    text << line;
    const std::size_t bodies = CountBodies(inputs, cable);
    if (bodies == 0) {
      text << ", avoids nothing: no clearance is measured";
    } else {
      text << ", avoids " << bodies << (bodies == 1 ? " body" : " bodies");
    }
    if (inputs.survey && i < inputs.survey->chords.size()) {
      std::snprintf(line, sizeof line, ", clamps %.1f mm apart at first (%.0f %% of its length)",
                    1e3 * inputs.survey->chords[i], 100 * inputs.survey->chords[i] / cable.length);
      text << line;
    }
    text << "\n";
  }
  for (const Problem& note : inputs.vehicle.notes.all())
    text << "note: " << note.ToString() << "\n";
  if (!inputs.survey) return text.str();
  const BagSurvey& survey = *inputs.survey;
  text << "inertial frame '" << survey.world << "'"
       << (survey.world_is_recorded ? "" : " (the URDF's root: no frame above it is recorded)")
       << "\n";
  for (const auto& [topic, count] : inputs.bags->counts()) {
    text << topic << ": " << count << " messages\n";
  }
  for (const auto& [child, edge] : survey.edges) {
    if (edge.samples < 2) continue;
    const double seconds = static_cast<double>(edge.last - edge.first) * 1e-9;
    std::snprintf(line, sizeof line,
                  "%s -> %s by %s: %.1f Hz, longest interval %.1f ms, %llu gaps\n",
                  edge.parent.c_str(), child.c_str(), ToString(edge.source),
                  static_cast<double>(edge.samples - 1) / seconds,
                  static_cast<double>(edge.longest_interval) * 1e-6,
                  static_cast<unsigned long long>(edge.gaps));
    text << line;
  }
  for (const auto& [kind, count] : survey.warnings) {
    text << "warning: " << kind << ": " << count << "\n";
  }
  return text.str();
}

std::string DescribeJson(const Inputs& inputs, const Problems& problems) {
  std::ostringstream json;
  json << "{\n  \"ok\": " << (problems.empty() ? "true" : "false") << ",\n  \"problems\": [";
  const char* separator = "";
  for (const Problem& problem : problems.all()) {
    json << separator << "\n    " << JsonString(problem.ToString());
    separator = ",";
  }
  json << "],\n  \"notes\": [";
  separator = "";
  for (const Problem& note : inputs.vehicle.notes.all()) {
    json << separator << "\n    " << JsonString(note.ToString());
    separator = ",";
  }
  json << "],\n  \"bodies\": " << inputs.bodies.size() << ",\n  \"triangles\": " << inputs.triangles
       << ",\n  \"cables\": {";
  separator = "";
  for (std::size_t i = 0; i < inputs.cables.cables.size(); ++i) {
    const CableModel& cable = inputs.cables.cables[i];
    json << separator << "\n    " << JsonString(cable.name)
         << ": {\"length\": " << JsonNumber(cable.length)
         << ", \"bodies\": " << CountBodies(inputs, cable)
         << ", \"contact_stiffness\": " << JsonNumber(cable.contact.stiffness) << ", \"chord\": "
         << (inputs.survey ? JsonNumber(inputs.survey->chords[i]) : std::string("null")) << "}";
    separator = ",";
  }
  json << "},\n  \"world_frame\": "
       << (inputs.survey ? JsonString(inputs.survey->world) : std::string("null"))
       << ",\n  \"gaps\": " << (inputs.survey ? std::to_string(inputs.survey->gaps) : "null")
       << "\n}\n";
  return json.str();
}

}  // namespace cosserat_cable
