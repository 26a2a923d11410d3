// The running account behind EnergyBalance.
#pragma once

#include "cosserat_cable/math/state_archive.h"
#include "cosserat_cable/rod/energy.h"

namespace cosserat_cable::rod {

class EnergyBook {
 public:
  /// What flows at one instant [W], and what was lost since the one before regardless of how fast
  /// [J], as by friction.
  struct Flow {
    double ends = 0, loads = 0, dissipation = 0;
    double lost = 0;
  };

  /// The next step starts a new account.
  void Close() { open_ = waits_ = false; }
  bool open() const { return open_ || waits_; }
  /// It starts with the end of the next step instead.
  void Wait() {
    open_ = false;
    waits_ = true;
  }
  bool waits() const { return waits_; }
  void Open(const Flow& flow, double stored) {
    ends_.Restart(flow.ends);
    loads_.Restart(flow.loads);
    dissipation_.Restart(flow.dissipation);
    lost_ = by_section_ = 0;
    stored_at_start_ = stored;
    open_ = true;
    waits_ = false;
  }
  void Add(double dt, const Flow& flow) {
    ends_.Add(dt, flow.ends);
    loads_.Add(dt, flow.loads);
    dissipation_.Add(dt, flow.dissipation);
    lost_ += flow.lost;
  }
  void ExchangeState(StateArchive* state) {
    state->Exchange(&open_, &waits_, &stored_at_start_, &lost_, &by_section_);
    for (Integral* integral : {&ends_, &loads_, &dissipation_}) integral->ExchangeState(state);
  }
  /// What a change of the section puts in [J].
  void AddSectionChange(double work) { by_section_ += work; }
  EnergyBalance Balance(double stored) const {
    if (!open_) return {};
    return {ends_.work(), loads_.work(), dissipation_.work() + lost_, stored - stored_at_start_,
            by_section_};
  }

 private:
  /// Integrates a power from its values at the steps' ends by the trapezoidal rule.
  class Integral {
   public:
    void Restart(double power) {
      power_ = power;
      work_ = 0;
    }
    void Add(double dt, double power) {
      work_ += 0.5 * dt * (power_ + power);
      power_ = power;
    }
    double work() const { return work_; }
    void ExchangeState(StateArchive* state) { state->Exchange(&power_, &work_); }

   private:
    double power_ = 0, work_ = 0;
  };

  bool open_ = false, waits_ = false;
  double stored_at_start_ = 0, lost_ = 0, by_section_ = 0;
  Integral ends_, loads_, dissipation_;
};

}  // namespace cosserat_cable::rod
