#include "cosserat_cable/ros/link_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cosserat_cable/ros/conversions.h"
#include "cosserat_cable/vehicle/joint_positions.h"

namespace cosserat_cable {
namespace {

// Transports reorder messages by some hundredths of a second; a bag that starts over jumps by its
// length.
constexpr std::int64_t kBackwardsJump = 500'000'000;  // [ns]
// A tree deeper than this has a cycle.
constexpr std::size_t kMaxDepth = 1000;

}  // namespace

std::string ToString(LinkMotion::Source source, const MotionTopics& topics) {
  switch (source) {
    case LinkMotion::Source::kUrdf:
      return "the URDF";
    case LinkMotion::Source::kTfStatic:
      return topics.tf_static();
    case LinkMotion::Source::kTf:
      return topics.tf;
    case LinkMotion::Source::kJointStates:
      return topics.joint_states;
  }
  return "";
}

std::string LinkMotion::ToString(Source source) const {
  return cosserat_cable::ToString(source, options_.topics);
}

LinkMotion::LinkMotion(const VehicleModel& vehicle, const std::vector<std::string>& links,
                       LinkMotionOptions options)
    : vehicle_(vehicle), links_(links), options_(std::move(options)), tree_(options_.max_gap) {
  options_.tf_prefix = WholePrefix(options_.tf_prefix);
  options_.world_frame = Own(options_.world_frame);
  if (options_.judge) judge_.emplace(vehicle_, options_.max_gap);
  for (const JointModel& joint : vehicle_.joints) {
    joint_above_[joint.child] = &joint;
    joints_[joint.name] = &joint;
    if (!joint.mimic.empty()) mimics_.emplace(joint.mimic, &joint);
    const bool held =
        std::count(options_.held_joints.begin(), options_.held_joints.end(), joint.name) > 0;
    if (joint.type == JointModel::Type::kFixed || held) {
      AddFixed(joint.parent, joint.child, joint.Evaluate(RestPosition(vehicle_, joint)),
               Source::kUrdf);
    }
  }
  UpdateTree();
}

const JointModel* LinkMotion::JointAbove(const std::string& link) const {
  const auto found = joint_above_.find(link);
  return found == joint_above_.end() ? nullptr : found->second;
}

std::vector<LinkMotion::Step> LinkMotion::Ascend(const std::string& frame) const {
  std::vector<Step> way;
  std::string child = frame;
  while (child != options_.world_frame && way.size() < kMaxDepth) {
    const JointModel* joint = JointAbove(child);
    const auto edge = edges_.find(child);
    if (edge != edges_.end()) {
      way.push_back({child, edge->second.parent, joint});
    } else if (joint != nullptr) {
      way.push_back({child, joint->parent, joint});
    } else {
      break;
    }
    child = way.back().parent;
  }
  return way;
}

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

void LinkMotion::UpdateTree() {
  relevant_.clear();
  std::set<std::string> roots;
  for (const std::string& link : links_) {
    const std::vector<Step> way = Ascend(link);
    for (const Step& step : way) relevant_.insert(step.child);
    roots.insert(way.empty() ? link : way.back().parent);
  }
  // An edge above what is the root now may still come.
  relevant_.insert(roots.begin(), roots.end());
  world_ = options_.world_frame;
  if (world_.empty() && roots.size() == 1) world_ = *roots.begin();
  for (auto& [child, edge] : edges_) edge.is_followed = relevant_.count(child) > 0;
  followed_.assign(links_.size(), {});
}

LinkMotion::Edge* LinkMotion::AcceptSource(const std::string& parent, const std::string& child,
                                           Source source) {
  const auto found = edges_.find(child);
  if (found == edges_.end()) {
    if (IsAbove(child, parent)) {
      warnings_.Count("frame '" + child + "' would be above itself",
                      "'" + parent + " -> " + child + "' by " + ToString(source) +
                          " closes a loop of frames and is ignored");
      return nullptr;
    }
    Edge* edge = &edges_[child];
    edge->parent = parent;
    edge->source = source;
    UpdateTree();
    return edge;
  }
  Edge* edge = &found->second;
  if (edge->parent != parent) {
    warnings_.Count("frame '" + child + "' has two parents",
                    "'" + edge->parent + "' by " + ToString(edge->source) + " is kept, '" + parent +
                        "' by " + ToString(source) + " is ignored");
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
  if (edge->source == Source::kUrdf && source == Source::kJointStates) return nullptr;
  warnings_.Count(
      "frame '" + child + "' comes from two sources",
      std::string(ToString(edge->source)) + " is kept, " + ToString(source) + " is ignored");
  return nullptr;
}

void LinkMotion::AddFixed(const std::string& parent, const std::string& child, const Pose& X_PC,
                          Source source) {
  Edge* edge = AcceptSource(parent, child, source);
  if (!edge) return;
  tree_.SetFixed(parent, child, X_PC);
  if (judge_ && source == Source::kTfStatic && edge->is_followed)
    judge_->AddFixed(parent, child, X_PC, ToString(source));
}

void LinkMotion::SetPublisher(const std::string& name, Source source) {
  if (!judge_ || (publisher_number_ >= 0 && source == publisher_source_ && name == publisher_)) {
    return;
  }
  publisher_ = name;
  publisher_source_ = source;
  publisher_number_ =
      judge_->Publisher((name.empty() ? "somebody" : name) + " on " + ToString(source));
}

void LinkMotion::AddSample(const std::string& parent, const std::string& child, std::int64_t stamp,
                           const Pose& X_PC, Source source, const double* position) {
  if (stamp <= 0) {
    warnings_.Count(std::string("sample without a stamp by ") + ToString(source), child);
    Unstamped& unstamped = unstamped_[child];
    unstamped.parent = parent;
    unstamped.source = source;
    ++unstamped.samples;
    return;
  }
  Edge* edge = AcceptSource(parent, child, source);
  if (!edge) {
    JudgeRejected(parent, child, stamp, X_PC);
    return;
  }
  if (edge->samples > 0 && stamp < edge->last - kBackwardsJump) {
    Clear();
    warnings_.Count("time ran backwards");
  }
  if (!has_epoch_) {
    has_epoch_ = true;
    epoch_ = stamp;
  }
  // What is above the frame that the user takes as inertial moves nothing.
  if (judge_ && edge->is_followed && child != options_.world_frame) {
    if (!edge->judged) edge->judged = judge_->At(parent, child);
    judge_->AddSaid(edge->judged, publisher_number_, stamp, X_PC);
  }
  const bool in_order = edge->samples == 0 || stamp > edge->last;
  if (!in_order) {
    warnings_.Count(stamp == edge->last ? "sample repeated with the same stamp"
                                        : "sample older than the one before it",
                    "frame '" + child + "' by " + ToString(source));
    return;
  }
  if (edge->samples == 0) {
    edge->first = stamp;
  } else {
    const std::int64_t interval = stamp - edge->last;
    edge->longest_interval = std::max(edge->longest_interval, interval);
    if (edge->gap_rule.IsGap(static_cast<double>(interval) * 1e-9, options_.max_gap,
                             edge->last_pose, X_PC)) {
      ++edge->gaps;
    }
    edge->moves = edge->gap_rule.moves();
  }
  edge->last_pose = X_PC;
  edge->last = stamp;
  ++edge->samples;
  last_stamp_ = std::max(last_stamp_, stamp);
  if (!edge->is_followed) return;
  if (!edge->samples_of) edge->samples_of = tree_.MovingEdge(parent, child);
  Judge(edge, child, stamp, X_PC, position);
  if (!(options_.smooth > 0)) {
    Deliver(edge, child, stamp, X_PC);
    return;
  }
  if (!edge->smoother) {
    edge->smoother =
        &smoothers_.try_emplace(child, options_.smooth, options_.max_gap).first->second;
  }
  edge->smoother->Add(stamp, X_PC, [&](std::int64_t smooth_stamp, const Pose& X) {
    Deliver(edge, child, smooth_stamp, X);
  });
}

// As it was recorded.
void LinkMotion::Judge(Edge* edge, const std::string& child, std::int64_t stamp, const Pose& X_PC,
                       const double* position) {
  if (!edge->judged) return;
  edge->judged->topic = ToString(edge->source);
  const JointModel* joint = edge->judged->joint ? JointAbove(child) : nullptr;
  if (!joint) return;
  if (position) {
    edge->judged->joint->Add(stamp, *position);
  } else {
    edge->judged->joint->Add(stamp, X_PC);
  }
}

// As the links follow it.
void LinkMotion::Deliver(Edge* edge, const std::string& child, std::int64_t stamp,
                         const Pose& X_PC) {
  if (edge->judged) judge_->AddMotion(edge->judged, stamp, X_PC);
  if (!tree_.Append(edge->samples_of, Seconds(stamp), X_PC)) {
    warnings_.Count("sample ignored by the motion curve",
                    "frame '" + child + "' by " + ToString(edge->source));
  }
}

// What does not count may still contradict what does.
void LinkMotion::JudgeRejected(const std::string& parent, const std::string& child,
                               std::int64_t stamp, const Pose& X_PC) {
  if (!judge_) return;
  const auto known = edges_.find(child);
  if (known == edges_.end() || known->second.parent != parent || !known->second.judged) return;
  judge_->AddSaid(known->second.judged, publisher_number_, stamp, X_PC);
}

RecordingJudge::Way LinkMotion::WayAboveVehicle() const {
  RecordingJudge::Way way = {vehicle_.root};
  for (const Step& step : Ascend(vehicle_.root)) way.push_back(step.parent);
  return way;
}

Findings LinkMotion::MotionFindings(const std::string& world) const {
  return judge_ ? judge_->Report(WayAboveVehicle(), world) : Findings();
}

std::string LinkMotion::SmoothWorld() const {
  if (!judge_ || world_.empty() || !options_.world_frame.empty()) return world_;
  const RecordingJudge::Way way = WayAboveVehicle();
  return way.back() == world_ ? judge_->SmoothFrame(way) : world_;
}

void LinkMotion::Ingest(const tf2_msgs::TFMessage& message, bool is_static,
                        const std::string& publisher) {
  const Source source = is_static ? Source::kTfStatic : Source::kTf;
  SetPublisher(publisher, source);
  for (const geometry_msgs::TransformStamped& transform : message.transforms) {
    const std::string parent = Own(transform.header.frame_id);
    const std::string child = Own(transform.child_frame_id);
    Pose X_PC;
    if (parent.empty() || child.empty() || parent == child) {
      warnings_.Count(std::string("transform without proper frame ids by ") + ToString(source),
                      "'" + parent + "' -> '" + child + "'");
    } else if (!ToPose(transform.transform, &X_PC)) {
      warnings_.Count(
          std::string("transform that is no rotation or not finite by ") + ToString(source),
          "'" + parent + "' -> '" + child + "'");
    } else if (is_static) {
      AddFixed(parent, child, X_PC, source);
    } else {
      AddSample(parent, child, ToNanoseconds(transform.header.stamp), X_PC, source);
    }
  }
}

void LinkMotion::IngestJoint(const JointModel& joint, double position, std::int64_t stamp) {
  AddSample(joint.parent, joint.child, stamp, joint.Evaluate(position), Source::kJointStates,
            &position);
}

void LinkMotion::Ingest(const sensor_msgs::JointState& message, const std::string& publisher) {
  SetPublisher(publisher, Source::kJointStates);
  const std::int64_t stamp = ToNanoseconds(message.header.stamp);
  if (message.position.size() != message.name.size()) {
    warnings_.Count("joint state without a position for each name");
    return;
  }
  // One publisher's messages have the same names each time.
  if (message.name != named_) {
    named_ = message.name;
    named_joints_.clear();
    for (const std::string& name : named_) {
      const auto joint = joints_.find(Own(name));
      named_joints_.push_back(joint == joints_.end() ? nullptr : joint->second);
    }
  }
  for (std::size_t i = 0; i < named_.size(); ++i) {
    const JointModel* joint = named_joints_[i];
    const double position = message.position[i];
    if (joint == nullptr) {
      warnings_.Count("joint not in the URDF", "'" + named_[i] + "'");
      unknown_joints_.insert(named_[i]);
    } else if (!std::isfinite(position)) {
      warnings_.Count("joint position not finite", "'" + named_[i] + "'");
    } else if (joint->type != JointModel::Type::kFloating &&
               joint->type != JointModel::Type::kFixed && joint->mimic.empty()) {
      IngestJoint(*joint, position, stamp);
      const auto followers = mimics_.equal_range(joint->name);
      for (auto it = followers.first; it != followers.second; ++it) {
        const JointModel& follower = *it->second;
        IngestJoint(follower, follower.mimic_multiplier * position + follower.mimic_offset, stamp);
      }
    }
  }
}

void LinkMotion::Finish() {
  for (auto& [child, smoother] : smoothers_) {
    Edge* edge = &edges_.at(child);
    smoother.Finish(
        [&, name = child](std::int64_t stamp, const Pose& X) { Deliver(edge, name, stamp, X); });
  }
  tree_.Finish();
}

void LinkMotion::Clear() {
  tree_.Clear();
  if (judge_) judge_->Restart();
  for (auto& [child, smoother] : smoothers_) smoother.Clear();
  for (auto& [child, edge] : edges_) {
    edge.samples = 0;
    edge.gap_rule = GapRule();
    edge.first = edge.last = 0;
  }
  has_epoch_ = false;
  last_stamp_ = 0;
  ++clear_count_;
}

std::vector<std::string> LinkMotion::Missing() const {
  std::set<std::string> reasons;
  if (world_.empty()) {
    reasons.insert(
        "the links have no common root frame; say which frame is inertial by world_frame");
  }
  for (const std::string& link : links_) {
    const std::vector<Step> way = Ascend(link);
    const std::string root = way.empty() ? link : way.back().parent;
    if (!world_.empty() && root != world_) {
      reasons.insert("no transform leads from the world frame '" + world_ + "' to link '" + link +
                     "' (its tree ends at '" + root + "')");
    }
    for (const Step& step : way) {
      if (edges_.count(step.child) > 0) continue;
      const std::string joint =
          "joint '" + step.joint->name + "' moves link '" + step.child + "', but ";
      const auto unstamped = unstamped_.find(step.child);
      if (unstamped == unstamped_.end()) {
        reasons.insert(joint + "neither " + ToString(Source::kTf) + " nor " +
                       ToString(Source::kJointStates) + " drives it");
      } else {
        reasons.insert(joint + UnstampedText(unstamped->second));
      }
    }
  }
  // A vehicle whose own motion is without stamps would stand still otherwise.
  for (const auto& [child, unstamped] : unstamped_) {
    if (edges_.count(child) > 0 || relevant_.count(child) == 0 || JointAbove(child) != nullptr ||
        child == options_.world_frame) {
      continue;
    }
    reasons.insert("frame '" + child + "' is moved in '" + unstamped.parent + "', but " +
                   UnstampedText(unstamped));
  }
  return {reasons.begin(), reasons.end()};
}

bool LinkMotion::Range(std::int64_t* begin, std::int64_t* ready) const {
  double first = -std::numeric_limits<double>::infinity();
  double last = std::numeric_limits<double>::infinity();
  for (const std::string& link : links_) {
    if (link == world_) continue;
    first = std::max(first, tree_.BeginTime(world_, link));
    last = std::min(last, tree_.ReadyUntil(world_, link));
  }
  if (!has_epoch_ || first == std::numeric_limits<double>::infinity() ||
      last == -std::numeric_limits<double>::infinity()) {
    return false;
  }
  const auto to_stamp = [this](double seconds) {
    return epoch_ + static_cast<std::int64_t>(std::llround(seconds * 1e9));
  };
  // Infinite where every edge is fixed.
  *begin = std::isfinite(first) ? to_stamp(first) : epoch_;
  *ready = std::isfinite(last) ? to_stamp(last) : last_stamp_;
  return true;
}

Motion LinkMotion::Evaluate(const std::string& link, std::int64_t time) const {
  if (link == world_) return Motion();
  return tree_.Evaluate(world_, link, Seconds(time));
}

Motion LinkMotion::Follow(std::size_t i, std::int64_t time) {
  if (!followed_[i]) {
    if (links_[i] == world_) return Motion();
    followed_[i] = tree_.FindLink(world_, links_[i]);
  }
  return tree_.Follow(followed_[i], Seconds(time));
}

bool LinkMotion::InGap(const std::string& link, std::int64_t time) const {
  return link != world_ && tree_.InGap(world_, link, Seconds(time));
}

std::uint64_t LinkMotion::gap_count() const {
  std::uint64_t gaps = 0;
  for (const std::string& child : relevant_) {
    const auto edge = edges_.find(child);
    if (edge != edges_.end()) gaps += edge->second.gaps;
  }
  return gaps;
}

void LinkMotion::DropBefore(std::int64_t time) { tree_.DropBefore(Seconds(time)); }

}  // namespace cosserat_cable
