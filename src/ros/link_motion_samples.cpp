// Where LinkMotion's samples come in: which of them count, in which order, and what is told of the
// others.
#include <algorithm>
#include <cmath>
#include <utility>

#include "cosserat_cable/input/number_text.h"
#include "cosserat_cable/ros/conversions.h"
#include "cosserat_cable/ros/link_motion.h"

namespace cosserat_cable {
namespace {

// No joint turns or goes farther [rad], [m].
constexpr double kLargestPosition = 1e6;
// Transports reorder messages by some hundredths of a second; a bag that starts over jumps by its
// length.
constexpr std::int64_t kBackwardsJump = 500'000'000;  // [ns]
// A sample waits for the next one where its stamp is so many usual intervals behind the last one:
// one of the two is wrong where the next comes at nearly the same time, or before.
constexpr double kLongInterval = 1.5, kTooClose = 0.25;
constexpr std::uint64_t kKnowsTheRate = 4;  // samples
// Later samples with earlier stamps say that its own is wrong.
constexpr int kOvertaken = 3;
// How soon messages come after their stamps is known after so many samples.
constexpr std::uint64_t kKnowsTheDelay = 20;
// A message that is recorded twice has the same pose both times [m], [rad].
constexpr double kSamePose = 1e-6;
// More than kBackwardsJump holds at any rate.
constexpr std::size_t kMostOlder = 1000;
constexpr std::int64_t kDelayRounding = 1'000'000;  // [ns]
// More bad stamps are no single ones: then all samples count, as they are.
constexpr std::uint64_t kFewBadStamps = 4;
constexpr double kShareOfHabit = 0.05;
// A first stamp so far off the second one, though both were recorded together, is wrong [ns].
constexpr std::int64_t kFirstOff = 500'000'000;
// At the end nothing confirms it [usual intervals], [ns].
constexpr double kLongAtTheEnd = 4;
constexpr double kLongestAtTheEnd = 0.5e9;
// Of the mean over the last intervals.
constexpr std::uint64_t kIntervalsOfMean = 16;
constexpr double kLargestOfMean = 3;

std::string BadTransform(const geometry_msgs::Transform& transform) {
  const auto& r = transform.rotation;
  const double length = std::sqrt(r.x * r.x + r.y * r.y + r.z * r.z + r.w * r.w);
  const auto& t = transform.translation;
  if (!std::isfinite(t.x) || !std::isfinite(t.y) || !std::isfinite(t.z))
    return ", its translation is not finite";
  if (!std::isfinite(length)) return ", its quaternion is not finite";
  return ", its quaternion has the length " + FormatRounded(length);
}

}  // namespace

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
  if (edge->is_constant) return;
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
  const bool repeats =
      edge->samples > 0 && (stamp == edge->last || (edge->held && stamp == edge->held->stamp));
  if (repeats || (edge->samples > 0 && stamp < edge->last)) {
    JudgeSaid(edge, child, sample);
    const Pose& before = edge->held ? edge->held->X_PC : edge->last_pose;
    const bool is_same =
        (X_PC.p - before.p).norm() < kSamePose && before.q.angularDistance(X_PC.q) < kSamePose;
    Warnings::Event event = Event(
        "'" + child + "'", "frame '" + child + "' by " + ToString(source),
        !repeats ? "it is left out: are stamps late or early, or do two publishers send it?"
        : is_same
            ? "it is left out: do two publishers send it, or is a message recorded twice?"
            : "it is left out, though its pose is another one: are poses stamped when they are "
              "sent, in bursts, or do two publishers disagree? stamp them when they are "
              "measured",
        stamp);
    if (repeats && edge->older.empty()) {
      warnings_.Count("sample repeated with the same stamp", event);
    } else {
      event.size = static_cast<double>(edge->last - stamp) * 1e-9;
      event.unit = "s";
      CountOlder(edge, event, stamp);
    }
    return;
  }
  if (!early_.empty()) ForgetEarly(child);
  const double interval = static_cast<double>(stamp - edge->last);
  const bool is_long =
      edge->samples >= kKnowsTheRate && interval > kLongInterval * edge->usual_interval;
  if (!edge->held && (is_long || IsFarAhead(*edge, stamp))) {
    edge->held = sample;
    return;
  }
  Take(edge, child, sample);
}

void LinkMotion::CountOlder(Edge* edge, const Warnings::Event& event, std::int64_t stamp) {
  const bool goes_on = stamp > edge->newest_older && edge->older.size() < kMostOlder;
  if (!edge->older.empty() && !goes_on) ResolveOlder(edge);
  if (edge->older.empty()) edge->oldest = stamp;
  edge->newest_older = stamp;
  edge->older.push_back(event);
}

// A clock that was set back repeats a stretch of time that has its samples, and goes on from there.
void LinkMotion::ResolveOlder(Edge* edge) {
  if (edge->older.empty()) return;
  const double usual = edge->usual_interval;
  const auto count = static_cast<double>(edge->older.size());
  const auto overlap = static_cast<double>(edge->last - edge->oldest);
  const bool is_set_back = edge->older.size() >= kOvertaken && edge->hole_end <= edge->oldest &&
                           static_cast<double>(edge->last - edge->newest_older) < 2 * usual &&
                           overlap < 2 * count * usual && overlap > count * usual / 2;
  if (is_set_back) {
    const auto size = edge->last + static_cast<std::int64_t>(usual) - edge->oldest;
    if (edge->set_back++ == 0) edge->first_set_back = edge->last;
    if (size > edge->most_set_back) {
      edge->most_set_back = size;
      edge->most_set_back_at = edge->last;
    }
    // What it does behind that has nothing to do with what it did before.
    if (edge->judged) judge_->Restart(edge->judged);
  } else {
    for (const Warnings::Event& event : edge->older)
      warnings_.Count(event.size > 0 ? "sample older than the one before it"
                                     : "sample repeated with the same stamp",
                      event);
  }
  edge->older.clear();
}

void LinkMotion::ResolveHeld(Edge* edge, const std::string& child, const Sample& sample) {
  if (!edge->held || sample.stamp == edge->held->stamp || sample.stamp <= edge->last) return;
  const Sample held = *edge->held;
  const double usual = edge->usual_interval;
  const auto interval = static_cast<double>(sample.stamp - held.stamp);
  // A stamp that is too late comes with a message that was recorded too soon for it.
  const bool is_on_time = held.recorded > 0 && edge->delays.count() > 0 &&
                          held.recorded - held.stamp > edge->least_delay - kDelayRounding;
  const bool is_habit =
      edge->bad_stamps > kFewBadStamps &&
      static_cast<double>(edge->bad_stamps) > kShareOfHabit * static_cast<double>(edge->samples);
  const bool is_far = IsFarAhead(*edge, held.stamp);
  if (interval >= kTooClose * usual || (interval > 0 && is_on_time) || (is_habit && !is_far)) {
    edge->held.reset();
    if (is_far && edge->samples > 0) {
      JumpForward(child, held);
    } else {
      Take(edge, child, held);
    }
    return;
  }
  // Messages may overtake each other.
  const bool overtook =
      interval < 0 && static_cast<double>(sample.stamp - edge->last) <= kLongInterval * usual;
  if (interval < 0 && is_on_time) return;
  if (overtook && ++edge->held->overtaken < kOvertaken) return;
  edge->held.reset();
  const std::int64_t expected = edge->samples > 0 ? edge->last : sample.stamp;
  CountBadStamp(child, edge, held.stamp,
                static_cast<double>(held.stamp - expected) - std::max(usual, 0.0));
}

// A frame that is sent once in a while is not ahead of the others.
bool LinkMotion::IsFarAhead(const Edge& edge, std::int64_t stamp) const {
  return edge.is_followed && newest_followed_ > 0 && stamp - newest_followed_ > kForwardJump;
}

void LinkMotion::JumpForward(const std::string& child, const Sample& sample) {
  Warnings::Event event =
      Event("",
            "frame '" + child + "' from " + StampText(newest_followed_) + " to " +
                StampText(sample.stamp),
            "all starts anew there: was a clock set, or was the recording paused or joined of "
            "several? what is between is not simulated",
            newest_followed_);
  event.size = static_cast<double>(sample.stamp - newest_followed_) * 1e-9;
  event.unit = "s";
  Clear();
  clear_reason_ = "time jumped forward by " + FormatRounded(event.size) + " s";
  warnings_.Count("time jumped forward", event);
  has_epoch_ = true;
  epoch_ = sample.stamp;
  Take(&edges_.at(child), child, sample);
}

bool LinkMotion::RunsBackwards(const std::string& child, const Edge& edge, const Sample& sample) {
  if (early_.empty() || early_message_ == message_) {
    early_message_ = message_;
    early_.push_back({child, sample, edge.last});
    return false;
  }
  const std::vector<Early> early = std::exchange(early_, {});
  Warnings::Event event =
      Event("",
            "frame '" + early[0].child + "' from " + StampText(early[0].last) + " to " +
                StampText(early[0].sample.stamp),
            "all starts anew there: was the recording looped, or several played into one, or was a "
            "clock set? cut it there (--start, --duration), or " +
                UseRecordTimes(),
            early[0].last);
  event.size = static_cast<double>(early[0].last - early[0].sample.stamp) * 1e-9;
  event.unit = "s";
  Clear();
  clear_reason_ = "time ran backwards";
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
    Edge* edge = &edges_.at(child);
    CountBadStamp(
        child, edge, early.sample.stamp,
        static_cast<double>(early.sample.stamp - early.last) - std::max(edge->usual_interval, 0.0));
  }
  early_.erase(std::remove_if(early_.begin(), early_.end(), is_its), early_.end());
}

void LinkMotion::CountBadStamp(const std::string& child, Edge* edge, std::int64_t stamp,
                               double late) {
  ++edge->bad_stamps;
  Warnings::Event event = Event("'" + child + "'",
                                "frame '" + child + "' by " + ToString(edge->source) + ", too " +
                                    (late > 0 ? "late" : "early"),
                                "it is left out: stamp samples when they are measured", stamp);
  event.size = std::abs(late) * 1e-9;
  event.unit = "s";
  warnings_.Count("sample with a bad stamp", event);
}

void LinkMotion::JudgeSaid(Edge* edge, const std::string& child, const Sample& sample) {
  // What is above the frame that the user takes as inertial moves nothing.
  if (!judge_ || !edge->is_followed || child == options_.world_frame) return;
  // A follower's position is made here of its leader's, of which all is said.
  const JointModel* joint = edge->source == Source::kJointStates ? JointAbove(child) : nullptr;
  if (joint && !joint->mimic.empty()) return;
  if (!edge->judged) edge->judged = judge_->At(edge->parent, child);
  judge_->AddSaid(edge->judged, sample.publisher, sample.stamp, sample.X_PC);
}

void LinkMotion::Take(Edge* edge, const std::string& child, const Sample& sample) {
  const std::int64_t stamp = sample.stamp;
  ResolveOlder(edge);
  JudgeSaid(edge, child, sample);
  if (sample.recorded > 0) {
    const std::int64_t delay = sample.recorded - stamp;
    const auto length = static_cast<double>(stamp - edge->last);
    // No message comes sooner after its stamp than all others did.
    if (edge->delays.count() >= kKnowsTheDelay && edge->least_delay - delay > kSetForward &&
        length > kLongInterval * edge->usual_interval && length * 1e-9 <= options_.max_gap) {
      if (edge->set_forward++ == 0) edge->first_set_forward = edge->last;
      if (edge->least_delay - delay > edge->most_set_forward) {
        edge->most_set_forward = edge->least_delay - delay;
        edge->most_set_forward_at = edge->last;
      }
      if (edge->judged) judge_->Restart(edge->judged);
    }
    if (edge->delays.count() == 0 || delay < edge->least_delay) edge->least_delay = delay;
    edge->delays.Add(stamp, sample.recorded);
  }
  const std::int64_t since_first = stamp - edge->first;
  if (edge->samples == 1 && since_first > kFirstOff && edge->last_recorded > 0 &&
      sample.recorded - edge->last_recorded < since_first / 2) {
    CountBadStamp(child, edge, edge->first, static_cast<double>(-since_first));
    edge->first = stamp;
    edge->usual_interval = 0;
    --edge->samples;
    tree_.Restart(edge->samples_of);
    if (edge->smoother) edge->smoother->Clear();
  } else if (edge->samples == 0) {
    edge->first = stamp;
  } else {
    const std::int64_t interval = stamp - edge->last;
    const auto length = static_cast<double>(interval);
    edge->longest_interval = std::max(edge->longest_interval, interval);
    if (length > kLongInterval * edge->usual_interval) edge->hole_end = stamp;
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
  if (!edge->is_followed) return;
  newest_followed_ = std::max(newest_followed_, stamp);
  Feed(edge, child, sample);
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
    warnings_.Count(
        "sample ignored by the motion curve",
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
    const auto leave_out = [&](const std::string& why) {
      if (is_static) return;
      if (unusable_++ == 0) why_unusable_ = why;
    };
    if (parent.empty() || child.empty() || parent == child) {
      warnings_.Count(std::string("transform without proper frame ids by ") + ToString(source),
                      Event(edge, edge, "it is left out: name both frames where it is published"));
      leave_out(edge);
    } else if (!ToPose(transform.transform, &X_PC)) {
      warnings_.Count(
          std::string("transform that is no rotation or not finite by ") + ToString(source),
          Event(edge, edge + BadTransform(transform.transform),
                "it is left out: publish poses that are known only, with quaternions of length 1"));
      leave_out(edge + BadTransform(transform.transform));
    } else if (is_static) {
      AddFixed(parent, child, X_PC, source);
    } else {
      ++usable_;
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
    } else if (!(std::abs(position) < kLargestPosition)) {
      warnings_.Count(
          "joint position not finite",
          Event("'" + named_[i] + "'",
                "'" + named_[i] + "' by " + ToString(Source::kJointStates) + ", " +
                    FormatRounded(position),
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
    ResolveOlder(&edge);
    if (!edge.held) continue;
    const Sample held = *edge.held;
    edge.held.reset();
    const auto interval = static_cast<double>(held.stamp - edge.last);
    if (interval > std::max(kLongAtTheEnd * edge.usual_interval, kLongestAtTheEnd)) {
      CountBadStamp(child, &edge, held.stamp, interval - edge.usual_interval);
    } else {
      Take(&edge, child, held);
    }
  }
  for (auto& [child, smoother] : smoothers_) {
    Edge* edge = &edges_.at(child);
    smoother.Finish(
        [&, name = child](std::int64_t stamp, const Pose& X) { Deliver(edge, name, stamp, X); });
  }
  if (judge_) judge_->Finish();
  tree_.Finish();
}

void LinkMotion::Clear() {
  cleared_until_ = std::exchange(newest_followed_, 0);
  tree_.Clear();
  if (judge_) judge_->Restart();
  for (auto& [child, smoother] : smoothers_) smoother.Clear();
  for (auto& [child, edge] : edges_) {
    edge.samples = 0;
    edge.usual_interval = 0;
    edge.held.reset();
    edge.older.clear();
    edge.hole_end = 0;
    edge.last_recorded = 0;
    edge.gap_rule = GapRule();
    edge.first = edge.last = 0;
  }
  early_.clear();
  has_epoch_ = false;
  last_stamp_ = 0;
  ++clear_count_;
}

}  // namespace cosserat_cable
