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
// A sample waits for the next one where its stamp is so many usual intervals behind the last one: one
// of the two is wrong where the next comes at nearly the same time, or before.
constexpr double kLongInterval = 1.5, kTooClose = 0.25;
constexpr std::uint64_t kKnowsTheRate = 4;  // samples
// Later samples with earlier stamps say that its own is wrong.
constexpr int kOvertaken = 3;
// At the end nothing confirms it [usual intervals], [ns].
constexpr double kLongAtTheEnd = 4;
constexpr double kLongestAtTheEnd = 0.5e9;
// Of the mean over the last intervals.
constexpr std::uint64_t kIntervalsOfMean = 16;
constexpr double kLargestOfMean = 3;
// What was rounded, or measured anew, is the same pose [m], [rad].
constexpr double kSameTranslation = 1e-3, kSameRotation = 2e-3;
// A tree deeper than this has a cycle.
constexpr std::size_t kMaxDepth = 1000;

std::string BadTransform(const geometry_msgs::Transform& transform) {
  const auto& r = transform.rotation;
  const double length = std::sqrt(r.x * r.x + r.y * r.y + r.z * r.z + r.w * r.w);
  const auto& t = transform.translation;
  if (!std::isfinite(t.x) || !std::isfinite(t.y) || !std::isfinite(t.z))
    return ", its translation is not finite";
  if (!std::isfinite(length)) return ", its quaternion is not finite";
  return ", its quaternion has the length " + Printed("%.3g", length);
}

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
  for (auto& [child, edge] : edges_) {
    const bool was_followed = std::exchange(edge.is_followed, relevant_.count(child) > 0);
    if (!edge.is_followed || was_followed || edge.samples == 0) continue;
    // What is below it was not known yet when its samples came; the last one may be the only one.
    edge.first = edge.last;
    Sample last;
    last.stamp = edge.last;
    last.X_PC = edge.last_pose;
    Feed(&edge, child, last);
  }
  followed_.assign(links_.size(), {});
}

LinkMotion::Edge* LinkMotion::AcceptSource(const std::string& parent, const std::string& child,
                                           Source source, const Pose& X_PC) {
  const auto found = edges_.find(child);
  if (found == edges_.end()) {
    if (IsAbove(child, parent)) {
      warnings_.Count("frame '" + child + "' would be above itself",
                      Event("",
                            "'" + parent + " -> " + child + "' by " + ToString(source) +
                                " closes a loop of frames and is ignored",
                            "record it the other way round, or rename one of the frames"));
      return nullptr;
    }
    Edge* edge = &edges_[child];
    edge->parent = parent;
    edge->source = source;
    UpdateTree();
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
    const bool moves_a_link = edge->source == Source::kUrdf && !vehicle_.HasLink(parent);
    warnings_.Count(
        "frame '" + child + "' has two parents",
        Event("",
              "'" + edge->parent + "' by " + ToString(edge->source) + " is kept, '" + parent +
                  "' by " + ToString(source) + " is ignored",
              moves_a_link
                  ? "what moves the vehicle has to move its root: record '" + parent + " -> " +
                        vehicle_.root + "', or make '" + child + "' the URDF's root"
                  : "stop one of the two publishers, or take its transforms out of the recording"));
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
    detail += "; it is " + Printed("%.3g mm", 1e3 * translation) + " and " +
              Printed("%.3g deg", rotation * 180 / M_PI) + " off";
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

void LinkMotion::AddFixed(const std::string& parent, const std::string& child, const Pose& X_PC,
                          Source source) {
  Edge* edge = AcceptSource(parent, child, source, X_PC);
  if (!edge) return;
  tree_.SetFixed(parent, child, X_PC);
  edge->last_pose = X_PC;
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

Warnings::Event LinkMotion::Event(const std::string& subject, const std::string& detail,
                                  const std::string& remedy, std::int64_t stamp) const {
  Warnings::Event event;
  event.subject = subject;
  event.detail = detail;
  event.remedy = remedy;
  event.stamp = stamp > 0 ? stamp : message_stamp_ > 0 ? message_stamp_ : recorded_;
  return event;
}

void LinkMotion::AddSample(const std::string& parent, const std::string& child, std::int64_t stamp,
                           const Pose& X_PC, Source source, const double* position) {
  if (stamp <= 0) {
    warnings_.Count(std::string("sample without a stamp by ") + ToString(source),
                    Event("'" + child + "'", child, UseRecordTimes()));
    Unstamped& unstamped = unstamped_[child];
    unstamped.parent = parent;
    unstamped.source = source;
    ++unstamped.samples;
    return;
  }
  if (first_stamp_ == 0) first_stamp_ = stamp;
  message_stamp_ = stamp;
  Edge* edge = AcceptSource(parent, child, source, X_PC);
  if (!edge) {
    JudgeRejected(parent, child, stamp, X_PC);
    return;
  }
  Sample sample;
  sample.stamp = stamp;
  sample.X_PC = X_PC;
  if (position) sample.position = *position;
  sample.recorded = recorded_;
  sample.publisher = publisher_number_;
  if (edge->samples > 0 && stamp < edge->last - kBackwardsJump &&
      !RunsBackwards(child, *edge, sample)) {
    return;
  }
  if (!has_epoch_) {
    has_epoch_ = true;
    epoch_ = stamp;
  }
  ResolveHeld(edge, child, sample);
  const bool in_order = edge->samples == 0 || stamp > edge->last;
  if (!in_order) {
    JudgeSaid(edge, child, sample);
    Warnings::Event event =
        Event("'" + child + "'", "frame '" + child + "' by " + ToString(source),
              stamp == edge->last
                  ? "it is left out: do two publishers send it, or is a message recorded twice?"
                  : "it is left out: are stamps late or early, or do two publishers send it?",
              stamp);
    if (stamp != edge->last) {
      event.size = static_cast<double>(edge->last - stamp) * 1e-9;
      event.unit = "s";
    }
    warnings_.Count(stamp == edge->last ? "sample repeated with the same stamp"
                                        : "sample older than the one before it",
                    event);
    return;
  }
  if (!early_.empty()) ForgetEarly(child);
  const double interval = static_cast<double>(stamp - edge->last);
  if (!edge->held && edge->samples >= kKnowsTheRate &&
      interval > kLongInterval * edge->usual_interval) {
    edge->held = sample;
    return;
  }
  Take(edge, child, sample);
}

void LinkMotion::ResolveHeld(Edge* edge, const std::string& child, const Sample& sample) {
  if (!edge->held || sample.stamp == edge->held->stamp || sample.stamp <= edge->last) return;
  const Sample held = *edge->held;
  const double usual = edge->usual_interval;
  const auto interval = static_cast<double>(sample.stamp - held.stamp);
  if (interval >= kTooClose * usual) {
    edge->held.reset();
    Take(edge, child, held);
    return;
  }
  // Messages may overtake each other.
  const bool overtook =
      interval < 0 && static_cast<double>(sample.stamp - edge->last) <= kLongInterval * usual;
  if (overtook && ++edge->held->overtaken < kOvertaken) return;
  edge->held.reset();
  CountBadStamp(child, *edge, held.stamp,
                static_cast<double>(held.stamp - edge->last) - std::max(usual, 0.0));
}

bool LinkMotion::RunsBackwards(const std::string& child, const Edge& edge, const Sample& sample) {
  if (early_.empty() || early_message_ == message_) {
    early_message_ = message_;
    early_.push_back({child, sample, edge.last});
    return false;
  }
  const std::vector<Early> early = std::exchange(early_, {});
  Warnings::Event event =
      Event("", "frame '" + early[0].child + "' from " + StampText(early[0].last) + " to " +
                    StampText(early[0].sample.stamp),
            "all starts anew there: was the recording looped, or several played into one, or was a "
            "clock set? cut it there (--start, --duration), or " + UseRecordTimes(),
            early[0].last);
  event.size = static_cast<double>(early[0].last - early[0].sample.stamp) * 1e-9;
  event.unit = "s";
  Clear();
  warnings_.Count("time ran backwards", event);
  for (const Early& first : early) {
    Edge* its_edge = &edges_.at(first.child);
    if (!has_epoch_) {
      has_epoch_ = true;
      epoch_ = first.sample.stamp;
    }
    if (its_edge->samples == 0) Take(its_edge, first.child, first.sample);
  }
  return true;
}

// The edge goes on where it was: that one alone was wrong.
void LinkMotion::ForgetEarly(const std::string& child) {
  const auto is_its = [&](const Early& early) { return early.child == child; };
  for (const Early& early : early_) {
    if (!is_its(early)) continue;
    const Edge& edge = edges_.at(child);
    CountBadStamp(
        child, edge, early.sample.stamp,
        static_cast<double>(early.sample.stamp - early.last) - std::max(edge.usual_interval, 0.0));
  }
  early_.erase(std::remove_if(early_.begin(), early_.end(), is_its), early_.end());
}

void LinkMotion::CountBadStamp(const std::string& child, const Edge& edge, std::int64_t stamp,
                               double late) {
  Warnings::Event event =
      Event("'" + child + "'",
            "frame '" + child + "' by " + ToString(edge.source) + ", too " +
                (late > 0 ? "late" : "early"),
            "it is left out: stamp samples when they are measured", stamp);
  event.size = std::abs(late) * 1e-9;
  event.unit = "s";
  warnings_.Count("sample with a bad stamp", event);
}

void LinkMotion::JudgeSaid(Edge* edge, const std::string& child, const Sample& sample) {
  // What is above the frame that the user takes as inertial moves nothing.
  if (!judge_ || !edge->is_followed || child == options_.world_frame) return;
  if (!edge->judged) edge->judged = judge_->At(edge->parent, child);
  judge_->AddSaid(edge->judged, sample.publisher, sample.stamp, sample.X_PC);
}

void LinkMotion::Take(Edge* edge, const std::string& child, const Sample& sample) {
  const std::int64_t stamp = sample.stamp;
  JudgeSaid(edge, child, sample);
  if (judge_ && sample.recorded > 0) edge->delays.Add(stamp, sample.recorded);
  if (edge->samples == 0) {
    edge->first = stamp;
  } else {
    const std::int64_t interval = stamp - edge->last;
    const auto length = static_cast<double>(interval);
    edge->longest_interval = std::max(edge->longest_interval, interval);
    if (edge->gap_rule.IsGap(length * 1e-9, options_.max_gap, edge->last_pose, sample.X_PC)) {
      if (edge->gaps++ == 0) edge->first_gap = edge->last;
      if (interval > edge->longest_gap) {
        edge->longest_gap = interval;
        edge->longest_gap_at = edge->last;
        edge->longest_gap_recorded =
            edge->last_recorded > 0 ? sample.recorded - edge->last_recorded : 0;
      }
    }
    edge->moves = edge->gap_rule.moves();
    double& usual = edge->usual_interval;
    if (edge->samples == 1) {
      usual = length;
    } else {
      usual += (std::min(length, kLargestOfMean * usual) - usual) /
               static_cast<double>(std::min(edge->samples, kIntervalsOfMean));
    }
  }
  edge->last_pose = sample.X_PC;
  edge->last = stamp;
  edge->last_recorded = sample.recorded;
  ++edge->samples;
  last_stamp_ = std::max(last_stamp_, stamp);
  if (edge->is_followed) Feed(edge, child, sample);
}

void LinkMotion::Feed(Edge* edge, const std::string& child, const Sample& sample) {
  if (!edge->samples_of) edge->samples_of = tree_.MovingEdge(edge->parent, child);
  Judge(edge, child, sample);
  if (!(options_.smooth > 0)) {
    Deliver(edge, child, sample.stamp, sample.X_PC);
    return;
  }
  if (!edge->smoother) {
    edge->smoother =
        &smoothers_.try_emplace(child, options_.smooth, options_.max_gap).first->second;
  }
  edge->smoother->Add(sample.stamp, sample.X_PC, [&](std::int64_t smooth_stamp, const Pose& X) {
    Deliver(edge, child, smooth_stamp, X);
  });
}

// As it was recorded.
void LinkMotion::Judge(Edge* edge, const std::string& child, const Sample& sample) {
  if (!edge->judged) return;
  edge->judged->topic = ToString(edge->source);
  const JointModel* joint = edge->judged->joint ? JointAbove(child) : nullptr;
  if (!joint) return;
  if (sample.position) {
    edge->judged->joint->Add(sample.stamp, *sample.position);
  } else {
    edge->judged->joint->Add(sample.stamp, sample.X_PC);
  }
}

// As the links follow it.
void LinkMotion::Deliver(Edge* edge, const std::string& child, std::int64_t stamp,
                         const Pose& X_PC) {
  if (edge->judged) judge_->AddMotion(edge->judged, stamp, X_PC);
  if (!tree_.Append(edge->samples_of, Seconds(stamp), X_PC)) {
    warnings_.Count("sample ignored by the motion curve",
                    Event("'" + child + "'", "frame '" + child + "' by " + ToString(edge->source),
                          "it comes within a quarter of a period of the one before it: is its stamp "
                          "wrong, or do two publishers send it?",
                          stamp));
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
  if (!judge_) return {};
  Findings findings = judge_->Report(WayAboveVehicle(), world);
  const std::set<std::string> above = Above(world);
  AddClockFindings(above, &findings);
  AddGapFindings(above, &findings);
  return findings;
}

std::string LinkMotion::SmoothWorld() const {
  if (!judge_ || world_.empty() || !options_.world_frame.empty()) return world_;
  const RecordingJudge::Way way = WayAboveVehicle();
  return way.back() == world_ ? judge_->SmoothFrame(way) : world_;
}

void LinkMotion::Ingest(const tf2_msgs::TFMessage& message, bool is_static,
                        const std::string& publisher, std::int64_t recorded) {
  const Source source = is_static ? Source::kTfStatic : Source::kTf;
  SetPublisher(publisher, source);
  BeginMessage(recorded);
  for (const geometry_msgs::TransformStamped& transform : message.transforms) {
    const std::string parent = Own(transform.header.frame_id);
    const std::string child = Own(transform.child_frame_id);
    const std::string edge = "'" + parent + "' -> '" + child + "'";
    Pose X_PC;
    message_stamp_ = is_static ? 0 : ToNanoseconds(transform.header.stamp);
    if (parent.empty() || child.empty() || parent == child) {
      warnings_.Count(std::string("transform without proper frame ids by ") + ToString(source),
                      Event(edge, edge, "it is left out: name both frames where it is published"));
    } else if (!ToPose(transform.transform, &X_PC)) {
      warnings_.Count(
          std::string("transform that is no rotation or not finite by ") + ToString(source),
          Event(edge, edge + BadTransform(transform.transform),
                "it is left out: publish poses that are known only, with quaternions of length 1"));
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

void LinkMotion::BeginMessage(std::int64_t recorded) {
  ++message_;
  recorded_ = recorded;
  message_stamp_ = 0;
  if (first_recorded_ == 0) first_recorded_ = recorded;
}

void LinkMotion::Ingest(const sensor_msgs::JointState& message, const std::string& publisher,
                        std::int64_t recorded) {
  SetPublisher(publisher, Source::kJointStates);
  BeginMessage(recorded);
  const std::int64_t stamp = ToNanoseconds(message.header.stamp);
  message_stamp_ = stamp;
  if (message.position.size() != message.name.size()) {
    warnings_.Count("joint state without a position for each name",
                    Event("",
                          std::to_string(message.name.size()) + " names and " +
                              std::to_string(message.position.size()) + " positions by " +
                              ToString(Source::kJointStates),
                          "it is left out: publish a position for each name"));
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
      warnings_.Count("joint not in the URDF",
                      Event("'" + named_[i] + "'", "'" + named_[i] + "'",
                            "is this the URDF of the vehicle that was recorded?"));
      unknown_joints_.insert(named_[i]);
    } else if (!std::isfinite(position)) {
      warnings_.Count(
          "joint position not finite",
          Event("'" + named_[i] + "'", "'" + named_[i] + "' by " + ToString(Source::kJointStates),
                "it is left out: leave joints whose position is not known out of the message"));
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
  for (auto& [child, edge] : edges_) {
    if (!early_.empty()) ForgetEarly(child);
    if (!edge.held) continue;
    const Sample held = *edge.held;
    edge.held.reset();
    const auto interval = static_cast<double>(held.stamp - edge.last);
    if (interval > std::max(kLongAtTheEnd * edge.usual_interval, kLongestAtTheEnd)) {
      CountBadStamp(child, edge, held.stamp, interval - edge.usual_interval);
    } else {
      Take(&edge, child, held);
    }
  }
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
    edge.usual_interval = 0;
    edge.held.reset();
    edge.last_recorded = 0;
    edge.gap_rule = GapRule();
    edge.first = edge.last = 0;
  }
  early_.clear();
  has_epoch_ = false;
  last_stamp_ = 0;
  ++clear_count_;
}

std::vector<std::string> LinkMotion::Missing() const {
  std::set<std::string> reasons;
  if (world_.empty()) reasons.insert(NoCommonRoot());
  for (const std::string& link : links_) {
    const std::vector<Step> way = Ascend(link);
    const std::string root = way.empty() ? link : way.back().parent;
    if (!world_.empty() && root != world_) {
      reasons.insert("no transform leads from the world frame '" + world_ + "' to link '" + link +
                     "' (its tree ends at '" + root + "', which " + Option("world-frame", root) +
                     " would take)");
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
