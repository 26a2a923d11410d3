#include "start_reader.h"

#include "arc_length.h"
#include "cosserat_cable/input/map_reader.h"

namespace cosserat_cable {
namespace {

const char* const kExpected =
    "one of {rest: true}, {held: {s: ..., position: [...]}}, {twisted: ...} and {unknown: true}";

PointAt ReadPoint(const YamlValue& value, const std::optional<double>& length) {
  MapReader map(value, "a point {s: ..., position: [x, y, z]}");
  PointAt point;
  point.s = ReadArcLength(map.Required("s"), length).value_or(0);
  point.position_W = map.Required("position")
                         .Vector3(NumberSpec::Any("m"))
                         .value_or(Eigen::Vector3d::Zero().eval());
  return point;
}

void RequireTrue(const YamlValue& value) {
  const std::optional<bool> flag = value.Flag();
  if (flag && !*flag) value.ReportUnexpected("true, or another start");
}

}  // namespace

StartCondition ReadStart(const YamlValue& value, const std::optional<double>& length) {
  using Kind = StartCondition::Kind;
  StartCondition start;
  start.mark = value.mark();
  MapReader map(value, kExpected);
  const YamlValue rest = map.Optional("rest");
  const YamlValue held = map.Optional("held");
  const YamlValue twisted = map.Optional("twisted");
  const YamlValue unknown = map.Optional("unknown");
  const YamlValue near = map.Optional("near");
  if (!map.ok()) return start;

  const int given = rest.given() + held.given() + twisted.given() + unknown.given();
  if (given != 1)
    value.Report("got " + std::to_string(given) + " kinds of start, expected " + kExpected);
  if (near.given() && !rest.given())
    near.Report("got this without `rest`, expected it to pick one of several equilibria");
  RequireTrue(rest);
  RequireTrue(unknown);
  if (near.given()) start.near = ReadPoint(near, length);
  if (held.given()) {
    start.kind = Kind::kHeld;
    start.held = ReadPoint(held, length);
  }
  if (twisted.given()) {
    start.kind = Kind::kTwisted;
    start.twisted = twisted.Number(NumberSpec::Any("rad")).value_or(0);
  }
  if (unknown.given()) start.kind = Kind::kUnknown;
  return start;
}

}  // namespace cosserat_cable
