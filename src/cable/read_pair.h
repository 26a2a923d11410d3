// A quantity that a file gives by one key (EI), or by two for the directions a1 and a2 (EI1, EI2).
#pragma once

#include <array>
#include <string>

#include "cosserat_cable/cable/cable_keys.h"

namespace cosserat_cable {

template <typename T, typename Parse>
CableKey<std::array<T, 2>> ReadPair(MapReader* map, const std::string& key, const Parse& parse) {
  const YamlValue both = map->Optional(key);
  const YamlValue first = map->Optional(key + "1");
  const YamlValue second = map->Optional(key + "2");
  CableKey<std::array<T, 2>> pair;
  const YamlValue& one = first.given() ? first : second;
  if (both.given()) {
    pair.mark = both.mark();
    if (const std::optional<T> value = parse(both)) pair.value = {*value, *value};
    if (one.given()) {
      one.Report("got this beside " + key + ", expected either " + key + ", or " + key + "1 and " +
                 key + "2");
    }
  } else if (one.given()) {
    pair.mark = one.mark();
    if (second.given()) pair.second = second.mark();
    if (!first.given() || !second.given()) {
      one.Report("got this alone, expected " + key + "1 and " + key + "2, or " + key);
    }
    const std::optional<T> values[2] = {parse(first), parse(second)};
    if (values[0] && values[1]) pair.value = {*values[0], *values[1]};
  }
  return pair;
}

}  // namespace cosserat_cable
