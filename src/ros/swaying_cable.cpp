#include "swaying_cable.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "cosserat_cable/cable/contact_stiffness.h"
#include "cosserat_cable/cable/resolution.h"
#include "cosserat_cable/ros/markers.h"
#include "cosserat_cable/ros/telemetry.h"
#include "diagnostics.h"

namespace cosserat_cable {
namespace {

// Neither the console nor the disk, which takes a state each time, is filled by a cable that fails
// again and again.
constexpr int kMostDoublings = 10;

}  // namespace

CableEngine::SwayingCable::SwayingCable(const CableModel& model, std::vector<const Body*> obstacles,
                                        Frames frames, std::size_t index,
                                        const EngineOptions& options)
    : options_(options),
      simulation_(model, std::move(obstacles), options.gravity_W, options.clearance_reach),
      frames_(std::move(frames)),
      index_(index),
      history_(std::llround(1e9 * options.amplitude_window)),
      clamps_(model.name, model.length, model.diameter) {
  surroundings_.obstacles.resize(frames_.obstacles.size());
  summary_.name = model.name;
  summary_.bodies = frames_.obstacles.size();
  summary_.radius = 0.5 * model.diameter;
  summary_.contact_stiffness = model.contact.stiffness;
}

diagnostic_msgs::DiagnosticStatus CableEngine::SwayingCable::Diagnostics() const {
  return CableDiagnostics(summary(), failed_, message_, held_);
}

CableSummary CableEngine::SwayingCable::summary() const {
  CableSummary summary = summary_;
  summary.clamps = clamps_.range();
  return summary;
}

void CableEngine::SwayingCable::JudgeClamps(const Instant& now) {
  clamps_.Add(now.time, now.frames[frames_.a].X * model().a.X_LC,
              now.frames[frames_.b].X * model().b.X_LC);
}

void CableEngine::SwayingCable::Surround(const Instant& now) {
  surroundings_.a = now.frames[frames_.a] * model().a.X_LC;
  surroundings_.b = now.frames[frames_.b] * model().b.X_LC;
  for (std::size_t i = 0; i < frames_.obstacles.size(); ++i)
    surroundings_.obstacles[i] = now.frames[frames_.obstacles[i]];
}

void CableEngine::SwayingCable::Settle(const Instant& now, const std::string& world) {
  failed_ = false;
  history_.Clear();
  clamps_.Restart();
  JudgeClamps(now);
  Surround(now);
  const StepOutcome outcome = simulation_.Settle(surroundings_, Unstable::kFalls);
  if (!outcome.ok) {
    Fail(StateDump::Failed::kSettling, SettlingFailure(outcome), now.time, world);
    return;
  }
  if (!outcome.remark.empty()) {
    summary_.rest_remark = outcome.remark;
    news_.push_back("cable '" + model().name + "': " + outcome.remark);
  }
  message_ = "swaying";
  Record(now);
  rest_ = now.frames[frames_.reference].X.Inverse() * simulation_.ReportForces().apex;
}

const Surroundings* CableEngine::SwayingCable::Then(const Instant& then) {
  if (failed_) return nullptr;
  Surround(then);
  return &surroundings_;
}

void CableEngine::SwayingCable::Take(const StepOutcome& outcome, const Instant& then,
                                     std::int64_t from, const std::string& world) {
  dt_ = static_cast<double>(then.time - from) * 1e-9;
  summary_.iterations += static_cast<std::uint64_t>(outcome.iterations);
  if (outcome.substeps > 1) ++summary_.retried_steps;
  if (!outcome.ok) {
    Fail(StateDump::Failed::kStep, outcome.message, from, world);
    return;
  }
  ++summary_.steps;
  Record(then);
}

bool CableEngine::SwayingCable::MaySettleAgain(std::int64_t time) const {
  if (!failed_ || !(options_.settle_again > 0)) return false;
  const double wait = std::ldexp(options_.settle_again, std::min(failures_ - 1, kMostDoublings));
  return static_cast<double>(time - failed_at_) * 1e-9 >= wait;
}

void CableEngine::SwayingCable::Fail(StateDump::Failed failed, const std::string& message,
                                     std::int64_t time, const std::string& world) {
  failed_ = true;
  failed_at_ = time;
  ++failures_;
  message_ = message;
  const std::string path =
      options_.dump_directory + "/" + model().name + "_" + std::to_string(time) + ".failed.yaml";
  StateDump dump;
  dump.failed = failed;
  dump.message = message;
  dump.cable.cables = {model()};
  dump.stamp = time;
  dump.world_frame = world;
  dump.gravity_W = options_.gravity_W;
  dump.vehicle_file = options_.vehicle_file;
  dump.obstacles = frames_.obstacle_names;
  dump.dt = dt_;
  dump.then = surroundings_;
  dump.state = simulation_.State();
  dump.nodes = simulation_.nodes();
  summary_.failure =
      message + (WriteStateDump(path, dump) ? "; state in " + path
                                            : "; its state could not be written to " + path);
  news_.push_back("cable '" + model().name + "' stopped at " + StampText(time) + ": " +
                  summary_.failure);
}

void CableEngine::SwayingCable::Record(const Instant& now) {
  const Eigen::Vector3d apex_W = PositionAt(simulation_, model().apex_s);
  JudgeDepth(now.time);
  history_.Add(now.time, options_.amplitude_frame == AmplitudeFrame::kWorld
                             ? apex_W
                             : now.frames[frames_.reference].X.Inverse() * apex_W);
}

// How much deeper it will get, and so which stiffness would do, is not known yet.
std::string CableEngine::SwayingCable::TooDeep() const {
  char text[120];
  std::snprintf(text, sizeof text, "sinks by more than %.0f %% of its radius into '",
                100 * kDeepestShareOfRadius);
  return "cable '" + model().name + "' " + text + summary_.penetration_body + "', from " +
         StampText(summary_.penetration_time) +
         " on: its contact forces are too small; the summary says which stiffness would do";
}

// Said once, when it is first too deep; the summary has the deepest.
void CableEngine::SwayingCable::JudgeDepth(std::int64_t time) {
  const ContactPoint deepest = simulation_.DeepestContact();
  if (deepest.obstacle < 0 || deepest.penetration <= summary_.penetration_max) return;
  const bool was_too_deep = summary_.stiffness_needed > 0;
  summary_.penetration_max = deepest.penetration;
  summary_.penetration_time = time;
  summary_.penetration_s = deepest.s;
  summary_.penetration_body = frames_.obstacle_names[static_cast<std::size_t>(deepest.obstacle)];
  summary_.stiffness_needed = SufficientContactStiffness(model(), deepest.penetration);
  if (summary_.stiffness_needed > 0 && !was_too_deep) news_.push_back(TooDeep());
}

void CableEngine::SwayingCable::Tell(const Instant& now, const std::string& world) {
  if (now.telemetry) JudgeClamps(now);
  if (now.telemetry && !failed_ && !TellTelemetry(now))
    Fail(StateDump::Failed::kState, kNotFinite, now.time, world);
  if (!now.markers) return;
  if (!failed_) {
    told_.push_back({now.time, index_,
                     InRecordedFrame(MakeMarkers(simulation_, now.frames[frames_.reference].X,
                                                 now.time, options_.markers))});
  } else if (shown_) {
    told_.push_back({now.time, index_, InRecordedFrame(DeleteMarkers(model(), now.time))});
  }
  shown_ = !failed_;
}

// Viewers know the frames by the names under which they were recorded.
visualization_msgs::MarkerArray CableEngine::SwayingCable::InRecordedFrame(
    visualization_msgs::MarkerArray markers) const {
  for (auto& marker : markers.markers)
    marker.header.frame_id = WholePrefix(options_.links.tf_prefix) + marker.header.frame_id;
  return markers;
}

// Said once; the summary has what the most that it carried asks for.
void CableEngine::SwayingCable::JudgeElements(double tension, double curvature) {
  if (tension <= summary_.tension_max && curvature <= summary_.curvature_max) return;
  summary_.tension_max = std::max(summary_.tension_max, tension);
  summary_.curvature_max = std::max(summary_.curvature_max, curvature);
  const bool was_said = !summary_.long_elements.empty();
  summary_.long_elements = TooLongElements(model(), summary_.tension_max, summary_.curvature_max);
  if (!was_said && !summary_.long_elements.empty())
    news_.push_back("cable '" + model().name + "': " + summary_.long_elements);
}

// False where something is not finite: nothing is told then.
bool CableEngine::SwayingCable::TellTelemetry(const Instant& now) {
  ApexTelemetry message =
      MakeTelemetry(simulation_.ReportForces(), now.frames[frames_.reference], rest_, now.time);
  message.header.frame_id = WholePrefix(options_.links.tf_prefix) + model().reference;
  message.amplitude = history_.PeakToPeak();
  message.bodies = static_cast<std::uint32_t>(frames_.obstacles.size());
  message.held = now.in_gap[frames_.a] || now.in_gap[frames_.b];
  CablePosture posture = simulation_.posture();
  const bool finite = std::all_of(posture.nodes.begin(), posture.nodes.end(),
                                  [](const Eigen::Vector3d& p) { return p.allFinite(); });
  if (!finite || !IsValid(message)) return false;
  if (message.held) ++held_;
  summary_.contact_force_max = std::max(summary_.contact_force_max, message.contact_force);
  JudgeElements(message.tension, message.curvature_max);
  summary_.amplitude_max = std::max(summary_.amplitude_max, message.amplitude);
  // Nearly that of the whole cable: clamps a go where their vehicle goes.
  summary_.kinetic_max =
      std::max(summary_.kinetic_max, 0.5 * model().mass_per_length * model().length *
                                         now.frames[frames_.a].v.squaredNorm());
  summary_.dissipated = message.dissipated;
  summary_.energy_residual = message.energy_residual;
  told_.push_back({now.time, index_, std::move(message), std::move(posture)});
  return true;
}

void CableEngine::SwayingCable::MeasureClearance(Told* told) {
  auto* message = std::get_if<ApexTelemetry>(&told->message);
  if (message == nullptr) return;
  message->clearance = simulation_.Clearance(told->posture);
  summary_.clearance_min = std::min(summary_.clearance_min, message->clearance);
}

std::vector<CableEngine::Told> CableEngine::SwayingCable::TakeTold() {
  return std::exchange(told_, {});
}

std::vector<std::string> CableEngine::SwayingCable::TakeNews() { return std::exchange(news_, {}); }

}  // namespace cosserat_cable
