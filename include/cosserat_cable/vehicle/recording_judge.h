// Everything that is judged of a vehicle's recorded motion, edge by edge, and what it says of the
// frame to be taken as inertial.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cosserat_cable/vehicle/attitude_judge.h"
#include "cosserat_cable/vehicle/edge_judge.h"
#include "cosserat_cable/vehicle/finding.h"
#include "cosserat_cable/vehicle/joint_judge.h"
#include "cosserat_cable/vehicle/publisher_judge.h"
#include "cosserat_cable/vehicle/vehicle_model.h"

namespace cosserat_cable {

class RecordingJudge {
 public:
  /// An edge, looked up once for many samples; stays as long as the judge.
  struct Edge {
    Edge(std::string the_parent, std::string the_child, EdgeRole role, const JointModel* joint,
         double max_gap);

    std::string parent, child;
    std::string topic;  ///< where its samples come from
    EdgeJudge motion;
    std::optional<EdgeJudge> correction;  ///< the same as a localisation's; above the vehicle
    std::optional<JointJudge> joint;
    std::optional<AttitudeJudge> attitude;  ///< of what no joint turns
    PublisherJudge publishers;
    std::optional<Pose> fixed;  ///< while it does not move

    /// Whether it moves as a localisation's corrections do, or does under the name of such.
    bool IsCorrected() const;
  };

  /// `vehicle` outlives this. `max_gap` [s]: motion across longer intervals is not known.
  RecordingJudge(const VehicleModel& vehicle, double max_gap);

  Edge* At(const std::string& parent, const std::string& child);
  /// The number of a publisher.
  int Publisher(const std::string& name);

  /// A sample as it was recorded, of whichever publisher.
  void AddSaid(Edge* edge, int publisher, std::int64_t stamp, const Pose& X_PC) {
    edge->publishers.Add(publisher, stamp, X_PC);
  }
  /// A sample as the links follow it. @pre stamps [ns] of an edge increase
  void AddMotion(Edge* edge, std::int64_t stamp, const Pose& X_PC);
  /// A transform that is said to be fixed, by `topic`. `recorded`: when [ns]; 0: not known.
  void AddFixed(const std::string& parent, const std::string& child, const Pose& X_PC,
                const std::string& topic, std::int64_t recorded = 0);
  /// Time starts anew; what was found stays.
  void Restart();
  /// The same for one edge.
  void Restart(Edge* edge);
  /// No more samples come.
  void Finish();

  /// Frames from the vehicle's root to the topmost one.
  using Way = std::vector<std::string>;
  /// The highest frame of the way that no localisation's correction moves: below the first edge
  /// that is corrected and has a moving edge below it. The last one where there is none such.
  std::string SmoothFrame(const Way& way) const;
  /// What was found so far. `world`: the inertial frame that is taken.
  Findings Report(const Way& way, const std::string& world) const;

 private:
  const Edge* Find(const std::string& child) const;
  std::size_t FirstCorrected(const Way& way) const;
  void ReportConflict(const Edge& edge, Findings* findings) const;

  const VehicleModel& vehicle_;
  double max_gap_;
  std::map<std::string, Edge> edges_;  // by child
  std::vector<std::string> publishers_;
  Findings fixed_;  // what contradicts fixed transforms
};

}  // namespace cosserat_cable
