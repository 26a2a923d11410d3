// Which source counts for an edge of LinkMotion's tree, and what is told of the others.
#include <algorithm>
#include <cmath>
#include <utility>

#include "cosserat_cable/input/number_text.h"
#include "cosserat_cable/ros/conversions.h"
#include "cosserat_cable/ros/link_motion.h"

namespace cosserat_cable {
namespace {

// What was rounded, or measured anew, is the same pose [m], [rad].
constexpr double kSameTranslation = 1e-3, kSameRotation = 2e-3;
// What went silent for so long no longer speaks against what is sent all that time [ns], samples.
constexpr std::int64_t kSilent = 2'000'000'000;
constexpr std::int64_t kManySamples = 5;

}  // namespace

bool LinkMotion::IsAbove(const std::string& ancestor, const std::string& frame) const {
  // Edges form no loop, joints do not either, and both together end at the latest with all of them.
  std::string child = frame;
  for (std::size_t depth = 0; depth <= edges_.size() + joint_above_.size(); ++depth) {
    if (child == ancestor) return true;
    const auto edge = edges_.find(child);
    const JointModel* joint = JointAbove(child);
    if (edge == edges_.end() && joint == nullptr) return false;
    child = edge != edges_.end() ? edge->second.parent : joint->parent;
  }
  return true;
}

// The first to come holds the place of its frame. Where that was a mistake of a moment, what is
// true must not be ignored for good.
std::string LinkMotion::RivalOf(const std::string& parent, const std::string& child) const {
  const auto is_moving = [](const Edge& edge) { return edge.source == Source::kTf; };
  const auto own = edges_.find(child);
  if (own != edges_.end()) return is_moving(own->second) ? child : "";
  std::string rival, frame = parent;
  std::int64_t oldest = 0;
  for (std::size_t depth = 0; depth <= edges_.size() && frame != child; ++depth) {
    const auto edge = edges_.find(frame);
    if (edge == edges_.end()) break;
    if (is_moving(edge->second) && (rival.empty() || edge->second.last < oldest)) {
      rival = frame;
      oldest = edge->second.last;
    }
    frame = edge->second.parent;
  }
  return rival;
}

bool LinkMotion::OutlivesRival(const std::string& parent, const std::string& child, Source source) {
  // A recording is judged as a whole, and tells of both.
  if (!options_.is_node || source != Source::kTf) return false;
  const std::string rival = RivalOf(parent, child);
  if (rival.empty()) return false;
  const Edge& edge = edges_.at(rival);
  Contender& contender = contenders_[{parent, child}];
  if (contender.count == 0 || contender.rival_last != edge.last ||
      message_stamp_ < contender.first) {
    contender = {edge.last, message_stamp_, 0};
  }
  if (++contender.count < kManySamples || message_stamp_ - contender.first < kSilent) return false;
  const std::string gone = "'" + edge.parent + "' -> '" + rival + "'";
  const std::string now = "'" + parent + "' -> '" + child + "'";
  contenders_.clear();
  edges_.erase(rival);
  smoothers_.erase(rival);
  tree_.Detach(rival);
  if (std::exchange(keeps_world_, false)) options_.world_frame.clear();
  Clear();
  clear_reason_ = gone + " is sent no more, and " + now + " counts instead";
  UpdateTree();
  warnings_.Count(
      "a frame has another parent than before",
      Event("", clear_reason_, "all starts anew there: a frame has one parent at all times",
            message_stamp_));
  return true;
}

void LinkMotion::CountIgnored(Source source, const std::string& why) {
  if (source != Source::kTf && source != Source::kJointStates) return;
  if (ignored_++ == 0) why_ignored_ = why;
}

LinkMotion::Edge* LinkMotion::AcceptSource(const std::string& parent, const std::string& child,
                                           Source source, const Pose& X_PC) {
  const auto found = edges_.find(child);
  if (found == edges_.end()) {
    // The URDF is a tree, and what nothing hangs on is above nothing: a recording may have as many
    // frames as it likes.
    const bool may_be_above = source != Source::kUrdf && parents_.count(child) > 0;
    if (child == parent || (may_be_above && IsAbove(child, parent))) {
      if (OutlivesRival(parent, child, source)) return AcceptSource(parent, child, source, X_PC);
      const std::string why = "'" + parent + " -> " + child + "' by " + ToString(source) +
                              " closes a loop of frames and is ignored";
      const std::string remedy = "record it the other way round, or rename one of the frames";
      warnings_.Count("frame '" + child + "' would be above itself", Event("", why, remedy));
      CountIgnored(source, why + ": " + remedy);
      return nullptr;
    }
    Edge* edge = &edges_[child];
    edge->parent = parent;
    edge->source = source;
    parents_.insert(parent);
    // Elsewhere it changes no link's way up.
    if (relevant_.count(child) > 0) UpdateTree();
    if (keeps_world_ && child == options_.world_frame)
      warnings_.Count("a frame above the inertial one came late",
                      Event("",
                            "'" + parent + "' -> '" + child + "' by " + ToString(source) +
                                " began after the cables had settled in '" + child +
                                "', which stays the inertial frame",
                            "start the node when it is published, or name the frame, " +
                                Option("world-frame", parent),
                            message_stamp_));
    const JointModel* joint = JointAbove(child);
    if (joint != nullptr && joint->parent != parent && edge->is_followed) {
      warnings_.Count(
          "frame '" + child + "' has another parent than in the URDF",
          Event("",
                "'" + parent + "' by " + ToString(source) + ", the URDF has '" + joint->parent +
                    "' (joint '" + joint->name + "'); the recorded one counts",
                "is this the URDF of the vehicle that was recorded? its joint's limits are not "
                "judged"));
    }
    return edge;
  }
  Edge* edge = &found->second;
  if (edge->parent != parent) {
    if (OutlivesRival(parent, child, source)) return AcceptSource(parent, child, source, X_PC);
    std::string remedy =
        "a frame has one parent: stop one of the two publishers, or take its transforms out of the "
        "recording";
    if (edge->source == Source::kUrdf && !vehicle_.HasLink(parent))
      remedy += "; what moves the vehicle has to move its root '" + vehicle_.root + "'";
    const std::string why = "'" + edge->parent + "' by " + ToString(edge->source) + " is kept, '" +
                            parent + "' by " + ToString(source) + " is ignored";
    warnings_.Count("frame '" + child + "' has two parents", Event("", why, remedy));
    CountIgnored(source, "frame '" + child + "' has two parents, " + why + ": " + remedy);
    return nullptr;
  }
  if (edge->source == source) return edge;
  // What was measured and fixed for this vehicle is better than its drawing.
  if (edge->source == Source::kUrdf && source == Source::kTfStatic) return edge;
  // A joint's state and what robot_state_publisher makes of it are one motion: the state itself
  // counts.
  if (edge->source == Source::kTf && source == Source::kJointStates) {
    edge->source = source;
    return edge;
  }
  if (edge->source == Source::kJointStates && source == Source::kTf) return nullptr;
  // Held at zero by the user's word, whatever the recording says.
  const JointModel* joint = JointAbove(child);
  const bool is_held = joint != nullptr && std::count(options_.held_joints.begin(),
                                                      options_.held_joints.end(), joint->name) > 0;
  if (edge->source == Source::kUrdf && (source == Source::kJointStates || is_held)) return nullptr;
  CountContradiction(*edge, child, X_PC, source);
  return nullptr;
}

// What is said twice in the same way is no contradiction.
void LinkMotion::CountContradiction(const Edge& edge, const std::string& child, const Pose& X_PC,
                                    Source source) {
  const bool is_fixed = edge.source == Source::kUrdf || edge.source == Source::kTfStatic;
  const double translation = (X_PC.p - edge.last_pose.p).norm();
  const double rotation = edge.last_pose.q.angularDistance(X_PC.q);
  if (is_fixed && translation <= kSameTranslation && rotation <= kSameRotation) return;
  const std::string kept = ToString(edge.source);
  std::string detail = kept + " is kept, " + ToString(source) + " is ignored";
  if (is_fixed) {
    detail += "; it is " + FormatLength(translation) + " and " +
              FormatRounded(rotation * 180 / M_PI) + " deg off";
  }
  std::string remedy = "publish it as fixed or as moving, not as both";
  if (edge.source == Source::kUrdf) {
    remedy =
        "is this the URDF of the vehicle that was recorded? publish what was measured of a fixed "
        "frame on " +
        ToString(Source::kTfStatic) + ", which counts, or make its joint a moving one";
  }
  Warnings::Event event = Event("", detail, remedy, message_stamp_);
  if (is_fixed) {
    const bool by_place = translation > kSameTranslation;
    event.size = by_place ? 1e3 * translation : rotation * 180 / M_PI;
    event.unit = by_place ? "mm" : "deg";
  }
  warnings_.Count("frame '" + child + "' comes from two sources", event);
}

}  // namespace cosserat_cable
