// The moving tree of frames: one C2 curve for each edge, composed along the chain to the root.
//
// Each edge keeps its own samples at their own stamps, so that a body pose at 50 Hz and joints at
// 500 Hz do not have to share instants, and nothing is interpolated linearly on the way.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>

#include "cosserat_cable/math/pose_curve.h"

namespace cosserat_cable {

/// Several threads may call the const functions at the same time.
class MotionTree {
  struct Frame;

 public:
  /// A moving edge, looked up once for many samples; stays as long as the tree.
  class Edge {
   public:
    explicit operator bool() const { return frame_ != nullptr; }

   private:
    friend class MotionTree;
    Frame* frame_ = nullptr;
  };

  /// `max_gap` [s]: of the edges' curves, see PoseCurve.
  explicit MotionTree(double max_gap = 0.25);
  // Frames point at each other: they can be moved along with their map, not copied.
  MotionTree(MotionTree&&) = default;
  MotionTree& operator=(MotionTree&&) = default;

  /// An edge that does not move; a later call for the same edge replaces its pose. False where it
  /// was ignored: the pose is not finite, a name is empty, the child has another parent or is a
  /// moving edge, or the edge would close a loop.
  bool SetFixed(const std::string& parent, const std::string& child, const Pose& X_PC);

  /// The edge to `child`, which moves from now on; none where the tree does not allow it, see
  /// SetFixed, and where it is a fixed one.
  Edge MovingEdge(const std::string& parent, const std::string& child);
  /// A timed sample [s] of the edge. False where it was ignored: see PoseCurve::Append; also where
  /// there is no edge.
  bool Append(const Edge& edge, double time, const Pose& X_PC);
  /// Forgets the edge's samples.
  void Restart(const Edge& edge);
  /// Forgets the edge above `child`, which may have another parent from then on. Links that were
  /// looked up are to be looked up anew.
  void Detach(const std::string& child);
  bool Append(const std::string& parent, const std::string& child, double time, const Pose& X_PC) {
    return Append(MovingEdge(parent, child), time, X_PC);
  }

  /// No more samples will come.
  void Finish();
  /// Forgets all samples of moving edges (a bag looped, time ran backwards), and Finish(); keeps
  /// the edges, and the fixed ones' poses.
  void Clear();

  /// True for a frame at either end of an edge.
  bool Has(const std::string& frame) const;
  /// The frame that has no parent, reached from `frame`; an unknown frame is its own root.
  std::string RootOf(const std::string& frame) const;
  /// True where a chain leads from `frame` up to `ancestor`; also for a known frame and itself.
  bool Connected(const std::string& ancestor, const std::string& frame) const;

  /// The first time [s] at which every moving edge between the two has a sample: +infinity if one
  /// has none or they are not connected; -infinity where all edges are fixed.
  double BeginTime(const std::string& ancestor, const std::string& frame) const;
  /// The motion is final up to this time [s]: -infinity if an edge has no sample or they are not
  /// connected, +infinity where all edges are fixed.
  double ReadyUntil(const std::string& ancestor, const std::string& frame) const;
  /// The last sample's time [s], the earliest over the moving edges; -infinity if an edge has no
  /// sample or they are not connected, +infinity where all are fixed.
  double EndTime(const std::string& ancestor, const std::string& frame) const;

  /// How `frame` moves as seen from `ancestor` at `time` [s].
  /// @pre Connected, and every edge between them has samples
  Motion Evaluate(const std::string& ancestor, const std::string& frame, double time) const;

  /// A frame as seen from another, looked up once to be followed often; stays as long as the tree.
  class Link {
   public:
    explicit operator bool() const { return frame_ != nullptr; }

   private:
    friend class MotionTree;
    const Frame* top_ = nullptr;
    Frame* frame_ = nullptr;
  };
  /// @pre Connected
  Link FindLink(const std::string& ancestor, const std::string& frame);
  /// As Evaluate, up to rounding; remembers each edge's motion and each frame's, so that the frames
  /// of a tree at one time, and times in small steps, are cheap.
  Motion Follow(const Link& link, double time);

  /// True where a moving edge between the two is in a gap at `time` [s].
  bool InGap(const std::string& ancestor, const std::string& frame, double time) const;
  /// Gaps so far, over all edges.
  std::size_t gap_count() const;
  /// Samples ignored so far by the curves of all edges: too close, late, or not finite.
  std::size_t ignored_count() const;
  /// Forgets samples that times from `time` [s] on do not need.
  void DropBefore(double time);

 private:
  /// A frame with the edge to its parent. Nodes of an unordered_map stay where they are.
  struct Frame {
    explicit Frame(double max_gap) : curve(max_gap) {}

    Frame* parent = nullptr;
    bool fixed = false;
    Pose X_PC;        ///< of a fixed edge
    PoseCurve curve;  ///< of a moving edge

    /// The last answer of Follow.
    struct Followed {
      const Frame* top = nullptr;  ///< null: none
      double time = 0;
      std::uint64_t revision = 0;
      Motion motion;  ///< as seen from `top`
    } followed;
  };

  const Frame* Find(const std::string& name) const;
  const Motion& FollowBelow(const Frame* top, Frame* frame, double time);
  Frame* Attach(const std::string& parent, const std::string& child);
  /// Calls `visit(const PoseCurve&)` for each moving edge; false if the two are not connected.
  template <class Visit>
  bool VisitCurves(const std::string& ancestor, const std::string& frame, const Visit& visit) const;

  double max_gap_;
  std::uint64_t revision_ = 0;  ///< changes with everything that Follow depends on
  std::unordered_map<std::string, Frame> frames_;
};

}  // namespace cosserat_cable
