// A cable as the engine runs it: its simulation, what is told of it, and what became of it.
//
// Cables do not see each other: each may be at its own instant, in its own thread.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "cosserat_cable/cable/cable_simulation.h"
#include "cosserat_cable/ros/apex_history.h"
#include "cosserat_cable/ros/cable_engine.h"
#include "cosserat_cable/vehicle/clamp_judge.h"
#include "state_dump.h"

namespace cosserat_cable {

/// What all cables need to know of an instant.
struct CableEngine::Instant {
  std::int64_t time = 0;                    // [ns]
  std::vector<Motion> frames;               // of all links that any cable needs, in the world
  std::vector<bool> in_gap;                 // of the same links, where telemetry is due
  bool telemetry = false, markers = false;  // are due
};

/// What is to be sent. Of `cable` kNoCable: of all.
struct CableEngine::Told {
  static constexpr std::size_t kNoCable = static_cast<std::size_t>(-1);

  std::int64_t time;  // [ns]
  std::size_t cable;
  std::variant<ApexTelemetry, visualization_msgs::MarkerArray, diagnostic_msgs::DiagnosticArray>
      message;
  CablePosture posture = {};  // of telemetry whose clearance is still to be measured
};

class CableEngine::SwayingCable {
 public:
  /// Of frames in Instant.
  struct Frames {
    std::size_t reference, a, b;
    std::vector<std::size_t> obstacles;
    std::vector<std::string> obstacle_names;  // likewise
  };

  /// `options` outlive this. `index`: by which the engine knows it.
  SwayingCable(const CableModel& model, std::vector<const Body*> obstacles, Frames frames,
               std::size_t index, const EngineOptions& options);

  const CableModel& model() const { return simulation_.model(); }
  CableSimulation* simulation() { return &simulation_; }
  CableSummary summary() const;
  bool failed() const { return failed_; }  ///< and has not settled since
  const ClampJudge& clamps() const { return clamps_; }
  diagnostic_msgs::DiagnosticStatus Diagnostics() const;

  void Settle(const Instant& now, const std::string& world);
  /// Whether it failed long enough before `time` [ns].
  bool MaySettleAgain(std::int64_t time) const;
  /// What it is to be stepped to; null where it has failed. Valid until asked again.
  const Surroundings* Then(const Instant& then);
  /// What came of that. `from` [ns]: where the step began.
  void Take(const StepOutcome& outcome, const Instant& then, std::int64_t from,
            const std::string& world);
  /// Notes what is due.
  void Tell(const Instant& now, const std::string& world);
  /// Adds to telemetry what costs most, and what no step needs; in the order in which it was told,
  /// also while the cable is stepped on.
  void MeasureClearance(Told* told);
  /// What was noted since this was called last.
  std::vector<Told> TakeTold();
  /// Sentences to be said to the user, each once.
  std::vector<std::string> TakeNews();

 private:
  void Surround(const Instant& now);
  void JudgeClamps(const Instant& now);
  void Record(const Instant& now);
  void JudgeDepth(std::int64_t time);
  std::string TooDeep() const;
  void Fail(StateDump::Failed failed, const std::string& message, std::int64_t time,
            const std::string& world);
  bool TellTelemetry(const Instant& now);
  void JudgeElements(double tension, double curvature);
  visualization_msgs::MarkerArray InRecordedFrame(visualization_msgs::MarkerArray markers) const;

  const EngineOptions& options_;
  CableSimulation simulation_;
  Frames frames_;
  std::size_t index_;
  Surroundings surroundings_;  // at the instant last asked for
  ApexHistory history_;
  ClampJudge clamps_;
  Eigen::Vector3d rest_ = Eigen::Vector3d::Zero();  // of the apex, in the reference link [m]
  bool failed_ = false;
  std::int64_t failed_at_ = 0;  // [ns]
  int failures_ = 0;
  double dt_ = 0;       // of the last step [s]
  bool shown_ = false;  // its markers are in the picture
  std::string message_;
  std::uint64_t held_ = 0;  // telemetry samples
  CableSummary summary_;
  std::vector<std::string> news_;
  std::vector<Told> told_;
};

}  // namespace cosserat_cable
