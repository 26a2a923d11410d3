#include "avoided_links.h"

#include <algorithm>

namespace cosserat_cable {
namespace {

std::string Complaint(const std::string& link, bool visual, const LinkEntry& entry,
                      const std::string& urdf) {
  const std::string got = "got '" + link + "', a link without <" +
                          (visual ? "visual" : "collision") + "> geometry (" + urdf + ":" +
                          std::to_string(entry.line) + "), expected one that can be touched: ";
  if (visual && entry.collisions > 0)
    return got + "leave out use_visual, or take the link out of `avoid`";
  if (!visual && entry.visuals > 0)
    return got + "write {link: " + link + ", use_visual: true} to take its visual geometry, give " +
           "it a <collision>, or take the link out of `avoid`";
  return got + "give it a <collision>, or take the link out of `avoid`";
}

}  // namespace

void CheckAvoidedLinks(const CableFile& file, const VehicleModel& vehicle, const std::string& urdf,
                       Problems* problems) {
  for (std::size_t i = 0; i < file.cables.size(); ++i) {
    const CableModel& cable = file.cables[i];
    const std::size_t count = std::min(cable.avoid.size(), file.marks[i].avoid.size());
    for (std::size_t j = 0; j < count; ++j) {
      const std::string& link = cable.avoid[j];
      const auto entry = vehicle.entries.find(link);
      if (entry == vehicle.entries.end()) continue;
      const bool visual = cable.avoid_visual.count(link) > 0;
      if ((visual ? entry->second.visuals : entry->second.collisions) > 0) continue;
      problems->Add(file.marks[i].avoid[j], Complaint(link, visual, entry->second, urdf));
    }
  }
}

}  // namespace cosserat_cable
