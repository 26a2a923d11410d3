// One lane of a workspace, as a load sees it and changes it.
#pragma once

#include "cosserat_cable/math/lanes.h"
#include "cosserat_cable/rod/load.h"
#include "end_part.h"
#include "step_workspace.h"

namespace cosserat_cable::rod {

/// The iterate of the rod.
template <class T>
class LaneView : public Centreline {
 public:
  LaneView(const StepWorkspace<T>* workspace, const EndParts* ends)
      : workspace_(*workspace), ends_(*ends) {}
  double time() const override { return workspace_.time; }
  Motion clamp_a() const override { return ends_.a.clamp(); }
  int elements() const override { return workspace_.count - 1; }
  Vec3<double> position(int i) const override { return workspace_.trial[i].r; }
  Vec3<double> velocity(int i) const override { return workspace_.trial[i].v; }
  Quat<double> orientation(int i) const override { return workspace_.trial[i].q; }

 private:
  const StepWorkspace<T>& workspace_;
  const EndParts& ends_;
};

/// Adds a load's forces to the right-hand side and, where wanted, its derivatives to the tangent.
template <class T>
class LaneSink : public LoadSink {
 public:
  /// `rate_factor`: d(velocity)/d(position) of the step [1/s].
  LaneSink(StepWorkspace<T>* workspace, int lane, bool tangent, double rate_factor)
      : workspace_(*workspace), lane_(lane), tangent_(tangent), rate_factor_(rate_factor) {}

  void AddForce(int element, double xi, const Vec3<double>& force, const Mat3<double>& by_position,
                const Mat3<double>& by_velocity) override {
    const double weight[2] = {1 - xi, xi};
    const double f[3] = {force.x, force.y, force.z};
    for (int node = 0; node < 2; ++node)
      for (int k = 0; k < 3; ++k) Add(weight[node] * f[k], &workspace_.rhs[element + node][k]);
    if (!tangent_) return;
    const Mat3<double> k = -1.0 * (by_position + rate_factor_ * by_velocity);
    AddBlock(weight[0] * weight[0], k, &workspace_.system.diagonal(element));
    AddBlock(weight[1] * weight[1], k, &workspace_.system.diagonal(element + 1));
    AddBlock(weight[0] * weight[1], k, &workspace_.system.lower(element));
  }

  void AddNodeForce(int node, const Vec3<double>& force, const Mat3<double>& by_position,
                    const Mat3<double>& by_velocity) override {
    const double f[3] = {force.x, force.y, force.z};
    for (int k = 0; k < 3; ++k) Add(f[k], &workspace_.rhs[node][k]);
    if (!tangent_) return;
    AddBlock(-1.0, by_position + rate_factor_ * by_velocity, &workspace_.system.diagonal(node));
  }

  void AddMoment(int node, const Vec3<double>& moment) override {
    const double m[3] = {moment.x, moment.y, moment.z};
    for (int k = 0; k < 3; ++k) Add(m[k], &workspace_.rhs[node][3 + k]);
  }
  void AddDissipation(double) override {}  // statics

 private:
  void Add(double value, T* to) { SetLane(to, lane_, GetLane(*to, lane_) + value); }
  void AddBlock(double weight, const Mat3<double>& k, Block6<T>* block) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) Add(weight * k[i][j], &(*block)[i][j]);
  }

  StepWorkspace<T>& workspace_;
  int lane_;
  bool tangent_;
  double rate_factor_;
};

template <class T>
void AddLoad(const Load& load, const EndParts& ends, bool tangent, double rate_factor,
             StepWorkspace<T>* w) {
  LaneSink<T> sink(w, 0, tangent, rate_factor);
  load.Evaluate(LaneView<T>(w, &ends), &sink);
}

}  // namespace cosserat_cable::rod
