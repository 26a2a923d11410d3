// All cables of a vehicle, driven by its recorded or live transforms. The live node and the replay
// hand their messages to the same handlers here, so that the same input gives the same bits in
// both.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cosserat_cable/cable/cable_fleet.h"
#include "cosserat_cable/cable/cable_simulation.h"
#include "cosserat_cable/input/gravity.h"
#include "cosserat_cable/ros/link_motion.h"
#include "cosserat_cable/ros/markers.h"
#include "cosserat_cable/ros/output_sink.h"
#include "cosserat_cable/ros/summary.h"

namespace cosserat_cable {

enum class AmplitudeFrame { kReference, kWorld };

struct EngineOptions {
  double dt = 1e-3;               ///< step [s]
  double telemetry_rate = 200;    ///< [Hz], like all rates in simulated time
  double marker_rate = 30;        ///< [Hz]; 0: none
  double diagnostics_rate = 1;    ///< [Hz]
  double amplitude_window = 0.5;  ///< [s]
  AmplitudeFrame amplitude_frame = AmplitudeFrame::kReference;
  std::optional<std::string> gravity;        ///< as a user wrote it, "X,Y,Z"; see ApplyGravity
  Eigen::Vector3d gravity_W = kGravityDown;  ///< [m/s^2]
  double clearance_reach = 0.05;             ///< bodies farther away count as none [m]
  MarkerStyle markers;
  std::string dump_directory = ".";  ///< where a failed cable's state is written
  std::string vehicle_file;  ///< the URDF, for who reads that state; empty where it is no file
  /// After so long a cable that has failed settles anew, and after twice as long each time that it
  /// fails again [s]; 0: it stays as it is, until time or frames jump.
  double settle_again = 0;
  int threads = 0;  ///< 0: one per core. The results are the same, to the last bit
  LinkMotionOptions links;
  Findings known;  ///< of the recording, where it was judged before; told along with the run's own

  /// Takes `gravity` over into gravity_W; what is wrong with it is a problem.
  void ApplyGravity(Problems* problems);
  /// What is wrong with the numbers, one sentence each.
  std::vector<std::string> Check() const;
};

/// Geometry by link, and by whether it is the visual instead of the collision geometry.
using BodyMap = std::map<std::pair<std::string, bool>, std::unique_ptr<Body>>;

/// The bodies of all links with shapes. `threads`: see EngineOptions.
BodyMap MakeBodies(const VehicleModel& vehicle, int threads);

/// What `cable` is kept clear of at a link of its `avoid`; null where that has no extent.
const Body* FindBody(const BodyMap& bodies, const CableModel& cable, const std::string& link);

/// Links whose motion the cables need: clamps, references, and those to avoid; each once.
std::vector<std::string> NeededLinks(const std::vector<CableModel>& cables);

class UprightWatch;

class CableEngine {
 public:
  /// `vehicle` and `bodies` outlive this. A link that a cable avoids and that has no body never
  /// touches it.
  CableEngine(const VehicleModel& vehicle, const BodyMap& bodies,
              const std::vector<CableModel>& cables, EngineOptions options);
  ~CableEngine();

  /// `publisher`: the node's name. `recorded`: the time of recording or arrival [ns]; 0: not known.
  void Ingest(const tf2_msgs::TFMessage& message, bool is_static, const std::string& publisher = "",
              std::int64_t recorded = 0);
  void Ingest(const sensor_msgs::JointState& message, const std::string& publisher = "",
              std::int64_t recorded = 0);
  /// No more samples will come: Advance then goes up to the last.
  void Finish();

  /// Steps the cables as far as the motion of all links is final. Steps are on multiples of dt.
  /// The first call that finds all links known settles the cables there. `stop` is asked now and
  /// then: true leaves the rest to the next call.
  void Advance(OutputSink* sink, const std::function<bool()>& stop = {});

  /// Whether markers are sent when they are due: not where there is no time for them.
  void SendMarkers(bool send) { send_markers_ = send; }

  bool started() const { return started_; }
  std::int64_t now() const { return now_; }  ///< simulated time [ns]; 0 before the start
  const LinkMotion& links() const { return links_; }
  /// True where a cable has failed at any time.
  bool AnyFailed() const;
  std::size_t cable_count() const { return cables_.size(); }
  /// Names of the cables that have failed and not settled anew since.
  std::vector<std::string> Stopped() const;
  /// Sentences to be said to the user, each once.
  std::vector<std::string> TakeNews();
  /// What cannot be, of the recording, the samples and the cables' clamps, until now.
  Findings AllFindings() const;
  /// Wall time and memory are the caller's to fill in.
  Summary MakeSummary() const;

 private:
  class SwayingCable;
  struct Instant;
  struct Told;
  struct Group;
  struct Threads;

  void Restart();
  bool Start(OutputSink* sink);
  void SettleAgain();
  void Follow(std::int64_t time, Instant* instant);
  void FollowBlock(std::int64_t from, std::int64_t ready, std::vector<Instant>* block);
  void Sway(std::size_t group, const std::vector<Instant>& block);
  void SwayThrough(const std::vector<Instant>& block, std::int64_t ready, OutputSink* sink,
                   std::vector<Instant>* next);
  void CollectTold();
  void MeasureClearances(std::size_t cable);
  void MeasureClearances();
  void TakeMeasured();
  void TellDiagnostics();
  void TellFindings(const Findings& findings);
  void Deliver(OutputSink* sink);
  bool Due(std::int64_t period, std::int64_t time) const;
  std::size_t FrameIndex(const std::string& link) const;

  EngineOptions options_;
  std::int64_t dt_, telemetry_period_, marker_period_, diagnostics_period_;  // [ns]
  std::string vehicle_root_;
  std::string world_;  // in which the cables settled
  LinkMotion links_;
  std::unique_ptr<UprightWatch> upright_;  // null where the recording was judged before
  std::vector<std::unique_ptr<SwayingCable>> cables_;
  std::unique_ptr<CableFleet> fleet_;  // of their simulations
  std::vector<Group> groups_;          // of the fleet
  std::unique_ptr<Threads> threads_;
  std::vector<Told> unmeasured_;  // told, but for the clearances
  std::vector<Told> told_;        // to be delivered

  bool send_markers_ = true;
  bool started_ = false;
  bool finished_ = false;
  std::int64_t now_ = 0;
  std::int64_t not_before_ = 0;  // the cables settle anew [ns]
  std::uint64_t steps_ = 0;
  std::uint64_t seen_clears_ = 0;
  std::uint64_t resets_ = 0;
  std::vector<std::string> news_;
  std::set<std::string> told_findings_;
};

}  // namespace cosserat_cable
