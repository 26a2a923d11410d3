#include <cstdio>
#include <sstream>

#include "cosserat_cable/input/gravity.h"
#include "cosserat_cable/input/number_text.h"
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

std::vector<std::string> InputWarnings(const Inputs& inputs) {
  std::vector<std::string> warnings;
  for (const Problem& warning : inputs.vehicle.warnings.all())
    warnings.push_back(warning.ToString());
  if (inputs.survey)
    warnings.insert(warnings.end(), inputs.survey->warnings.begin(), inputs.survey->warnings.end());
  return warnings;
}

std::vector<std::string> Notes(const Inputs& inputs) {
  std::vector<std::string> notes;
  for (const Problem& note : inputs.vehicle.notes.all()) notes.push_back(note.ToString());
  if (inputs.survey)
    notes.insert(notes.end(), inputs.survey->notes.begin(), inputs.survey->notes.end());
  return notes;
}

std::string SharedOptionsText(const EngineOptions& options) {
  const MotionTopics usual, &topics = options.links.topics;
  std::string text = " --gravity " + GravityOption(options.gravity_W);
  if (!options.links.world_frame.empty()) text += " --world-frame " + options.links.world_frame;
  if (topics.joint_states != usual.joint_states) text += " --joint-states " + topics.joint_states;
  if (topics.tf != usual.tf) text += " --tf " + topics.tf;
  if (!options.links.tf_prefix.empty()) text += " --tf-prefix " + options.links.tf_prefix;
  if (topics.use_record_times) text += " --use-record-times";
  if (options.links.smooth > 0) text += " --smooth " + FormatRounded(options.links.smooth, 6);
  return text;
}

std::string Describe(const Inputs& inputs, const EngineOptions& options) {
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
    if (inputs.survey && i < inputs.survey->clamps.size()) {
      text << ", clamps " << inputs.survey->clamps[i].Describe();
    } else if (inputs.survey && i < inputs.survey->chords.size()) {
      std::snprintf(line, sizeof line, ", clamps %.1f mm apart at first (%.0f %% of its length)",
                    1e3 * inputs.survey->chords[i], 100 * inputs.survey->chords[i] / cable.length);
      text << line;
    }
    text << "\n";
  }
  if (!inputs.survey) {
    for (const std::string& warning : InputWarnings(inputs)) text << "warning: " << warning << "\n";
    for (const std::string& note : Notes(inputs)) text << "note: " << note << "\n";
    return text.str();
  }
  const BagSurvey& survey = *inputs.survey;
  text << "inertial frame '" << survey.world << "'";
  if (!survey.topmost.empty())
    text << " (not '" << survey.topmost << "': a localisation's corrections move what is above)";
  text << (survey.world_is_recorded ? "" : " (the URDF's root: no frame above it is recorded)")
       << "\n";
  text << GravityText(options.gravity_W, survey.world) << "\n";
  if (inputs.bags->topics().use_record_times)
    text << "times are those of recording, not the messages' stamps\n";
  for (const auto& [topic, count] : inputs.bags->counts()) {
    text << topic << ": " << count << " messages\n";
  }
  for (const auto& [child, edge] : survey.edges) {
    if (edge.samples < 2) continue;
    const double seconds = static_cast<double>(edge.last - edge.first) * 1e-9;
    std::snprintf(
        line, sizeof line, "%s -> %s by %s: %.1f Hz, longest interval %.1f ms, %llu gaps%s\n",
        edge.parent.c_str(), child.c_str(), ToString(edge.source, inputs.bags->topics()).c_str(),
        static_cast<double>(edge.samples - 1) / seconds,
        static_cast<double>(edge.longest_interval) * 1e-6,
        static_cast<unsigned long long>(edge.gaps), edge.moves ? "" : ", does not move");
    text << line;
  }
  for (const std::string& warning : InputWarnings(inputs)) text << "warning: " << warning << "\n";
  for (const Finding& finding : survey.findings) {
    text << "warning: " << finding.ToString() << "\n";
  }
  for (const std::string& note : Notes(inputs)) text << "note: " << note << "\n";
  return text.str();
}

std::string DescribeJson(const Inputs& inputs, const EngineOptions& options,
                         const Problems& problems) {
  std::ostringstream json;
  json << "{\n  \"ok\": " << (problems.empty() ? "true" : "false") << ",\n  \"problems\": [";
  const char* separator = "";
  for (const Problem& problem : problems.all()) {
    json << separator << "\n    " << JsonString(problem.ToString());
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
         << (inputs.survey ? JsonNumber(inputs.survey->chords[i]) : std::string("null"));
    if (inputs.survey && i < inputs.survey->clamps.size())
      json << JsonClamps(inputs.survey->clamps[i].range());
    json << "}";
    separator = ",";
  }
  json << "},\n  \"world_frame\": "
       << (inputs.survey ? JsonString(inputs.survey->world) : std::string("null"))
       << ",\n  \"gravity\": " << JsonVector(options.gravity_W)
       << ",\n  \"warning_sentences\": " << JsonStrings(InputWarnings(inputs))
       << ",\n  \"notes\": " << JsonStrings(Notes(inputs)) << ",\n  \"use_record_times\": "
       << (options.links.topics.use_record_times ? "true" : "false") << ",\n  \"findings\": "
       << (inputs.survey ? JsonFindings(inputs.survey->findings) : std::string("[]"))
       << ",\n  \"gaps\": " << (inputs.survey ? std::to_string(inputs.survey->gaps) : "null")
       << "\n}\n";
  return json.str();
}

}  // namespace cosserat_cable
