// The moving tree of frames: one C2 curve for each edge, composed along the chain to the root.
//
// Each edge keeps its own samples at their own stamps, so that a body pose at 50 Hz and joints at 500 Hz
// do not have to share instants, and nothing is interpolated linearly on the way.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cosserat_cable/math/pose_curve.h"

namespace cosserat_cable {

class MotionTree {
 public:
  explicit MotionTree(double max_gap = 0.25);

  /// An edge that does not move.
  void SetFixed(const std::string& parent, const std::string& child, const Pose& X_PC);

  /// A timed sample of a moving edge. False where it was ignored: not later than the edge's last, not finite, or the child already
  /// has another parent.
  bool Append(const std::string& parent, const std::string& child, double time, const Pose& X_PC);

  /// No more samples will come.
  void Finish();
  /// Forgets all samples of moving edges (a bag looped, time ran backwards); keeps the fixed ones.
  void Clear();

  bool Has(const std::string& frame) const;
  /// The frame that has no parent, reached from `frame`.
  std::string RootOf(const std::string& frame) const;
  /// True where a chain leads from `frame` up to `ancestor`.
  bool Connected(const std::string& ancestor, const std::string& frame) const;

  /// The first time [s] at which every moving edge between the two has a sample: +infinity if one has none;
  /// -infinity where all edges are fixed.
  double BeginTime(const std::string& ancestor, const std::string& frame) const;
  /// The motion is final up to this time [s]: -infinity if an edge has no sample, +infinity where all edges are fixed.
  double ReadyUntil(const std::string& ancestor, const std::string& frame) const;
  /// The last sample's time [s], the earliest over the moving edges; +infinity where all are fixed.
  double EndTime(const std::string& ancestor, const std::string& frame) const;

  /// How `frame` moves as seen from `ancestor`. @pre Connected, and every edge between them has samples
  Motion Evaluate(const std::string& ancestor, const std::string& frame, double time) const;

  bool InGap(const std::string& ancestor, const std::string& frame, double time) const;
  std::size_t gap_count() const;
  void DropBefore(double time);

  // Data members: to be chosen by the implementation.
};

}  // namespace cosserat_cable
