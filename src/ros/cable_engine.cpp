#include "cosserat_cable/ros/cable_engine.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <utility>

#include "cosserat_cable/ros/apex_history.h"
#include "cosserat_cable/ros/conversions.h"
#include "cosserat_cable/ros/telemetry.h"
#include "diagnostics.h"
#include "state_dump.h"

namespace cosserat_cable {
namespace {

// While only the vehicle's own root is known, a body pose above it may be about to come.
constexpr std::int64_t kWorldGrace = 1'000'000'000;  // [ns]
// Old samples are let go of this often; each time costs a walk over all edges.
constexpr std::uint64_t kDropInterval = 100;  // [steps]
// What may pile up while a link is still missing.
constexpr std::int64_t kWaitingHistory = 10'000'000'000;  // [ns]

std::int64_t Period(double rate) {
  return rate > 0 ? static_cast<std::int64_t>(std::llround(1e9 / rate)) : 0;
}

}  // namespace

struct CableEngine::Frame {
  std::string link;
  Motion motion;  // in the world, at now_
};

struct CableEngine::Cable {
  Cable(const CableModel& model, std::vector<const Body*> obstacles, const EngineOptions& options,
        std::int64_t window)
      : simulation(model, std::move(obstacles), options.gravity_W, options.clearance_reach),
        history(window) {
    summary.name = model.name;
  }
  const CableModel& model() const { return simulation.model(); }

  CableSimulation simulation;
  ApexHistory history;
  std::size_t reference = 0, a = 0, b = 0;  // indices of frames
  std::vector<std::size_t> obstacles;
  Eigen::Vector3d rest = Eigen::Vector3d::Zero();  // of the apex, in the reference link [m]
  bool failed = false;
  bool shown = false;  // its markers are in the picture
  std::string message;
  std::uint64_t held = 0;  // telemetry samples
  CableSummary summary;
};

std::vector<std::string> EngineOptions::Check() const {
  std::vector<std::string> problems;
  const auto require = [&](bool good, const char* what, double value, const char* expected) {
    char text[200];
    std::snprintf(text, sizeof text, "%s: got %g, expected %s", what, value, expected);
    if (!good) problems.emplace_back(text);
  };
  require(dt >= 1e-5 && dt <= 0.02, "dt", dt, "1e-5 to 0.02 s");
  require(telemetry_rate > 0 && telemetry_rate * dt <= 1 + 1e-9, "telemetry_rate", telemetry_rate,
          "more than 0 and at most 1/dt Hz");
  require(marker_rate >= 0 && marker_rate * dt <= 1 + 1e-9, "marker_rate", marker_rate,
          "0 (none) to 1/dt Hz");
  require(diagnostics_rate > 0 && diagnostics_rate * dt <= 1 + 1e-9, "diagnostics_rate",
          diagnostics_rate, "more than 0 and at most 1/dt Hz");
  require(amplitude_window >= dt && amplitude_window <= 60, "amplitude_window", amplitude_window,
          "dt to 60 s");
  require(clearance_reach > 0 && clearance_reach <= 10, "clearance_reach", clearance_reach,
          "more than 0 and at most 10 m");
  require(links.max_gap > 0 && links.max_gap <= 10, "max_gap", links.max_gap,
          "more than 0 and at most 10 s");
  require(markers.curvature_scale >= 0 && std::isfinite(markers.curvature_scale), "curvature_scale",
          markers.curvature_scale, "0 (by diameter) or more 1/m");
  return problems;
}

std::vector<std::string> NeededLinks(const std::vector<CableModel>& cables) {
  std::set<std::string> links;
  for (const CableModel& cable : cables) {
    links.insert({cable.reference, cable.a.link, cable.b.link});
    links.insert(cable.avoid.begin(), cable.avoid.end());
  }
  return {links.begin(), links.end()};
}

BodyMap MakeBodies(const VehicleModel& vehicle) {
  BodyMap bodies;
  MeshStore store;
  for (const auto& [link, shapes] : vehicle.collision) {
    if (!shapes.empty()) bodies[link] = std::make_unique<Body>(shapes, &store);
  }
  return bodies;
}

CableEngine::CableEngine(const VehicleModel& vehicle, const BodyMap& bodies,
                         const std::vector<CableModel>& cables, EngineOptions options)
    : options_(std::move(options)),
      dt_(Period(1 / options_.dt)),
      telemetry_period_(Period(options_.telemetry_rate)),
      marker_period_(Period(options_.marker_rate)),
      diagnostics_period_(Period(options_.diagnostics_rate)),
      vehicle_root_(vehicle.root),
      links_(vehicle, NeededLinks(cables), options_.links) {
  for (const CableModel& model : cables) {
    std::vector<const Body*> obstacles;
    std::vector<std::size_t> frames;
    for (const std::string& link : model.avoid) {
      const auto body = bodies.find(link);
      if (body == bodies.end()) continue;
      obstacles.push_back(body->second.get());
      frames.push_back(FrameIndex(link));
    }
    cables_.emplace_back(model, obstacles, options_, Period(1 / options_.amplitude_window));
    Cable& cable = cables_.back();
    cable.obstacles = std::move(frames);
    cable.reference = FrameIndex(model.reference);
    cable.a = FrameIndex(model.a.link);
    cable.b = FrameIndex(model.b.link);
  }
  std::vector<CableSimulation*> simulations;
  for (Cable& cable : cables_) simulations.push_back(&cable.simulation);
  fleet_ = std::make_unique<CableFleet>(simulations);
  surroundings_.resize(cables_.size());
}

CableEngine::~CableEngine() = default;

std::size_t CableEngine::FrameIndex(const std::string& link) {
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    if (frames_[i].link == link) return i;
  }
  frames_.push_back({link, Motion()});
  return frames_.size() - 1;
}

void CableEngine::Ingest(const tf2_msgs::TFMessage& message, bool is_static) {
  links_.Ingest(message, is_static);
}

void CableEngine::Ingest(const sensor_msgs::JointState& message) { links_.Ingest(message); }

void CableEngine::Finish() {
  links_.Finish();
  finished_ = true;
}

void CableEngine::EvaluateFrames(std::int64_t time) {
  for (Frame& frame : frames_) frame.motion = links_.Follow(frame.link, time);
}

Surroundings CableEngine::SurroundingsOf(const Cable& cable) const {
  Surroundings now;
  now.a = frames_[cable.a].motion * Motion::Resting(cable.model().a.X_LC);
  now.b = frames_[cable.b].motion * Motion::Resting(cable.model().b.X_LC);
  for (const std::size_t i : cable.obstacles) now.obstacles.push_back(frames_[i].motion);
  return now;
}

bool CableEngine::Start(OutputSink* sink) {
  std::int64_t begin = 0, ready = 0;
  if (!links_.Missing().empty() || !links_.Range(&begin, &ready)) {
    links_.DropBefore(links_.last_stamp() - kWaitingHistory);
    return false;
  }
  const bool world_is_certain = !options_.links.world_frame.empty() || finished_ ||
                                links_.world() != vehicle_root_ ||
                                links_.last_stamp() - begin > kWorldGrace;
  if (!world_is_certain) return false;
  const std::int64_t start = (begin + dt_ - 1) / dt_ * dt_;
  if (start > ready) return false;
  now_ = start;
  EvaluateFrames(now_);
  for (Cable& cable : cables_) Settle(&cable);
  started_ = true;
  news_.push_back("cables settled at " + std::to_string(now_ / 1'000'000) +
                  " ms; the inertial frame is '" + links_.world() + "'");
  Emit(sink);
  return true;
}

void CableEngine::Settle(Cable* cable) {
  cable->failed = false;
  cable->history.Clear();
  const StepOutcome outcome = cable->simulation.Settle(SurroundingsOf(*cable));
  if (!outcome.ok) {
    Fail(cable, "no equilibrium at the start: " + outcome.message);
    return;
  }
  cable->message = "swaying";
  Record(cable);
  cable->rest = frames_[cable->reference].motion.X.Inverse() * cable->simulation.Report().apex;
}

void CableEngine::Fail(Cable* cable, const std::string& message) {
  cable->failed = true;
  cable->message = message;
  const std::string path = options_.dump_directory + "/" + cable->model().name + "_" +
                           std::to_string(now_) + ".failed.yaml";
  const bool dumped =
      DumpState(path, cable->simulation, SurroundingsOf(*cable), now_, links_.world(), message);
  cable->summary.failure =
      message + (dumped ? "; state in " + path : "; its state could not be written to " + path);
  news_.push_back("cable '" + cable->model().name + "' stopped at " +
                  std::to_string(now_ / 1'000'000) + " ms: " + cable->summary.failure);
}

void CableEngine::Record(Cable* cable) {
  const CableModel& model = cable->model();
  const Eigen::Vector3d apex_W =
      InterpolateNodes(cable->simulation.nodes(), model.length, model.apex_s).p;
  cable->history.Add(now_, options_.amplitude_frame == AmplitudeFrame::kWorld
                               ? apex_W
                               : frames_[cable->reference].motion.X.Inverse() * apex_W);
}

void CableEngine::StepAll() {
  EvaluateFrames(now_ + dt_);
  std::vector<const Surroundings*> then(cables_.size(), nullptr);
  for (std::size_t i = 0; i < cables_.size(); ++i) {
    if (cables_[i].failed) continue;
    surroundings_[i] = SurroundingsOf(cables_[i]);
    then[i] = &surroundings_[i];
  }
  const std::vector<StepOutcome> outcomes = fleet_->Step(static_cast<double>(dt_) * 1e-9, then);
  for (std::size_t i = 0; i < cables_.size(); ++i) {
    if (!then[i]) continue;
    Cable& cable = cables_[i];
    cable.summary.iterations += static_cast<std::uint64_t>(outcomes[i].iterations);
    if (outcomes[i].substeps > 1) ++cable.summary.retried_steps;
    if (!outcomes[i].ok) {
      Fail(&cable, outcomes[i].message);
      continue;
    }
    ++cable.summary.steps;
  }
  now_ += dt_;
  ++steps_;
  for (Cable& cable : cables_) {
    if (!cable.failed) Record(&cable);
  }
}

void CableEngine::Advance(OutputSink* sink) {
  if (links_.clear_count() != seen_clears_) {
    seen_clears_ = links_.clear_count();
    if (started_) {
      ++resets_;
      news_.push_back("time ran backwards: the cables settle anew");
    }
    started_ = false;
  }
  if (!started_ && !Start(sink)) return;
  std::int64_t begin = 0, ready = 0;
  if (!links_.Range(&begin, &ready)) return;
  while (now_ + dt_ <= ready) {
    StepAll();
    Emit(sink);
    if (steps_ % kDropInterval == 0) links_.DropBefore(now_);
  }
}

bool CableEngine::Due(std::int64_t period) const {
  return period > 0 && now_ / period != (now_ - dt_) / period;
}

void CableEngine::Emit(OutputSink* sink) {
  for (Cable& cable : cables_) {
    if (!cable.failed && Due(telemetry_period_)) EmitTelemetry(&cable, sink);
    if (Due(marker_period_)) EmitMarkers(&cable, sink);
  }
  if (Due(diagnostics_period_)) EmitDiagnostics(sink);
}

void CableEngine::EmitTelemetry(Cable* cable, OutputSink* sink) {
  const CableReport report = cable->simulation.Report();
  ApexTelemetry message =
      MakeTelemetry(report, frames_[cable->reference].motion, cable->rest, now_);
  message.header.frame_id = cable->model().reference;
  message.amplitude = cable->history.PeakToPeak();
  message.held =
      links_.InGap(cable->model().a.link, now_) || links_.InGap(cable->model().b.link, now_);
  if (!IsValid(message)) {
    Fail(cable, "its state is not finite");
    return;
  }
  if (message.held) ++cable->held;
  CableSummary& summary = cable->summary;
  summary.curvature_max = std::max(summary.curvature_max, message.curvature_max);
  summary.clearance_min = std::min(summary.clearance_min, message.clearance);
  summary.contact_force_max = std::max(summary.contact_force_max, message.contact_force);
  summary.tension_max = std::max(summary.tension_max, message.tension);
  summary.amplitude_max = std::max(summary.amplitude_max, message.amplitude);
  summary.dissipated = message.dissipated;
  summary.energy_residual = message.energy_residual;
  sink->Telemetry(cable->model().name, message);
}

void CableEngine::EmitMarkers(Cable* cable, OutputSink* sink) {
  if (!cable->failed) {
    sink->Markers(
        cable->model().name,
        MakeMarkers(cable->simulation, frames_[cable->reference].motion.X, now_, options_.markers));
  } else if (cable->shown) {
    sink->Markers(cable->model().name, DeleteMarkers(cable->model(), now_));
  }
  cable->shown = !cable->failed;
}

void CableEngine::EmitDiagnostics(OutputSink* sink) {
  diagnostic_msgs::DiagnosticArray message;
  message.header.stamp = ToRosTime(now_);
  message.status.push_back(InputDiagnostics(links_, resets_));
  for (const Cable& cable : cables_) {
    message.status.push_back(
        CableDiagnostics(cable.summary, cable.failed, cable.message, cable.held));
  }
  sink->Diagnostics(message);
}

bool CableEngine::AnyFailed() const {
  return std::any_of(cables_.begin(), cables_.end(),
                     [](const Cable& c) { return !c.summary.failure.empty(); });
}

std::vector<std::string> CableEngine::TakeNews() {
  std::vector<std::string> news = std::exchange(news_, {});
  for (std::string& warning : links_.warnings().TakeNew()) news.push_back(std::move(warning));
  return news;
}

Summary CableEngine::MakeSummary() const {
  Summary summary;
  summary.world_frame = links_.world();
  summary.simulated_time = static_cast<double>(steps_) * static_cast<double>(dt_) * 1e-9;
  summary.resets = resets_;
  summary.gaps = links_.gap_count();
  summary.warnings = links_.warnings().counts();
  for (const Cable& cable : cables_) summary.cables.push_back(cable.summary);
  return summary;
}

}  // namespace cosserat_cable
