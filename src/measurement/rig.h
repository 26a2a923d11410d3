// An experiment's rig as a rod: how its ends are held, and the state that it starts from.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clamp_path.h"
#include "cosserat_cable/causes/drift.h"
#include "cosserat_cable/measurement/measurement_set.h"
#include "cosserat_cable/measurement/specimen.h"
#include "cosserat_cable/rod/point_loads.h"
#include "cosserat_cable/rod/rod.h"

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

  /// Brings the rod to the start. False: `message` says why not. `near`: a shape near its rest to
  /// look from first, at any number of nodes; may be null.
  bool Start(std::string* message, const std::vector<Pose>* near = nullptr);
  /// The rest that Start has found.
  const std::vector<Pose>& rest() const { return rest_; }

  /// Poses of the clamps at a time [s], and the loads of that time.
  void MoveTo(double t);
  /// One step of a quasi-static experiment: the equilibrium at its poses and loads.
  bool Equilibrate(int step, std::string* message);

  /// The rod where it is, held along all axes where a slide holds it along some: its modes are
  /// known.
  rod::Rod WithSlidesHeld() const;

  const Pose& clamp_a() const { return a_; }
  const Pose& clamp_b() const { return b_; }
  /// Null where nothing but gravity loads the cable.
  const rod::Load* load() const { return loads_ ? &*loads_ : nullptr; }
  rod::Rod* rod() { return rod_.get(); }
  const rod::Rod& rod() const { return *rod_; }

 private:
  enum class Turn { kFree, kHeld };  // of end b about its axis
  rod::RodModel Model(Turn b) const;
  Pose TiltedA(const Pose& X_WC) const;
  bool Settle(const std::vector<Pose>* near, rod::Rod* rod, std::string* message);
  bool SettleNear(const std::vector<Pose>& near, rod::Rod* rod);
  void SetLoads(double t);
  /// The section at a time [s], or step, of a cable that drifts.
  void ApplyDrift(double t);

  const Experiment& experiment_;
  Specimen specimen_;
  int elements_;
  std::shared_ptr<ClampPath> path_a_, path_b_;
  Eigen::Quaterniond tilt_a_;
  Pose a_, b_;
  std::vector<Pose> rest_;
  std::optional<rod::PointLoads> loads_;
  std::optional<Drift> drift_;
  double record_begin_ = 0, record_end_ = 0;  // on the motion's clock [s], or steps
  rod::Section section_;                      // at the record's first instant
  std::unique_ptr<rod::Rod> rod_;
};

}  // namespace cosserat_cable
