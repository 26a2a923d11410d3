#include "collada_check.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <vector>

namespace cosserat_cable {
namespace {

// Drawings have some ten; each level costs assimp a piece of its stack.
constexpr std::size_t kMostLevels = 500;

bool StartsWith(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

/// The value of an attribute in what stands between < and >; empty where it is missing.
std::string_view Attribute(std::string_view tag, std::string_view name) {
  for (std::size_t at = tag.find(name); at != tag.npos; at = tag.find(name, at + 1)) {
    const bool whole = at > 0 && (tag[at - 1] == ' ' || tag[at - 1] == '\t' || tag[at - 1] == '\n');
    std::size_t quote = tag.find_first_not_of(" \t\n", at + name.size());
    if (!whole || quote == tag.npos || tag[quote] != '=') continue;
    quote = tag.find_first_of("\"'", quote);
    const std::size_t end = quote == tag.npos ? tag.npos : tag.find(tag[quote], quote + 1);
    if (end != tag.npos) return tag.substr(quote + 1, end - quote - 1);
  }
  return {};
}

/// Nodes by their names, with what stands in them as an instance.
using Instances = std::map<std::string, std::set<std::string>>;

/// How many instances lie within each other below a node; more than `most` where it is a circle.
std::size_t Levels(const Instances& instances, const std::string& node, std::size_t most,
                   std::map<std::string, std::size_t>* known) {
  const auto found = known->find(node);
  if (found != known->end()) return found->second;
  const auto within = instances.find(node);
  if (within == instances.end()) return 0;
  if (most == 0) return kMostLevels + 1;
  std::size_t levels = 0;
  for (const std::string& instance : within->second)
    levels = std::max(levels, 1 + Levels(instances, instance, most - 1, known));
  return (*known)[node] = levels;
}

}  // namespace

std::string ColladaProblem(const std::string& text) {
  std::vector<std::string> open;  // names of the nodes around, "" for other elements
  Instances instances;
  const std::string_view all = text;
  for (std::size_t at = all.find('<'); at != all.npos; at = all.find('<', at + 1)) {
    const std::size_t end = all.find('>', at);
    if (end == all.npos) break;
    const std::string_view tag = all.substr(at + 1, end - at - 1);
    if (StartsWith(tag, "?") || StartsWith(tag, "!")) continue;
    if (StartsWith(tag, "/")) {
      if (!open.empty()) open.pop_back();
      continue;
    }
    if (StartsWith(tag, "instance_node")) {
      std::string_view url = Attribute(tag, "url");
      if (StartsWith(url, "#")) url.remove_prefix(1);
      for (const std::string& node : open)
        if (!node.empty()) instances[node].insert(std::string(url));
    }
    if (!tag.empty() && tag.back() == '/') continue;
    const bool is_node = StartsWith(tag, "node") && (tag.size() == 4 || tag[4] <= ' ');
    open.emplace_back(is_node ? Attribute(tag, "id") : std::string_view());
    if (open.size() > kMostLevels)
      return "elements within more than " + std::to_string(kMostLevels) + " others";
  }
  std::map<std::string, std::size_t> known;
  for (const auto& [node, within] : instances)
    if (Levels(instances, node, kMostLevels, &known) >= kMostLevels)
      return "node '" + node + "' is an instance of itself";
  return "";
}

}  // namespace cosserat_cable
