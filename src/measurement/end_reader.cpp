#include "end_reader.h"

#include <algorithm>
#include <set>

#include "cosserat_cable/input/map_reader.h"
#include "motion_file.h"

namespace cosserat_cable {
namespace {

const std::vector<std::string>& Components() {
  static const std::vector<std::string> components = {"tx", "ty", "tz", "rx", "ry", "rz"};
  return components;
}

void ReadFreeComponents(const YamlValue& value, EndCondition* end) {
  if (!value.given()) return;
  std::set<std::string> seen;
  for (const YamlValue& item : value.Items("a list of the components that it does not hold")) {
    const std::optional<std::string> name = item.OneOf(Components());
    if (!name) continue;
    if (!seen.insert(*name).second) item.Report("got '" + *name + "' twice, expected it once");
    const auto at = std::find(Components().begin(), Components().end(), *name);
    const auto i = static_cast<std::size_t>(at - Components().begin());
    (i < 3 ? end->translation_free[i] : end->rotation_free[i - 3]) = true;
  }
}

Disc ReadDisc(const YamlValue& value, const YamlValue& guided_beside) {
  MapReader map(value, "a disc {inertia: ..., mass: ...}");
  Disc disc;
  disc.inertia = map.Required("inertia")
                     .Number(NumberSpec::Above(0, "kg m^2").AtMost(1e3).Hint("is it in g mm^2?"))
                     .value_or(0);
  disc.mass = map.Required("mass")
                  .Number(NumberSpec::AtLeast(0, "kg").AtMost(1e3).Hint("is it in g?"))
                  .value_or(0);
  const YamlValue guided = map.Optional("guided");
  if (guided.given() && guided_beside.given())
    guided_beside.Report("got this beside the disc's own `guided`, expected it once");
  disc.guided = (guided.given() ? guided : guided_beside).Flag().value_or(false);
  return disc;
}

// Reports those that are given. `why` follows what was got.
void Refuse(std::initializer_list<YamlValue> values, const std::string& why) {
  for (const YamlValue& value : values) value.Report("got this " + why);
}

}  // namespace

EndCondition ReadEnd(const std::string& folder, const YamlValue& value, ClampSide side,
                     Problems* problems) {
  EndCondition end;
  end.mark = value.mark();
  const bool at_b = side == ClampSide::kB;
  if (at_b && value.IsText("free")) {
    end.kind = EndCondition::Kind::kFree;
    return end;
  }
  const std::string expected = at_b ? "`free`, {pose: [...]}, {motion: FILE} or {disc: {...}}"
                                    : "{pose: [...]} or {motion: FILE}";
  MapReader map(value, expected);
  const YamlValue pose = map.Optional("pose");
  const YamlValue motion = map.Optional("motion");
  const YamlValue free = map.Optional("free");
  const YamlValue roll = map.Optional("roll");
  const YamlValue disc = at_b ? map.Optional("disc") : YamlValue();
  // A disc's flag may stand in the disc or beside it: the format can be read both ways.
  const YamlValue guided = disc.given() ? map.Optional("guided") : YamlValue();
  if (!map.ok()) return end;

  if (disc.given()) {
    end.kind = EndCondition::Kind::kDisc;
    end.disc = ReadDisc(disc, guided);
    Refuse({pose, motion, free, roll}, "beside a disc, which moves freely, expected it of a clamp");
    return end;
  }
  if (pose.given() && motion.given()) Refuse({motion}, "beside `pose`, expected one of them");
  if (!pose.given() && !motion.given())
    value.Report("got neither a pose nor a motion, expected " + expected);
  end.pose = pose.PoseOf().value_or(Pose());
  if (motion.given()) end.motion = ReadMotion(folder, motion, problems);
  ReadFreeComponents(free, &end);
  if (roll.given()) end.roll_unknown = roll.OneOf({"unknown"}).has_value();
  return end;
}

bool TurnsAboutAxis(const EndCondition& end) {
  return end.kind != EndCondition::Kind::kClamp || end.rotation_free[2] || end.roll_unknown;
}

}  // namespace cosserat_cable
