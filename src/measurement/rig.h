// An experiment's rig: how its cable's ends are held, the state that it starts from, and what
// drives it from there.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clamp_path.h"
#include "cosserat_cable/cable/cable_simulation.h"
#include "cosserat_cable/causes/drift.h"
#include "cosserat_cable/measurement/measurement_set.h"
#include "cosserat_cable/measurement/specimen.h"
#include "cosserat_cable/rod/rod.h"
#include "recorded_load.h"

namespace cosserat_cable {

/// The clamps' paths of an experiment's rigs that are stepped by one thread.
struct RigPaths {
  explicit RigPaths(const Experiment& experiment) : a(experiment.a), b(experiment.b) {}
  SharedPaths a, b;
};

class Rig {
 public:
  /// The experiment outlives the rig.
  Rig(const Experiment& experiment, const Specimen& specimen, int elements, RigPaths* paths);
  Rig(const Rig&) = delete;
  Rig& operator=(const Rig&) = delete;

  /// Brings the rod to the start. False: `message` says why not. `near`: a shape near its rest to
  /// look from first, at any number of nodes; may be null.
  bool Start(std::string* message, const std::vector<Pose>* near = nullptr);
  /// The rest that Start has found.
  const std::vector<Pose>& rest() const { return rest_; }

  /// What steps the cable from its start on. Null before the start, and in quasi-static
  /// experiments.
  CableSimulation* cable() { return cable_.get(); }
  /// What drives the cable at a time [s]; valid until the next call.
  const Surroundings& At(double t);
  /// One step of a quasi-static experiment: the equilibrium at its poses and loads.
  bool Equilibrate(int step, std::string* message);

  /// The rod where it is, held along all axes where a slide holds it along some: its modes are
  /// known.
  rod::Rod WithSlidesHeld() const;

  const Pose& clamp_a() const { return now_.a.X; }
  /// Null where the experiment has none.
  const rod::Load* load() const { return now_.load; }
  const rod::Rod& rod() const { return cable_ ? cable_->rod() : *rod_; }

 private:
  enum class Turn { kFree, kHeld };  // of end b about its axis
  rod::RodModel Model(Turn b) const;
  Pose TiltedA(const Pose& X_WC) const;
  Motion TiltedA(Motion motion) const;
  bool Settle(const std::vector<Pose>* near, rod::Rod* rod, std::string* message);
  bool SettleNear(const std::vector<Pose>& near, rod::Rod* rod);
  /// The section at a time [s], or step, of a cable that drifts; null: it does not.
  const rod::Section* DriftedTo(double t);

  const Experiment& experiment_;
  Specimen specimen_;
  int elements_;
  std::shared_ptr<ClampPath> path_a_, path_b_;
  Eigen::Quaterniond tilt_a_;
  std::optional<RecordedLoad> load_;
  Surroundings now_;
  std::vector<Pose> rest_;
  std::optional<Drift> drift_;
  double record_begin_ = 0, record_end_ = 0;  // on the motion's clock [s], or steps
  rod::Section first_section_, section_;      // at the record's first instant, and now
  std::optional<rod::Rod> rod_;               // of quasi-static experiments
  std::unique_ptr<CableSimulation> cable_;    // of all others
};

}  // namespace cosserat_cable
