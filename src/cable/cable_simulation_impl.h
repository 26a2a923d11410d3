// What a cable simulation is made of; shared by those that step one cable and several.
#pragma once

#include <string>
#include <vector>

#include "contact_set.h"
#include "cosserat_cable/cable/cable_simulation.h"
#include "cosserat_cable/math/small_eigen.h"
#include "cosserat_cable/rod/load.h"
#include "cosserat_cable/rod/rod.h"
#include "nearest_body.h"

namespace cosserat_cable {

struct CableSimulation::Impl {
  Impl(const CableModel& m, rod::Rod at_start, const std::vector<const Body*>& bodies,
       double clearance_reach);

  /// Of the present state.
  const std::vector<Pose>& Nodes() {
    if (!nodes_are_known)
      for (int i = 0; i <= model.elements; ++i) nodes[i] = rod.pose(i);
    nodes_are_known = true;
    return nodes;
  }
  /// Present positions into the scratch array.
  void TakePositions() {
    for (int i = 0; i <= model.elements; ++i) positions[i] = ToEigen(rod.position(i));
  }
  /// Contact as it was searched last, and what the surroundings load the cable with.
  const rod::Load* LoadIn(const Surroundings& at) {
    if (contact.empty()) return at.load;
    if (!at.load) return &contact;
    both.loads.assign({&contact, at.load});
    return &both;
  }

  /// How deep the cable is in what the last search found [m].
  double Depth() const;
  /// Equilibrium against the bodies, from the free one or from near.
  bool SettleOnBodies(StepOutcome* outcome);
  /// Puts the cable on what it would hang through, growing from a short one to its length.
  void PayOut(StepOutcome* outcome);
  /// Out of an equilibrium that is unstable into one that is not.
  void LeaveUnstable(StepOutcome* outcome);
  /// How fast the fastest motion grows that the equilibrium lets grow [1/s], and its shape; 0 where
  /// none does, or it cannot be said.
  double Grows(rod::Mode* mode);
  /// The cable is as it is in these surroundings: the state that the next step starts from.
  void Begin(const Surroundings& start);
  /// Sets the cable, at rest, moving with its surroundings.
  void SetOut(const Surroundings& start, StepOutcome* outcome);
  void TakeShape(std::vector<Pose>* shape) const {
    for (int i = 0; i <= model.elements; ++i) (*shape)[i] = rod.pose(i);
  }
  void TakeSection(const Surroundings& from) {
    if (from.section) rod.SetSection(*from.section);
  }
  /// Looks for contact where the cable is about to be.
  void SearchContact(double dt, const Surroundings& then) {
    if (!contact.has_bodies()) return;
    rod.Predict(dt, then.a.X, then.b.X, &positions);
    contact.Search(then.a.X, positions, then.obstacles);
  }
  /// Of all but the rod.
  void ExchangeState(StateArchive* state) {
    contact.ExchangeState(state);
    now.obstacles.resize(contact.body_count());
    state->Exchange(&now.a, &now.b, &now.obstacles);
  }
  /// A whole step has converged.
  void Accept(const Surroundings& then) {
    contact.Accept();
    now = then;
    nodes_are_known = false;
  }
  /// The step in halves, and halves of halves, after it did not converge as a whole. A step that
  /// fails leaves the state as it was.
  StepOutcome StepInParts(double dt, const Surroundings& then, int iterations_so_far);
  /// What to say of the state where steps down to `step` [s] did not converge, and what to do.
  std::string WhyNotConverged(double step) const;

  CableModel model;
  rod::Rod rod;
  ContactSet contact;
  NearestBody nearest;
  rod::LoadSum both;  // scratch of LoadIn
  Surroundings now;
  std::vector<Pose> nodes;  // of the state that was last asked for
  bool nodes_are_known = false;
  std::vector<Eigen::Vector3d> positions;  // scratch: where contact is searched
};

/// The outcome of a step to surroundings that are not finite.
StepOutcome RefuseNonFinite();
bool IsFinite(const Surroundings& surroundings);

}  // namespace cosserat_cable
