// What the partly held ends of the rod in one lane do to the step's workspace.
#pragma once

#include "cosserat_cable/math/rotation.h"
#include "cosserat_cable/math/small_eigen.h"
#include "end_part.h"
#include "lane_access.h"

namespace cosserat_cable::rod {

/// Both ends of the rod in one lane; null where an end is clamped or wholly free, so that nothing
/// is to be done.
struct LaneEnds {
  const EndPart* a = nullptr;
  const EndPart* b = nullptr;

  /// Calls `act(end, node)`.
  template <class Act>
  void ForEach(int nodes, Act act) const {
    if (a) act(*a, 0);
    if (b) act(*b, nodes - 1);
  }
};

/// Moves the increments of the end nodes to where the clamps let them go.
template <class T>
void ImposeEnds(const LaneEnds& ends, int lane, StepWorkspace<T>* w) {
  ends.ForEach(w->count, [&](const EndPart& end, int i) {
    if (!end.holds()) return;
    const Node<double> from = GetLane(w->node[i], lane);
    Vec6<double> d = GetLane(w->increment[i], lane);
    Node<double> to = from;
    to.r = from.r + Vec3<double>{d[0], d[1], d[2]};
    to.q = ToSmall(ToEigen(from.q) * RotationExp({d[3], d[4], d[5]}));
    const Quat<double> before = to.q;
    end.ImposePose(&to);
    const Vec3<double> dr = to.r - from.r;
    for (int k = 0; k < 3; ++k) d[k] = (&dr.x)[k];
    const bool turned =
        to.q.w != before.w || to.q.x != before.x || to.q.y != before.y || to.q.z != before.z;
    if (turned) {
      const Eigen::Vector3d turn = RotationLog(ToEigen(from.q).conjugate() * ToEigen(to.q));
      for (int k = 0; k < 3; ++k) d[3 + k] = turn[k];
    }
    SetLane(&w->increment[i], lane, d);
  });
}

/// Gives the end nodes of the iterate the velocities that the clamps allow.
template <class T>
void ImposeEndRates(const LaneEnds& ends, int lane, StepWorkspace<T>* w) {
  ends.ForEach(w->count, [&](const EndPart& end, int i) {
    Node<double> node = GetLane(w->trial[i], lane);
    NodeRates<double> rates = GetLane(w->trial_rate[i], lane);
    end.ImposeRates(&node, &rates);
    SetLane(&w->trial[i], lane, node);
    SetLane(&w->trial_rate[i], lane, rates);
  });
}

/// Adds the clamps' springs and takes what is held out of the system: the right-hand side, and,
/// where it is `fresh`, the matrix. `rate_factor`: d(velocity)/d(position) of the step [1/s].
template <class T>
void ConstrainEnds(const LaneEnds& ends, int lane, bool fresh, double rate_factor,
                   StepWorkspace<T>* w) {
  using Matrix6 = EndPart::Matrix6;
  ends.ForEach(w->count, [&](const EndPart& end, int i) {
    const Node<double> node = GetLane(w->trial[i], lane);
    const Matrix6 free = end.FreeProjector(node);
    const Eigen::Vector3d moment = end.SpringMoment(node);
    Vec6<double> rhs = GetLane(w->rhs[i], lane);
    for (int k = 0; k < 3; ++k) rhs[3 + k] += moment[k];
    const Eigen::Matrix<double, 6, 1> kept = free * Eigen::Map<Eigen::Matrix<double, 6, 1>>(rhs.v);
    SetLane(&w->rhs[i], lane, {{kept[0], kept[1], kept[2], kept[3], kept[4], kept[5]}});
    if (!fresh) return;
    // Only the lower triangle of a diagonal block is kept.
    Matrix6 diagonal =
        GetLane(w->system.diagonal(i), lane).template selfadjointView<Eigen::Lower>();
    diagonal.bottomRightCorner<3, 3>() += end.SpringTangent(node, rate_factor);
    const double scale = diagonal.diagonal().cwiseAbs().maxCoeff();
    diagonal = (free * diagonal * free + scale * (Matrix6::Identity() - free)).eval();
    SetLane(&w->system.diagonal(i), lane, diagonal);
    if (i == 0)
      SetLane(&w->system.lower(0), lane, GetLane(w->system.lower(0), lane) * free);
    else
      SetLane(&w->system.lower(i - 1), lane, free * GetLane(w->system.lower(i - 1), lane));
  });
}

}  // namespace cosserat_cable::rod
