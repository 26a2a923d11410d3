// What LinkMotion knows of names and stamps that do not fit.
#include <algorithm>
#include <limits>

#include "cosserat_cable/input/problems.h"
#include "cosserat_cable/ros/conversions.h"
#include "cosserat_cable/ros/link_motion.h"

namespace cosserat_cable {
namespace {

const char kUseRecordTimes[] =
    "--use-record-times (live: ~use_record_times) takes the times at which messages were recorded";

// Of a recorded name that ends in one of the URDF's: how often each such prefix is met.
using PrefixCounts = std::map<std::string, std::set<std::string>>;

void CountPrefixes(const std::string& recorded, const std::string& own, PrefixCounts* counts) {
  if (own.empty() || recorded.size() <= own.size() + 1) return;
  const std::size_t length = recorded.size() - own.size();
  if (recorded.compare(length, own.npos, own) != 0) return;
  const char separator = recorded[length - 1];
  if (separator == '/' || separator == '_') (*counts)[recorded.substr(0, length)].insert(own);
}

std::string PrefixSentence(const PrefixCounts& counts, const std::string& what) {
  const auto best = std::max_element(
      counts.begin(), counts.end(),
      [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
  if (best == counts.end()) return "";
  // `left_wheel` is no `wheel` of a vehicle named left.
  constexpr std::size_t kUnderscoresAtLeast = 2;
  const bool slash = best->first.back() == '/';
  if (!slash && best->second.size() < kUnderscoresAtLeast) return "";
  const std::string option = slash ? best->first.substr(0, best->first.size() - 1) : best->first;
  return what + " such as '" + best->first + *best->second.begin() + "' are the URDF's '" +
         *best->second.begin() + "' with a prefix: --tf-prefix " + option + " takes it off";
}

}  // namespace

std::string WholePrefix(const std::string& tf_prefix) {
  const std::string prefix = WithoutSlash(tf_prefix);
  if (prefix.empty() || prefix.back() == '/' || prefix.back() == '_') return prefix;
  return prefix + "/";
}

std::string LinkMotion::Own(const std::string& name) const {
  const std::string own = WithoutSlash(name);
  const std::string& prefix = options_.tf_prefix;
  return !prefix.empty() && own.compare(0, prefix.size(), prefix) == 0 ? own.substr(prefix.size())
                                                                       : own;
}

std::string LinkMotion::UnstampedText(const Unstamped& unstamped) const {
  const std::string samples =
      unstamped.samples == 1 ? "the only sample of it by "
                             : "all " + std::to_string(unstamped.samples) + " samples of it by ";
  return samples + ToString(unstamped.source) +
         (unstamped.samples == 1 ? " has no stamp: " : " have no stamp: ") + kUseRecordTimes;
}

std::vector<std::string> LinkMotion::Apart() const {
  std::vector<std::string> sentences;
  std::int64_t first_end = std::numeric_limits<std::int64_t>::max(), last_begin = 0;
  for (const auto& [child, edge] : edges_) {
    if (!edge.is_followed || edge.samples == 0) continue;
    sentences.push_back(edge.parent + " -> " + child + " by " + ToString(edge.source) +
                        " is recorded from " + StampText(edge.first) + " to " +
                        StampText(edge.last));
    first_end = std::min(first_end, edge.last);
    last_begin = std::max(last_begin, edge.first);
  }
  std::string reason = "there is no time at which all links are known together";
  if (first_end < last_begin)
    reason += std::string(": are stamps of two clocks in it? Then ") + kUseRecordTimes;
  sentences.insert(sentences.begin(), reason);
  return sentences;
}

std::vector<std::string> LinkMotion::Advice() const {
  std::vector<std::string> sentences;
  std::map<Source, std::uint64_t> partly;
  for (const auto& [child, unstamped] : unstamped_)
    if (edges_.count(child) > 0) partly[unstamped.source] += unstamped.samples;
  for (const auto& [source, samples] : partly) {
    sentences.push_back(std::to_string(samples) + " samples by " + ToString(source) +
                        " have no stamp and are left out, others have one: " + kUseRecordTimes +
                        " of all");
  }
  const auto repeated = warnings_.counts().find("sample repeated with the same stamp");
  for (const auto& [child, edge] : edges_) {
    if (edge.samples != 1 || !edge.is_followed || repeated == warnings_.counts().end()) continue;
    sentences.push_back("all samples of frame '" + child + "' by " + ToString(edge.source) +
                        " have one and the same stamp: " + kUseRecordTimes);
  }
  PrefixCounts frames, joints;
  const auto count_frame = [&](const std::string& frame) {
    if (vehicle_.HasLink(frame)) return;
    for (const std::string& link : vehicle_.links) CountPrefixes(frame, link, &frames);
  };
  for (const auto& [child, edge] : edges_) {
    count_frame(child);
    count_frame(edge.parent);
  }
  for (const std::string& name : unknown_joints_)
    for (const auto& [joint, model] : joints_) CountPrefixes(WithoutSlash(name), joint, &joints);
  std::vector<std::string> own;
  for (const auto& [joint, model] : joints_)
    if (edges_.count(model->child) == 0) own.push_back(joint);
  for (const std::string& name : unknown_joints_) {
    const std::string meant = NearestWord(WithoutSlash(name), own);
    if (!meant.empty())
      sentences.push_back("joint '" + name +
                          "' is recorded, and not in the URDF: is it the URDF's '" + meant +
                          "'? Give it one name in both");
  }
  for (const std::string& sentence :
       {PrefixSentence(frames, "frames"), PrefixSentence(joints, "joints")})
    if (!sentence.empty()) sentences.push_back(sentence);
  return sentences;
}

}  // namespace cosserat_cable
