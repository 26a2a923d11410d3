// What LinkMotion knows of names and stamps that do not fit.
#include <algorithm>
#include <limits>
#include <tuple>

#include "cosserat_cable/input/number_text.h"
#include "cosserat_cable/input/problems.h"
#include "cosserat_cable/ros/conversions.h"
#include "cosserat_cable/ros/link_motion.h"

namespace cosserat_cable {
namespace {

// Nobody misses less of a recording [s], or a smaller part of it, unless that is a large part.
constexpr double kLeastLost = 0.2, kLeastShare = 0.01, kLargeShare = 0.2;
// All that is recorded within this is one instant [s].
constexpr double kInstant = 0.01;
// Both ends are off by the same: a clock [s].
constexpr double kSameShift = 0.1;
// Clocks of one machine agree within this, messages arrive within it; localisations take long, and
// their transforms are stamped ahead [s].
constexpr double kSameClock = 0.15, kSameClockAbove = 1.0;
constexpr std::uint64_t kFewestDelays = 5;
// Between the begin of a recording and its end, clocks stay together within this [s].
constexpr double kSameChange = 0.1;
// A constant transform holds outside its samples for so many of its intervals.
constexpr double kHolds = 1.5;

double ToSeconds(std::int64_t time) { return static_cast<double>(time) * 1e-9; }

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

// As the user of each program types it.
std::string LinkMotion::Option(const std::string& name, const std::string& value) const {
  if (!options_.is_node) return "--" + name + (value.empty() ? "" : " " + value);
  std::string parameter = name;
  std::replace(parameter.begin(), parameter.end(), '-', '_');
  return "~" + parameter + (value.empty() ? "" : ": " + value);
}

std::string LinkMotion::UseRecordTimes() const {
  return options_.is_node ? "~use_record_times takes the times at which messages arrive"
                          : "--use-record-times (live: ~use_record_times) takes the times at which "
                            "messages were "
                            "recorded";
}

std::string LinkMotion::NoCommonRoot() const {
  std::map<std::string, std::set<std::string>> below;
  for (const std::string& link : links_) {
    const std::vector<Step> way = Ascend(link);
    below[way.empty() ? link : way.back().parent].insert(link);
  }
  std::string text = "the links have no common root frame: ", roots;
  const char* separator = "";
  for (const auto& [root, links] : below) {
    text += separator + ("'" + *links.begin() + "'");
    if (links.size() > 1) text += " and " + std::to_string(links.size() - 1) + " more";
    text += links.size() > 1 ? " are below '" : " is below '";
    text += root + "'";
    roots += (roots.empty() ? "" : " or ") + root;
    separator = ", ";
  }
  return text + "; record the transform between these, or say which frame is inertial by " +
         Option("world-frame", roots);
}

std::set<std::string> LinkMotion::Above(const std::string& world) const {
  std::set<std::string> above = {world};
  for (auto edge = edges_.find(world); edge != edges_.end();
       edge = edges_.find(edge->second.parent))
    if (!above.insert(edge->second.parent).second) break;
  return above;
}

std::string LinkMotion::SubjectOf(const std::vector<std::string>& children) const {
  const std::string edge = edges_.at(children[0]).parent + " -> " + children[0];
  return children.size() == 1 ? edge
                              : edge + " and " + std::to_string(children.size() - 1) + " more";
}

// Of the topic that comes the soonest after its stamps; others are measured by it.
std::int64_t LinkMotion::UsualDelay(bool at_first) const {
  std::map<Source, std::vector<std::int64_t>> delays;
  for (const auto& [child, edge] : edges_)
    if (edge.delays.count() > 0)
      delays[edge.source].push_back(at_first ? edge.delays.first() : edge.delays.Median());
  std::int64_t usual = 0;
  bool is_known = false;
  for (auto& [source, of_edges] : delays) {
    const auto middle = of_edges.begin() + static_cast<std::ptrdiff_t>(of_edges.size() / 2);
    std::nth_element(of_edges.begin(), middle, of_edges.end());
    if (is_known && std::abs(*middle) >= std::abs(usual)) continue;
    usual = *middle;
    is_known = true;
  }
  return usual;
}

std::int64_t LinkMotion::Start() const {
  return first_recorded_ > 0 ? first_recorded_ - UsualDelay(true) : first_stamp_;
}

void LinkMotion::AddClockFindings(const std::set<std::string>& above, Findings* findings) const {
  if (options_.topics.use_record_times) return;
  const std::int64_t usual = UsualDelay(false);
  std::map<Source, std::vector<std::string>> off;  // edges
  std::map<Source, std::size_t> judged;
  for (const auto& [child, edge] : edges_) {
    if (!edge.is_followed || above.count(child) > 0 || edge.delays.count() < kFewestDelays)
      continue;
    // Constant transforms are stamped ahead by their senders, and do no harm.
    if (!edge.moves) continue;
    ++judged[edge.source];
    const double delay = ToSeconds(edge.delays.Median() - usual);
    const bool is_above = !vehicle_.HasLink(child);
    if (std::abs(delay) > (is_above ? kSameClockAbove : kSameClock))
      off[edge.source].push_back(child);
  }
  for (const auto& [source, children] : off) {
    const auto delay_of = [&](const std::string& child) {
      return edges_.at(child).delays.Median() - usual;
    };
    const std::string& worst =
        *std::max_element(children.begin(), children.end(), [&](const auto& a, const auto& b) {
          return std::abs(delay_of(a)) < std::abs(delay_of(b));
        });
    const double delay = ToSeconds(delay_of(worst));
    Finding finding;
    finding.kind = "clock_off";
    finding.topic = ToString(source);
    finding.subject = SubjectOf(children);
    if (children.size() == judged[source]) finding.subject = finding.topic;
    finding.what = "is stamped " + FormatRounded(std::abs(delay)) + " s " +
                   (delay > 0 ? "behind" : "ahead of") +
                   " the other topics, by the times at which both were recorded";
    finding.remedy =
        "do its stamps come from another clock, or are they of publishing? set the "
        "clocks by one another, or " +
        UseRecordTimes();
    finding.count = edges_.at(worst).delays.count();
    finding.first = finding.worst = edges_.at(worst).first;
    finding.size = delay;
    finding.limit = kSameClock;
    finding.unit = "s";
    findings->push_back(std::move(finding));
  }
}

// A clock that goes at another rate than the others', or was set while one topic was recorded.
void LinkMotion::AddDriftFindings(const std::set<std::string>& above, Findings* findings) const {
  if (options_.topics.use_record_times) return;
  std::map<Source, std::vector<std::string>> topics;
  for (const auto& [child, edge] : edges_)
    // A clock that was set is told as such.
    if (edge.is_followed && above.count(child) == 0 && edge.delays.count() > 0 &&
        edge.set_back + edge.set_forward == 0)
      topics[edge.source].push_back(child);
  const auto change_of = [&](const std::string& child) { return edges_.at(child).delays.Change(); };
  std::map<Source, std::pair<std::int64_t, std::string>> changes;  // the middle one of each topic
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  for (auto& [source, children] : topics) {
    std::sort(children.begin(), children.end(), [&](const auto& a, const auto& b) {
      return std::make_pair(change_of(a), a) < std::make_pair(change_of(b), b);
    });
    const std::string& middle = children[children.size() / 2];
    changes[source] = {change_of(middle), middle};
    if (std::abs(change_of(middle)) < std::abs(least)) least = change_of(middle);
  }
  for (const auto& [source, change] : changes) {
    const double seconds = ToSeconds(change.first - least);
    if (std::abs(seconds) < kSameChange) continue;
    const Edge& edge = edges_.at(change.second);
    Finding finding;
    finding.kind = "clock_drifts";
    finding.subject = finding.topic = ToString(source);
    finding.what = "is stamped " + FormatRounded(std::abs(seconds)) + " s " +
                   (seconds > 0 ? "farther behind" : "farther ahead of") +
                   " the other topics at its end than at its begin, by the times of recording";
    finding.remedy =
        "does its clock go at another rate, or was it set meanwhile? " + UseRecordTimes();
    finding.count = edge.delays.count();
    finding.first = finding.worst = edge.last;
    finding.size = seconds;
    finding.limit = kSameChange;
    finding.unit = "s";
    findings->push_back(std::move(finding));
  }
}

void LinkMotion::AddSetClockFindings(const std::set<std::string>& above, Findings* findings) const {
  for (const bool back : {true, false}) {
    // The edges of one topic have it together.
    using Alike = std::tuple<Source, std::uint64_t, std::int64_t>;
    std::map<Alike, std::vector<std::string>> alike;
    for (const auto& [child, edge] : edges_) {
      const std::uint64_t count = back ? edge.set_back : edge.set_forward;
      if (!edge.is_followed || above.count(child) > 0 || count == 0) continue;
      const std::int64_t first = back ? edge.first_set_back : edge.first_set_forward;
      alike[{edge.source, count, first / 500'000'000}].push_back(child);
    }
    for (const auto& [key, children] : alike) {
      const Edge& edge = edges_.at(children[0]);
      Finding finding;
      finding.kind = back ? "clock_set_back" : "clock_jump";
      finding.subject = SubjectOf(children);
      finding.topic = ToString(edge.source);
      finding.count = back ? edge.set_back : edge.set_forward;
      finding.first = back ? edge.first_set_back : edge.first_set_forward;
      finding.worst = back ? edge.most_set_back_at : edge.most_set_forward_at;
      finding.size = ToSeconds(back ? edge.most_set_back : edge.most_set_forward);
      finding.limit = back ? 0 : ToSeconds(kSetForward);
      finding.unit = "s";
      finding.what =
          std::string("has stamps that ") + (back ? "go back" : "leap ahead") + " by " +
          FormatRounded(finding.size) + " s" +
          (finding.count > 1 ? " and less, " + std::to_string(finding.count) + " times" : "") +
          (back ? ": that time is there twice, its second samples are left out, and the "
                  "pose leaps behind them"
                : ", though messages were recorded as evenly as before: its motion is "
                  "stretched there");
      finding.remedy =
          "was a clock set meanwhile? cut the recording there (--start, --duration), or " +
          UseRecordTimes();
      findings->push_back(std::move(finding));
    }
  }
}

void LinkMotion::AddGapFindings(const std::set<std::string>& above, Findings* findings) const {
  // The joints of one message have their gaps together.
  using Alike = std::tuple<Source, std::uint64_t, std::int64_t, std::int64_t>;
  std::map<Alike, std::vector<std::string>> alike;
  for (const auto& [child, edge] : edges_) {
    if (!edge.is_followed || above.count(child) > 0 || edge.gaps == 0) continue;
    alike[{edge.source, edge.gaps, edge.first_gap, edge.longest_gap}].push_back(child);
  }
  for (const auto& [key, children] : alike) {
    const Edge& edge = edges_.at(children[0]);
    Finding finding;
    finding.kind = "gap";
    finding.subject = SubjectOf(children);
    finding.topic = ToString(edge.source);
    finding.count = edge.gaps;
    finding.first = edge.first_gap;
    finding.worst = edge.longest_gap_at;
    finding.size = ToSeconds(edge.longest_gap);
    finding.limit = options_.max_gap;
    finding.unit = "s";
    finding.what = edge.gaps == 1 ? "has a gap of " + FormatRounded(finding.size) + " s"
                                  : "has " + std::to_string(edge.gaps) + " gaps, of up to " +
                                        FormatRounded(finding.size) + " s";
    const double recorded = ToSeconds(edge.longest_gap_recorded);
    if (edge.longest_gap_recorded > 0 && recorded < finding.size / 2) {
      finding.kind = "clock_jump";
      finding.what += " between stamps, recorded within " + FormatRounded(recorded) + " s";
      finding.remedy = "was a clock set? " + UseRecordTimes();
    } else {
      finding.remedy =
          "its pose is held meanwhile: are messages lost, or is it sent too rarely? record all of "
          "it, or " +
          Option("max-gap", "S") + " interpolates across gaps of up to S seconds";
    }
    findings->push_back(std::move(finding));
  }
}

void LinkMotion::AddUnconnectedFindings(Findings* findings) const {
  for (const std::string& frame : WayAboveVehicle()) {
    const auto edge = edges_.find(frame);
    if (edge != edges_.end() && edge->second.moves) return;
  }
  std::vector<std::string> children;
  std::int64_t first = 0;
  for (const auto& [child, edge] : edges_) {
    const bool moves = edge.source == Source::kTf && edge.moves && !edge.is_followed;
    if (!moves || JointAbove(child) || IsAbove(vehicle_.root, child)) continue;
    if (children.empty()) first = edge.first;
    children.push_back(child);
  }
  if (children.empty()) return;
  const std::string nearest = NearestWord(vehicle_.root, children);
  const std::string& child = nearest.empty() ? children.front() : nearest;
  Finding finding;
  finding.kind = "unconnected";
  finding.subject = edges_.at(child).parent + " -> " + child;
  finding.topic = options_.topics.tf;
  finding.what = "moves and leads to no link, and the vehicle's root '" + vehicle_.root +
                 "' stands still: the motion of the body is not in this run";
  finding.remedy = "record the transform from '" + child + "' to '" + vehicle_.root +
                   "' as well, or has one of them another name?";
  finding.count = edges_.at(child).samples;
  finding.first = finding.worst = first;
  findings->push_back(std::move(finding));
}

std::pair<std::int64_t, std::int64_t> LinkMotion::Recorded(
    const std::set<std::string>& above) const {
  constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
  std::int64_t first = kNever, last = 0, begin = first_stamp_, end = last_stamp_;
  for (const auto& [child, edge] : edges_) {
    if (!edge.is_followed || above.count(child) > 0 || edge.samples == 0) continue;
    begin = std::min(begin, edge.first);
    end = std::max(end, edge.last);
    // Senders of constant transforms stamp them ahead: how long the recording is, others say.
    if (!edge.moves) continue;
    first = std::min(first, edge.first);
    last = std::max(last, edge.last);
  }
  return last > 0 ? std::make_pair(first, last) : std::make_pair(begin, end);
}

std::vector<ConstantEdge> LinkMotion::Constants(const std::string& world) const {
  std::vector<ConstantEdge> constants;
  if (clear_count_ > 0) return constants;
  const std::set<std::string> above = Above(world);
  const auto [first, last] = Recorded(above);
  for (const auto& [child, edge] : edges_) {
    const bool is_constant = edge.source == Source::kTf && edge.is_followed && !edge.moves &&
                             edge.samples > 1 && above.count(child) == 0;
    const bool is_whole = edge.first <= first && edge.last >= last;
    const double holds = kHolds * static_cast<double>(edge.longest_interval);
    if (!is_constant || is_whole || static_cast<double>(edge.first - first) > holds ||
        static_cast<double>(last - edge.last) > holds)
      continue;
    constants.push_back({edge.parent, child, edge.last_pose, ToSeconds(edge.longest_interval)});
  }
  return constants;
}

Findings LinkMotion::CoverageFindings(const std::string& world, bool* nothing) const {
  *nothing = false;
  const std::set<std::string> above = Above(world);
  std::map<std::pair<Source, std::pair<std::int64_t, std::int64_t>>, std::vector<std::string>>
      alike;
  std::set<std::string> hold;
  for (const ConstantEdge& constant : Constants(world)) hold.insert(constant.child);
  std::int64_t begin = 0, end = std::numeric_limits<std::int64_t>::max();
  for (const auto& [child, edge] : edges_) {
    if (!edge.is_followed || above.count(child) > 0 || edge.samples == 0 || hold.count(child) > 0)
      continue;
    alike[{edge.source, {edge.first, edge.last}}].push_back(child);
    begin = std::max(begin, edge.first);
    end = std::min(end, edge.last);
  }
  // After a loop only its last part is known here.
  if (alike.empty() || clear_count_ > 0) return {};
  const auto [first, last] = Recorded(above);
  const double whole = ToSeconds(last - first);
  const double kept = ToSeconds(end - begin);
  *nothing = kept <= 0 && whole > kInstant;
  if (whole <= kInstant) {
    Finding finding;
    finding.kind = "one_instant";
    finding.subject = "the recording";
    finding.what = "has one instant only: there is no motion to simulate";
    finding.remedy = "record the motion, not only where the vehicle stands";
    finding.count = 1;
    finding.first = finding.worst = first;
    return {finding};
  }
  const auto is_lost = [&](double time) {
    return (time > kLeastLost && time > kLeastShare * whole) ||
           (time > kLargeShare * whole && time > kInstant);
  };
  Findings findings;
  for (const auto& [known, children] : alike) {
    const Edge& edge = edges_.at(children[0]);
    const double late = ToSeconds(edge.first - first), early = ToSeconds(last - edge.last);
    if (!is_lost(late) && !is_lost(early)) continue;
    // Another one limits the run more.
    if (edge.first < begin && edge.last > end) continue;
    Finding finding;
    finding.kind = "limits_the_run";
    finding.subject = SubjectOf(children);
    finding.topic = ToString(edge.source);
    finding.count = edge.samples;
    finding.first = finding.worst = is_lost(early) ? edge.last : edge.first;
    finding.size = is_lost(early) ? early : late;
    finding.unit = "s";
    finding.what = edge.samples == 1 ? "has one sample only"
                                     : "has " + std::to_string(edge.samples) + " samples";
    if (edge.samples > 1 && is_lost(early))
      finding.what += ", the last one " + Printed("%.3f s", early) + " before the recording ends";
    if (edge.samples > 1 && is_lost(late))
      finding.what += ", the first one " + Printed("%.3f s", late) + " after the recording begins";
    finding.what += ": the run has " + Printed("%.3f s", std::max(kept, 0.0)) + " of " +
                    Printed("%.3f s", whole);
    // The same stretch of time by another clock.
    const auto shifted = std::find_if(alike.begin(), alike.end(), [&](const auto& other) {
      const auto& [other_first, other_last] = other.first.second;
      const double at_begin = ToSeconds(other_first - edge.first);
      return edge.moves && edges_.at(other.second[0]).moves && is_lost(std::abs(at_begin)) &&
             std::abs(at_begin - ToSeconds(other_last - edge.last)) < kSameShift;
    });
    if (shifted != alike.end()) {
      const double shift = ToSeconds(shifted->first.second.first - edge.first);
      finding.remedy = "it begins and ends " + FormatRounded(std::abs(shift)) + " s " +
                       (shift > 0 ? "before " : "after ") + SubjectOf(shifted->second) + " (" +
                       ToString(shifted->first.first) +
                       ") does: are these stamps of two clocks? set them by one another, or " +
                       UseRecordTimes();
      // Once for both.
      if (shift > 0) findings.push_back(std::move(finding));
      continue;
    }
    // One that follows another joint is held with that.
    const JointModel* joint = nullptr;
    for (const std::string& child : children)
      if (joint == nullptr || !joint->mimic.empty()) joint = JointAbove(child);
    const bool by_joint = edge.source == Source::kJointStates;
    finding.remedy = edge.moves ? "record it to the end"
                     : by_joint
                         ? "publish the joint in each message, also where it stands still"
                         : "if it never changes, publish it on " + ToString(Source::kTfStatic) +
                               "; if it moves, record all of it";
    if (joint != nullptr && joint->type != JointModel::Type::kFixed) {
      finding.remedy +=
          ", or keep it at rest by " +
          (options_.is_node ? "~hold_joints: [" + joint->name + "]" : "--hold " + joint->name);
    } else if (!vehicle_.HasLink(children[0]) || children[0] == vehicle_.root) {
      finding.remedy +=
          ", or take the frame below as inertial by " + Option("world-frame", children[0]);
    }
    findings.push_back(std::move(finding));
  }
  return findings;
}

std::string LinkMotion::UnstampedText(const Unstamped& unstamped) const {
  const std::string samples =
      unstamped.samples == 1 ? "the only sample of it by "
                             : "all " + std::to_string(unstamped.samples) + " samples of it by ";
  return samples + ToString(unstamped.source) +
         (unstamped.samples == 1 ? " has no stamp: " : " have no stamp: ") + UseRecordTimes();
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
    reason += std::string(": are stamps of two clocks in it? Then ") + UseRecordTimes();
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
                        " have no stamp and are left out, others have one: " + UseRecordTimes() +
                        " of all");
  }
  std::map<Source, std::vector<std::string>> frozen;
  if (warnings_.counts().count("sample repeated with the same stamp") > 0)
    for (const auto& [child, edge] : edges_)
      if (edge.samples == 1 && edge.is_followed) frozen[edge.source].push_back(child);
  for (const auto& [source, children] : frozen) {
    sentences.push_back(
        "all samples of frame '" + children[0] + "'" +
        (children.size() > 1 ? " and of " + std::to_string(children.size() - 1) + " more" : "") +
        " by " + ToString(source) + " have one and the same stamp: " + UseRecordTimes());
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
