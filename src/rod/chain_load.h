// One rod of a chain, as a load sees it and changes it.
#pragma once

#include "cosserat_cable/rod/load.h"
#include "end_part.h"
#include "lane_access.h"
#include "load_power.h"
#include "step_chain.h"

namespace cosserat_cable::rod {

/// The iterate of the rod in one lane, or in all of them.
template <class T>
class ChainView : public Centreline {
 public:
  ChainView(const StepChain<T>* chain, int lane, double time, const EndParts* ends)
      : chain_(*chain), lane_(lane), time_(time), ends_(*ends) {}
  double time() const override { return time_; }
  Motion clamp_a() const override { return ends_.a.clamp(); }
  int elements() const override { return chain_.layout.elements; }
  Vec3<double> position(int i) const override {
    const ChainLayout::Place at = chain_.layout.OfNode(i, lane_);
    return GetLane(chain_.nodes[at.entry].at.r, at.lane);
  }
  Vec3<double> velocity(int i) const override {
    const ChainLayout::Place at = chain_.layout.OfNode(i, lane_);
    return GetLane(chain_.nodes[at.entry].at.v, at.lane);
  }
  Quat<double> orientation(int i) const override {
    const ChainLayout::Place at = chain_.layout.OfNode(i, lane_);
    return GetLane(chain_.nodes[at.entry].at.q, at.lane);
  }

 private:
  const StepChain<T>& chain_;
  int lane_;
  double time_;
  const EndParts& ends_;
};

/// Adds a load's forces to the right-hand side and, where wanted, its derivatives to the tangent.
template <class T>
class ChainSink : public LoadSink {
 public:
  /// `rate_factor`: d(velocity)/d(position) of the step [1/s].
  ChainSink(StepChain<T>* chain, int lane, bool tangent, double rate_factor)
      : chain_(*chain), lane_(lane), tangent_(tangent), rate_factor_(rate_factor) {}

  void AddForce(int element, double xi, const Vec3<double>& force, const Mat3<double>& by_position,
                const Mat3<double>& by_velocity) override {
    const double weight[2] = {1 - xi, xi};
    const double f[3] = {force.x, force.y, force.z};
    const Mat3<double> k = -1.0 * (by_position + rate_factor_ * by_velocity);
    for (int node = 0; node < 2; ++node) {
      const ChainLayout::Place at = chain_.layout.OfNode(element + node, lane_);
      for (int i = 0; i < 3; ++i) Add(weight[node] * f[i], at.lane, &chain_.load_rhs[at.entry][i]);
      power_ += weight[node] * Dot(force, GetLane(chain_.nodes[at.entry].at.v, at.lane));
      if (!tangent_) continue;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j <= i; ++j)
          Add(weight[node] * weight[node] * k[i][j], at.lane,
              &chain_.load_diagonal[at.entry].at(i, j));
    }
    if (!tangent_) return;
    const ChainLayout::Place at = chain_.layout.OfElement(element, lane_);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        Add(weight[0] * weight[1] * k[i][j], at.lane, &chain_.load_lower[at.entry][i][j]);
  }

  void AddNodeForce(int node, const Vec3<double>& force, const Mat3<double>& by_position,
                    const Mat3<double>& by_velocity) override {
    const ChainLayout::Place at = chain_.layout.OfNode(node, lane_);
    const double f[3] = {force.x, force.y, force.z};
    for (int i = 0; i < 3; ++i) Add(f[i], at.lane, &chain_.load_rhs[at.entry][i]);
    power_ += Dot(force, GetLane(chain_.nodes[at.entry].at.v, at.lane));
    if (!tangent_) return;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j)
        Add(-(by_position[i][j] + rate_factor_ * by_velocity[i][j]), at.lane,
            &chain_.load_diagonal[at.entry].at(i, j));
  }

  void AddMoment(int node, const Vec3<double>& moment) override {
    const ChainLayout::Place at = chain_.layout.OfNode(node, lane_);
    const double m[3] = {moment.x, moment.y, moment.z};
    for (int i = 0; i < 3; ++i) Add(m[i], at.lane, &chain_.load_rhs[at.entry][3 + i]);
    power_ += Dot(moment, GetLane(chain_.nodes[at.entry].at.omega, at.lane));
  }

  void AddDissipation(double power) override { dissipation_ += power; }

  double power() const { return power_; }              ///< of what was added [W]
  double dissipation() const { return dissipation_; }  ///< its part that is lost [W], positive

 private:
  static void Add(double value, int lane, T* to) { SetLane(to, lane, GetLane(*to, lane) + value); }

  StepChain<T>& chain_;
  int lane_;
  bool tangent_;
  double rate_factor_;
  double power_ = 0, dissipation_ = 0;
};

template <class T>
LoadPower AddLoad(const Load& load, const ChainView<T>& rod, int lane, bool tangent,
                  double rate_factor, StepChain<T>* chain) {
  ChainSink<T> sink(chain, lane, tangent, rate_factor);
  load.Evaluate(rod, &sink);
  return {sink.power() + sink.dissipation(), sink.dissipation()};
}

/// Forgets what loads have added.
template <class T>
void ClearLoads(StepChain<T>* chain) {
  const T zero(0.0);
  for (Vec6<T>& b : chain->load_rhs)
    for (T& x : b.v) x = zero;
  for (Triangle6<T>& s : chain->load_diagonal)
    for (T& x : s.v) x = zero;
  for (Mat3<T>& k : chain->load_lower)
    for (auto& row : k.m)
      for (T& x : row) x = zero;
}

}  // namespace cosserat_cable::rod
