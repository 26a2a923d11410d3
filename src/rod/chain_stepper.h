// Takes rods through time steps: several side by side, or one in halves.
#pragma once

#include <vector>

#include "cosserat_cable/rod/rod_batch.h"
#include "rod_home.h"
#include "step_chain.h"
#include "step_coefficients.h"
#include "time_step.h"

namespace cosserat_cable::rod {

template <class T>
class ChainStepper final : public RodHome {
 public:
  /// `alike`: has the elements, joints and held ends of all rods.
  ChainStepper(const ChainLayout& layout, const Rod::Impl& alike);
  ~ChainStepper() override;

  /// A step of `dt` [s] of `count` rods, by lane; as RodBatch::Step.
  void Step(double dt, int count, Rod::Impl* const* rods, const RodDrive* drives,
            SolveReport* reports);

  /// Makes room for rods with section laws, which is else made when the first is stepped.
  void SetNonlinear() { chain_.SetNonlinear(); }

  void Fetch(int lane, Rod::Impl* rod) override;
  Node<double> NodeAt(int lane, int i) const override;
  void MoveOut(int lane) override { residents_[lane] = nullptr; }
  void ForgetLaw(int lane) override { dt_of_law_[lane] = 0; }
  void Predict(int lane, double dt, std::vector<Eigen::Vector3d>* positions) const override;

 private:
  static constexpr int kLanes = kLaneCount<T>;

  void MoveIn(int lane, Rod::Impl* rod);
  void CopyState(int lane, const Rod::Impl& rod);

  StepChain<T> chain_;
  Rod::Impl* residents_[kLanes] = {};  // whose state is here; of one in halves, in lane 0
  double dt_of_law_[kLanes] = {};      // of the step for which a lane has its rod's law [s]
  bool strains_known_ = false;         // of the present state
  bool filled_ = false;                // the lanes that no rod uses
};

extern template class ChainStepper<WideLanes>;
extern template class ChainStepper<Lanes>;
extern template class ChainStepper<LanePair>;

}  // namespace cosserat_cable::rod
