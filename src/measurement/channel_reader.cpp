#include "channel_reader.h"

#include <map>

#include "arc_length.h"
#include "cosserat_cable/input/map_reader.h"

namespace cosserat_cable {
namespace {

constexpr Quantity kQuantities[] = {
    Quantity::kPosition, Quantity::kVelocity, Quantity::kAcceleration, Quantity::kAngle,
    Quantity::kRate,     Quantity::kForce,    Quantity::kMoment};

std::optional<Quantity> ReadQuantity(const YamlValue& value) {
  std::vector<std::string> names;
  for (const Quantity quantity : kQuantities) names.push_back(ToString(quantity));
  const std::optional<std::string> name = value.OneOf(names);
  for (const Quantity quantity : kQuantities) {
    if (name && *name == ToString(quantity)) return quantity;
  }
  return std::nullopt;
}

void RefuseOf(Quantity quantity, const YamlValue& value) {
  value.Report(
      std::string("got this of ") +
      (quantity == Quantity::kAngle || quantity == Quantity::kAcceleration ? "an " : "a ") +
      ToString(quantity) + ", which has none");
}

ChannelEntry ReadChannel(const YamlValue& value, const std::optional<double>& length) {
  MapReader map(value, "a channel {column: ..., s: ..., quantity: ..., axis: ...}");
  ChannelEntry entry;
  Channel& channel = entry.channel;
  channel.mark = value.mark();
  entry.column = map.Required("column");
  channel.column = entry.column.Text("the name of a column").value_or("");
  const std::optional<Quantity> quantity = ReadQuantity(map.Required("quantity"));
  const YamlValue sigma = map.Optional("sigma");
  const YamlValue offset = map.Optional("offset");
  const YamlValue frame = map.Optional("frame");
  if (sigma.given()) channel.sigma = sigma.Number(NumberSpec::Above(0, "the channel's unit"));
  if (offset.given()) channel.unknown_offset = offset.OneOf({"unknown"}).has_value();
  if (frame.given()) channel.in_frame_a = frame.OneOf({"a"}).has_value();
  YamlValue s = map.Optional("s");
  YamlValue clamp = map.Optional("clamp");
  YamlValue axis = map.Optional("axis");
  if (!quantity) return entry;

  channel.quantity = *quantity;
  const bool at_clamp = *quantity == Quantity::kForce || *quantity == Quantity::kMoment;
  const bool about_axis = *quantity == Quantity::kAngle || *quantity == Quantity::kRate;
  if (at_clamp) {
    RefuseOf(*quantity, s);
    clamp = map.Required("clamp");
    if (clamp.OneOf({"a", "b"}).value_or("a") == "b") channel.clamp = ClampSide::kB;
  } else {
    RefuseOf(*quantity, clamp);
    s = map.Required("s");
    channel.s = ReadArcLength(s, length).value_or(0);
  }
  if (about_axis) {
    RefuseOf(*quantity, axis);
    RefuseOf(*quantity, frame);
  } else {
    axis = map.Required("axis");
    channel.axis = axis.OneOf({"x", "y", "z"}).value_or("x")[0] - 'x';
  }
  return entry;
}

}  // namespace

std::vector<ChannelEntry> ReadChannels(const YamlValue& value,
                                       const std::optional<double>& length) {
  std::vector<ChannelEntry> entries;
  std::map<std::string, int> lines;
  const std::string expected = "a list of at least one channel";
  for (const YamlValue& item : value.Items(expected)) {
    entries.push_back(ReadChannel(item, length));
    const ChannelEntry& entry = entries.back();
    const auto inserted = lines.emplace(entry.channel.column, entry.column.mark().line);
    if (!entry.channel.column.empty() && !inserted.second) {
      entry.column.ReportUnexpected("a column of its own: the channel on line " +
                                    std::to_string(inserted.first->second) + " has it");
    }
  }
  if (value.IsList() && entries.empty()) value.ReportUnexpected(expected);
  return entries;
}

}  // namespace cosserat_cable
