#include "cosserat_cable/vehicle/motion_tree.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace cosserat_cable {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool IsFinite(const Pose& X) { return X.p.allFinite() && X.q.coeffs().allFinite(); }

}  // namespace

MotionTree::MotionTree(double max_gap) : max_gap_(max_gap) {}

const MotionTree::Frame* MotionTree::Find(const std::string& name) const {
  const auto found = frames_.find(name);
  return found == frames_.end() ? nullptr : &found->second;
}

/// The child's frame with this parent, made where missing; null where the tree does not allow it.
MotionTree::Frame* MotionTree::Attach(const std::string& parent, const std::string& child) {
  if (parent.empty() || child.empty() || parent == child) return nullptr;
  const Frame* known_child = Find(child);
  const Frame* known_parent = Find(parent);
  if (known_child && known_child->parent) {
    if (known_child->parent != known_parent) return nullptr;
  } else {
    for (const Frame* f = known_parent; f; f = f->parent) {
      if (f == known_child) return nullptr;
    }
  }
  Frame& frame = frames_.try_emplace(child, max_gap_).first->second;
  frame.parent = &frames_.try_emplace(parent, max_gap_).first->second;
  return &frame;
}

bool MotionTree::SetFixed(const std::string& parent, const std::string& child, const Pose& X_PC) {
  if (!IsFinite(X_PC)) return false;
  const Frame* known = Find(child);
  if (known && known->parent && !known->fixed) return false;
  Frame* frame = Attach(parent, child);
  if (!frame) return false;
  frame->fixed = true;
  ++revision_;
  frame->X_PC = {X_PC.p, X_PC.q.normalized()};
  return true;
}

MotionTree::Edge MotionTree::MovingEdge(const std::string& parent, const std::string& child) {
  Edge edge;
  const Frame* known = Find(child);
  if (known && known->fixed) return edge;
  edge.frame_ = Attach(parent, child);
  ++revision_;
  return edge;
}

bool MotionTree::Append(const Edge& edge, double time, const Pose& X_PC) {
  ++revision_;
  return edge && edge.frame_->curve.Append(time, X_PC);
}

void MotionTree::Restart(const Edge& edge) {
  ++revision_;
  if (edge) edge.frame_->curve = PoseCurve(max_gap_);
}

void MotionTree::Detach(const std::string& child) {
  ++revision_;
  const auto found = frames_.find(child);
  if (found == frames_.end()) return;
  found->second.parent = nullptr;
  found->second.fixed = false;
  found->second.curve = PoseCurve(max_gap_);
}

void MotionTree::Finish() {
  ++revision_;
  for (auto& [name, frame] : frames_) frame.curve.Finish();
}

void MotionTree::Clear() {
  ++revision_;
  for (auto& [name, frame] : frames_) frame.curve = PoseCurve(max_gap_);
}

bool MotionTree::Has(const std::string& frame) const { return Find(frame) != nullptr; }

std::string MotionTree::RootOf(const std::string& frame) const {
  const Frame* root = Find(frame);
  if (!root) return frame;
  while (root->parent) root = root->parent;
  return std::find_if(frames_.begin(), frames_.end(),
                      [root](const auto& item) { return &item.second == root; })
      ->first;
}

template <class Visit>
bool MotionTree::VisitCurves(const std::string& ancestor, const std::string& frame,
                             const Visit& visit) const {
  const Frame* top = Find(ancestor);
  const Frame* f = Find(frame);
  if (!top) return false;
  for (; f && f != top; f = f->parent) {
    if (f->parent && !f->fixed) visit(f->curve);
  }
  return f == top;
}

bool MotionTree::Connected(const std::string& ancestor, const std::string& frame) const {
  return VisitCurves(ancestor, frame, [](const PoseCurve&) {});
}

double MotionTree::BeginTime(const std::string& ancestor, const std::string& frame) const {
  double time = -kInfinity;
  const bool connected = VisitCurves(ancestor, frame, [&time](const PoseCurve& curve) {
    time = std::max(time, curve.empty() ? kInfinity : curve.begin_time());
  });
  return connected ? time : kInfinity;
}

double MotionTree::ReadyUntil(const std::string& ancestor, const std::string& frame) const {
  double time = kInfinity;
  const bool connected = VisitCurves(ancestor, frame, [&time](const PoseCurve& curve) {
    time = std::min(time, curve.ready_until());
  });
  return connected ? time : -kInfinity;
}

double MotionTree::EndTime(const std::string& ancestor, const std::string& frame) const {
  double time = kInfinity;
  const bool connected = VisitCurves(ancestor, frame, [&time](const PoseCurve& curve) {
    time = std::min(time, curve.empty() ? -kInfinity : curve.end_time());
  });
  return connected ? time : -kInfinity;
}

Motion MotionTree::Evaluate(const std::string& ancestor, const std::string& frame,
                            double time) const {
  assert(Connected(ancestor, frame));
  const Frame* top = Find(ancestor);
  Motion motion;  // of `frame` as seen from f
  for (const Frame* f = Find(frame); f != top; f = f->parent) {
    motion = (f->fixed ? Motion::Resting(f->X_PC) : f->curve.Evaluate(time)) * motion;
  }
  return motion;
}

const Motion& MotionTree::FollowBelow(const Frame* top, Frame* frame, double time) {
  Frame::Followed& known = frame->followed;
  if (known.top != top || known.time != time || known.revision != revision_) {
    const auto below = [&](const auto& edge, const Motion& alone) {
      return frame->parent == top ? alone : FollowBelow(top, frame->parent, time) * edge;
    };
    if (frame->fixed) {
      known.motion = below(frame->X_PC, Motion::Resting(frame->X_PC));
    } else {
      const Motion edge = frame->curve.Follow(time);
      known.motion = below(edge, edge);
    }
    known.top = top;
    known.time = time;
    known.revision = revision_;
  }
  return known.motion;
}

MotionTree::Link MotionTree::FindLink(const std::string& ancestor, const std::string& frame) {
  assert(Connected(ancestor, frame));
  Link link;
  link.top_ = Find(ancestor);
  link.frame_ = &frames_.find(frame)->second;
  return link;
}

Motion MotionTree::Follow(const Link& link, double time) {
  if (link.frame_ == link.top_) return Motion();
  return FollowBelow(link.top_, link.frame_, time);
}

bool MotionTree::InGap(const std::string& ancestor, const std::string& frame, double time) const {
  bool in_gap = false;
  VisitCurves(ancestor, frame,
              [&](const PoseCurve& curve) { in_gap = in_gap || curve.InGap(time); });
  return in_gap;
}

std::size_t MotionTree::gap_count() const {
  std::size_t count = 0;
  for (const auto& [name, frame] : frames_) count += frame.curve.gap_count();
  return count;
}

std::size_t MotionTree::ignored_count() const {
  std::size_t count = 0;
  for (const auto& [name, frame] : frames_) count += frame.curve.ignored_count();
  return count;
}

void MotionTree::DropBefore(double time) {
  for (auto& [name, frame] : frames_) frame.curve.DropBefore(time);
}

}  // namespace cosserat_cable
