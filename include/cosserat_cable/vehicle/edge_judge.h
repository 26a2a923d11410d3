// Judges the recorded motion of one edge of the tree of frames, sample by sample: jumps,
// accelerations that no vehicle survives, stamps of publishing instead of measurement, noise.
//
// Everything is told from displacements between samples some milliseconds apart: what is faster
// does not move a cable, and the noise of fast encoders would hide the rest.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "cosserat_cable/math/pose.h"
#include "cosserat_cable/vehicle/finding.h"

namespace cosserat_cable {

/// Where in the tree an edge is, which says what it can do.
enum class EdgeRole {
  kAboveVehicle,  ///< between frames that are no links: localisation, platforms
  kBody,          ///< moves the vehicle's root
  kJoint,         ///< moves a link on the vehicle
};

class EdgeJudge {
 public:
  /// `max_gap` [s]: motion across longer intervals is not known.
  EdgeJudge(EdgeRole role, double max_gap);
  ~EdgeJudge();
  EdgeJudge(EdgeJudge&&) noexcept;
  EdgeJudge& operator=(EdgeJudge&&) noexcept;

  /// The next sample. @pre stamps [ns] increase
  void Add(std::int64_t stamp, const Pose& X_PC);
  /// Time starts anew; what was found stays.
  void Restart();
  /// No more samples come: judges the last ones, too.
  void Finish();

  EdgeRole role() const;
  bool moves() const;
  /// Whether the motion consists of steps or short slides from rest to rest, as a localisation's
  /// corrections do.
  bool IsCorrected() const;
  /// Whether it accelerates more than what is said to be at rest but for corrections.
  bool IsRough() const;
  /// The largest of these. @pre IsCorrected() or IsRough()
  Finding Corrections(const std::string& subject, const std::string& topic) const;
  /// What was found so far; `subject`, `topic`: of the findings.
  Findings Report(const std::string& subject, const std::string& topic) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cosserat_cable
