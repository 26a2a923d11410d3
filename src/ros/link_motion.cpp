#include "cosserat_cable/ros/link_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cosserat_cable/ros/conversions.h"
#include "cosserat_cable/vehicle/joint_positions.h"

namespace cosserat_cable {
namespace {

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
    parents_.insert(joint.parent);
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
  for (const ConstantEdge& constant : options_.constants) {
    AddFixed(constant.parent, constant.child, constant.X_PC, Source::kTf);
    edges_.at(constant.child).is_constant = true;
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

void LinkMotion::AddFixed(const std::string& parent, const std::string& child, const Pose& X_PC,
                          Source source) {
  Edge* edge = AcceptSource(parent, child, source, X_PC);
  if (!edge) return;
  tree_.SetFixed(parent, child, X_PC);
  edge->last_pose = X_PC;
  if (judge_ && source == Source::kTfStatic && edge->is_followed)
    judge_->AddFixed(parent, child, X_PC, ToString(source), recorded_);
}

void LinkMotion::KeepWorld() {
  if (!options_.world_frame.empty() || world_.empty()) return;
  keeps_world_ = true;
  options_.world_frame = world_;
  UpdateTree();
}

RecordingJudge::Way LinkMotion::WayAboveVehicle() const {
  RecordingJudge::Way way = {vehicle_.root};
  for (const Step& step : Ascend(vehicle_.root)) way.push_back(step.parent);
  return way;
}

Findings LinkMotion::MotionFindings(const std::string& world) const {
  if (!judge_) return {};
  // Clocks and gaps first: they may be why motion looks as it does.
  Findings findings;
  const std::set<std::string> above = Above(world);
  AddClockFindings(above, &findings);
  AddDriftFindings(above, &findings);
  AddSetClockFindings(above, &findings);
  AddGapFindings(above, &findings);
  AddUnconnectedFindings(&findings);
  for (Finding& finding : judge_->Report(WayAboveVehicle(), world))
    findings.push_back(std::move(finding));
  return findings;
}

std::string LinkMotion::SmoothWorld() const {
  if (!judge_ || world_.empty() || !options_.world_frame.empty()) return world_;
  const RecordingJudge::Way way = WayAboveVehicle();
  return way.back() == world_ ? judge_->SmoothFrame(way) : world_;
}

std::vector<std::string> LinkMotion::Missing() const {
  std::set<std::string> reasons;
  if (world_.empty()) reasons.insert(NoCommonRoot());
  if (unusable_ > 0 && usable_ == 0)
    reasons.insert("no transform of " + ToString(Source::kTf) + " can be used, of " +
                   std::to_string(unusable_) + " (the first: " + why_unusable_ +
                   "): publish poses that are known only");
  const bool any_moves = std::any_of(edges_.begin(), edges_.end(), [](const auto& edge) {
    return edge.second.samples > 0 || edge.second.is_constant;
  });
  if (ignored_ > 0 && !any_moves)
    reasons.insert("nothing moves the vehicle: all " + std::to_string(ignored_) +
                   " samples are ignored (the first: " + why_ignored_ + ")");
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

std::optional<Pose> LinkMotion::LatestPose(const std::string& ancestor,
                                           const std::string& frame) const {
  Pose X;
  std::string child = frame;
  for (std::size_t depth = 0; child != ancestor; ++depth) {
    const auto edge = edges_.find(child);
    if (edge == edges_.end() || depth > kMaxDepth) return std::nullopt;
    const bool is_fixed = edge->second.source == Source::kUrdf ||
                          edge->second.source == Source::kTfStatic || edge->second.is_constant;
    if (!is_fixed && edge->second.samples == 0) return std::nullopt;
    X = edge->second.last_pose * X;
    child = edge->second.parent;
  }
  return X;
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
