#include "cosserat_cable/cable/cable_check.h"

#include <algorithm>

#include "cosserat_cable/cable/extension_law.h"
#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {
namespace {

// A cable that is strung taut is stretched, but hardly by more; beyond, a length or pose is wrong.
constexpr double kMostStretch = 0.01;

void CheckLink(const std::string& link, const SourceMark& mark,
               const std::vector<std::string>& link_names, Problems* problems) {
  // Line 0: the file names none, which reading has reported where it is a mistake.
  if (mark.line == 0 || link.empty()) return;
  if (std::find(link_names.begin(), link_names.end(), link) != link_names.end()) return;
  const std::string nearest = NearestWord(link, link_names);
  problems->Add(mark, "got '" + link + "', expected a link of the vehicle" +
                          (nearest.empty() ? "" : ": did you mean '" + nearest + "'?"));
}

/// The entry of this name, or null.
const CableExtension* Find(const CableModel& cable, const std::string& name) {
  for (const CableExtension& extension : cable.extensions)
    if (extension.name == name) return &extension;
  return nullptr;
}

/// A loss at a disc, where there is a rigid clamp.
bool DampsARigidClamp(const CableModel& cable) {
  const CableExtension* damping = Find(cable, "clamp_damping");
  const CableExtension* springs = Find(cable, "clamp_compliance");
  return damping && damping->parts.front().count(kDiscDashpot) &&
         !(springs && springs->parts.front().count(kDiscDashpot));
}

}  // namespace

void CheckAgainstVehicle(const CableFile& file, const std::vector<std::string>& link_names,
                         Problems* problems) {
  Problems found;
  for (std::size_t i = 0; i < file.cables.size(); ++i) {
    const CableModel& cable = file.cables[i];
    const CableMarks& marks = file.marks[i];
    if (file.specimen && marks.a_link.line == 0 && marks.b_link.line == 0) {
      found.Add(marks.cable,
                "got a cable without clamps, expected links `a` and `b` of the vehicle");
    }
    if (DampsARigidClamp(cable)) {
      found.Add(
          marks.cable,
          "got clamp_damping of b in torsion, the loss at a disc of a measurement set, expected "
          "none at a vehicle's clamp, or clamp_compliance of b in torsion beside it");
    }
    CheckLink(cable.a.link, marks.a_link, link_names, &found);
    CheckLink(cable.b.link, marks.b_link, link_names, &found);
    CheckLink(cable.reference, marks.reference, link_names, &found);
    const std::size_t avoided = std::min(cable.avoid.size(), marks.avoid.size());
    for (std::size_t j = 0; j < avoided; ++j) {
      CheckLink(cable.avoid[j], marks.avoid[j], link_names, &found);
    }
  }
  found.SortByLine();
  problems->Append(found);
}

void CheckClampDistance(const CableModel& cable, const CableMarks& marks, double distance,
                        Problems* problems) {
  if (distance <= (1 + kMostStretch) * cable.length) return;
  problems->Add(marks.cable, "got clamps " + FormatRounded(distance) +
                                 " m apart, expected at most the cable's length, " +
                                 FormatRounded(cable.length) + " m");
}

std::string ClampsInside(const CableModel& cable, const Pose& X_WA, const Pose& X_WB) {
  for (const CableExtension& extension : cable.extensions) {
    const ExtensionLaw& law = LawOf(extension);
    if (law.depth == nullptr) continue;
    const Pose X_AB = X_WA.Inverse() * X_WB;
    const double at_a = law.depth(extension, cable, Eigen::Vector3d::Zero());
    const double at_b = law.depth(extension, cable, X_AB.p);
    // A clamp may sit on a surface.
    if (std::max(at_a, at_b) <= cable.diameter) continue;
    const auto side = [](const char* name, double depth) {
      return std::string("clamp ") + name + " is " + FormatRounded(1e3 * std::abs(depth), 3) +
             (depth > 0 ? " mm inside" : " mm outside");
    };
    return "the obstacle of extensions." + extension.name + " holds the cable: " + side("a", at_a) +
           ", " + side("b", at_b) +
           " by its surface; move the obstacle, or turn it round (its solid side is the one "
           "against the normal)";
  }
  return "";
}

}  // namespace cosserat_cable
