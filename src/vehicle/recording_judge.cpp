#include "cosserat_cable/vehicle/recording_judge.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {
namespace {

// A transform that is said to be fixed, and was measured anew, or rounded [m], [rad].
constexpr double kSameTranslation = 1e-3, kSameRotation = 2e-3;
// One sample of another publisher may be a restart.
constexpr std::uint64_t kLeastConflicts = 2;

const JointModel* JointAbove(const VehicleModel& vehicle, const std::string& child) {
  const auto found = std::find_if(vehicle.joints.begin(), vehicle.joints.end(),
                                  [&](const JointModel& joint) { return joint.child == child; });
  return found == vehicle.joints.end() ? nullptr : &*found;
}

bool Moves(const JointModel* joint) {
  return joint && (joint->type == JointModel::Type::kRevolute ||
                   joint->type == JointModel::Type::kPrismatic);
}

double Angle(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  const Eigen::Quaterniond turn = a.conjugate() * b;
  return 2 * std::atan2(turn.vec().norm(), std::abs(turn.w()));
}

std::string Difference(double translation, double rotation) {
  return FormatLength(translation) + " and " + FormatRounded(rotation * 180 / M_PI) + " deg";
}

}  // namespace

RecordingJudge::Edge::Edge(std::string the_parent, std::string the_child, EdgeRole role,
                           const JointModel* the_joint, double max_gap)
    : parent(std::move(the_parent)),
      child(std::move(the_child)),
      motion(role == EdgeRole::kAboveVehicle ? EdgeRole::kBody : role, max_gap) {
  if (role == EdgeRole::kAboveVehicle) correction.emplace(role, max_gap);
  if (Moves(the_joint)) joint.emplace(*the_joint, max_gap);
  // A joint that the recording has elsewhere may be a wheel's.
  const bool may_spin = role == EdgeRole::kJoint && (!the_joint || Moves(the_joint));
  if (!may_spin) attitude.emplace(max_gap);
}

bool RecordingJudge::Edge::IsCorrected() const {
  if (!correction) return false;
  // By REP-105 it is the localisation that moves odom in map.
  const bool by_name =
      parent.find("map") != std::string::npos && child.find("odom") != std::string::npos;
  return correction->IsCorrected() || (by_name && correction->IsRough());
}

RecordingJudge::RecordingJudge(const VehicleModel& vehicle, double max_gap)
    : vehicle_(vehicle), max_gap_(max_gap) {}

RecordingJudge::Edge* RecordingJudge::At(const std::string& parent, const std::string& child) {
  const auto found = edges_.find(child);
  if (found != edges_.end()) return &found->second;
  EdgeRole role = EdgeRole::kAboveVehicle;
  if (child == vehicle_.root) {
    role = EdgeRole::kBody;
  } else if (vehicle_.HasLink(child)) {
    role = EdgeRole::kJoint;
  }
  const JointModel* joint = JointAbove(vehicle_, child);
  if (joint && joint->parent != parent) joint = nullptr;
  return &edges_
              .emplace(std::piecewise_construct, std::forward_as_tuple(child),
                       std::forward_as_tuple(parent, child, role, joint, max_gap_))
              .first->second;
}

int RecordingJudge::Publisher(const std::string& name) {
  const auto number = std::find(publishers_.begin(), publishers_.end(), name) - publishers_.begin();
  if (number == static_cast<std::ptrdiff_t>(publishers_.size())) publishers_.push_back(name);
  return static_cast<int>(number);
}

void RecordingJudge::AddMotion(Edge* edge, std::int64_t stamp, const Pose& X_PC) {
  edge->motion.Add(stamp, X_PC);
  if (edge->correction) edge->correction->Add(stamp, X_PC);
  if (edge->attitude) edge->attitude->Add(stamp, X_PC.q);
}

void RecordingJudge::AddFixed(const std::string& parent, const std::string& child, const Pose& X_PC,
                              const std::string& topic, std::int64_t recorded) {
  Edge* edge = At(parent, child);
  const JointModel* drawn = JointAbove(vehicle_, child);
  const bool by_urdf = !edge->fixed && drawn && drawn->type == JointModel::Type::kFixed;
  const std::optional<Pose> before = by_urdf ? drawn->Evaluate(0) : edge->fixed;
  edge->fixed = X_PC;
  if (!before || edge->parent != parent) return;
  const double translation = (X_PC.p - before->p).norm();
  const double rotation = Angle(X_PC.q, before->q);
  if (translation <= kSameTranslation && rotation <= kSameRotation) return;
  Finding finding;
  finding.kind = by_urdf ? "differs_from_urdf" : "static_changes";
  finding.subject = parent + " -> " + child;
  finding.topic = topic;
  finding.what = (by_urdf ? "is off the URDF by " : "is fixed, and changes by ") +
                 Difference(translation, rotation) + "; the recorded one counts";
  finding.remedy = by_urdf ? "is this the URDF of the vehicle that was recorded?"
                           : "do two publishers disagree?";
  finding.count = 1;
  finding.first = finding.worst = recorded;
  finding.size = translation;
  finding.limit = kSameTranslation;
  finding.unit = "m";
  const auto known = std::find_if(fixed_.begin(), fixed_.end(), [&](const Finding& f) {
    return f.kind == finding.kind && f.subject == finding.subject;
  });
  if (known == fixed_.end())
    fixed_.push_back(std::move(finding));
  else
    ++known->count;
}

void RecordingJudge::Restart(Edge* edge) {
  edge->motion.Restart();
  if (edge->correction) edge->correction->Restart();
  if (edge->joint) edge->joint->Restart();
  if (edge->attitude) edge->attitude->Restart();
  edge->publishers.Restart();
}

void RecordingJudge::Restart() {
  for (auto& [child, edge] : edges_) Restart(&edge);
}

void RecordingJudge::Finish() {
  for (auto& [child, edge] : edges_) {
    edge.motion.Finish();
    if (edge.correction) edge.correction->Finish();
  }
}

const RecordingJudge::Edge* RecordingJudge::Find(const std::string& child) const {
  const auto found = edges_.find(child);
  return found == edges_.end() ? nullptr : &found->second;
}

// Where on the way the edge begins that is corrected; the way's last frame where there is none.
std::size_t RecordingJudge::FirstCorrected(const Way& way) const {
  bool moves_below = false;
  std::size_t i = 0;
  for (; i + 1 < way.size(); ++i) {
    const Edge* edge = Find(way[i]);
    if (!edge) continue;
    if (moves_below && edge->IsCorrected()) break;
    moves_below = moves_below || edge->motion.moves();
  }
  return i;
}

std::string RecordingJudge::SmoothFrame(const Way& way) const {
  return way.empty() ? std::string() : way[FirstCorrected(way)];
}

void RecordingJudge::ReportConflict(const Edge& edge, Findings* findings) const {
  const bool named = edge.publishers.conflict().count >= kLeastConflicts;
  const PublisherJudge::Conflict& conflict =
      named ? edge.publishers.conflict() : edge.publishers.two_courses();
  if (conflict.count < kLeastConflicts) return;
  Finding finding;
  finding.kind = "two_publishers";
  finding.subject = edge.parent + " -> " + edge.child;
  if (edge.joint) {
    const JointModel* joint = JointAbove(vehicle_, edge.child);
    finding.subject = "joint '" + joint->name + "'";
  }
  finding.topic = edge.topic;
  const auto name = [this](int number) { return publishers_[static_cast<std::size_t>(number)]; };
  const std::string size = " (" + std::to_string(conflict.count) + " samples, by up to " +
                           Difference(conflict.translation, conflict.rotation) + ")";
  if (named) {
    finding.what = "is published by " + name(conflict.one) + " and by " + name(conflict.other) +
                   " with different values" + size;
    finding.remedy = "stop one of them, or take its messages out of the recording";
  } else {
    finding.what =
        "goes to and fro between two courses with each sample of " + name(conflict.one) + size;
    finding.remedy =
        "do two publishers disagree? stop one of them, or take its messages out of the recording";
  }
  finding.count = conflict.count;
  finding.first = conflict.first;
  finding.worst = conflict.worst;
  finding.size = conflict.translation > 0 ? conflict.translation : conflict.rotation;
  finding.limit = conflict.translation > 0 ? kSameTranslation : kSameRotation;
  finding.unit = conflict.translation > 0 ? "m" : "rad";
  findings->push_back(std::move(finding));
}

Findings RecordingJudge::Report(const Way& way, const std::string& world) const {
  const std::size_t corrected = FirstCorrected(way);
  const std::string smooth = SmoothFrame(way);
  Findings findings;
  for (const auto& [child, edge] : edges_) {
    const std::string subject = edge.parent + " -> " + child;
    const auto at = std::find(way.begin(), way.end(), child);
    const bool above =
        at != way.end() && at - way.begin() >= static_cast<std::ptrdiff_t>(corrected);
    const bool is_corrected = above && edge.IsCorrected();
    // An angle in the wrong unit is why it moves as it does.
    Findings attitude;
    if (edge.attitude) attitude = edge.attitude->Report(subject, edge.topic);
    if (!attitude.empty()) {
      std::move(attitude.begin(), attitude.end(), std::back_inserter(findings));
      ReportConflict(edge, &findings);
      continue;
    }
    Findings motion = (is_corrected ? *edge.correction : edge.motion).Report(subject, edge.topic);
    if (is_corrected) {
      // Many small ones, none of which stands out.
      if (motion.empty()) motion.push_back(edge.correction->Corrections(subject, edge.topic));
      for (Finding& finding : motion)
        finding.remedy = world == smooth
                             ? "a localisation corrects it, so '" + smooth +
                                   "' below it is taken as inertial (--world-frame decides)"
                             : "a localisation corrects it: take the frame below as inertial, "
                               "--world-frame " +
                                   smooth + " (~world_frame of the node)";
    }
    // A vehicle that stands still in a frame that is corrected; or these are its own leaps.
    if (!is_corrected && edge.IsCorrected()) {
      if (motion.empty()) {
        motion = edge.correction->Report(subject, edge.topic);
        if (motion.empty()) motion.push_back(edge.correction->Corrections(subject, edge.topic));
        for (Finding& finding : motion) finding.remedy.clear();
      }
      for (Finding& finding : motion)
        finding.remedy += (finding.remedy.empty() ? "" : "; ") +
                          ("does a localisation correct it? then take the frame below as inertial, "
                           "--world-frame " +
                           child + " (~world_frame of the node)");
    }
    std::move(motion.begin(), motion.end(), std::back_inserter(findings));
    if (edge.joint) {
      Findings joint = edge.joint->Report(edge.topic);
      std::move(joint.begin(), joint.end(), std::back_inserter(findings));
    }
    ReportConflict(edge, &findings);
  }
  findings.insert(findings.end(), fixed_.begin(), fixed_.end());
  return findings;
}

}  // namespace cosserat_cable
