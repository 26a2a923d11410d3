#include "cosserat_cable/ros/cable_engine.h"

#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <set>
#include <tuple>
#include <utility>

#include "cosserat_cable/ros/conversions.h"
#include "diagnostics.h"
#include "swaying_cable.h"
#include "upright_watch.h"

namespace cosserat_cable {
namespace {

// While only the vehicle's own root is known, a body pose above it may be about to come.
constexpr std::int64_t kWorldGrace = 1'000'000'000;  // [ns]
// Old samples are let go of this often; each time costs a walk over all edges.
constexpr std::uint64_t kDropInterval = 100;  // [steps]
// Cables go so many steps before they wait for each other: far longer than it takes to hand them to
// threads, and short enough to stay in the cache.
constexpr std::size_t kBlock = 32;  // [steps]
// What may pile up while a link is still missing.
constexpr std::int64_t kWaitingHistory = 10'000'000'000;  // [ns]

std::int64_t Period(double rate) {
  return rate > 0 ? static_cast<std::int64_t>(std::llround(1e9 / rate)) : 0;
}

// As EngineOptions says it, in TBB's terms.
int Concurrency(int threads) { return threads > 0 ? threads : oneapi::tbb::task_arena::automatic; }

}  // namespace

/// Cables that go through one kernel together.
struct CableEngine::Group {
  std::vector<const Surroundings*> then;
  std::vector<StepOutcome> outcomes;
};

/// Threads, or the caller's own where there is one.
struct CableEngine::Threads {
  explicit Threads(int count) : arena(Concurrency(count)) {}
  oneapi::tbb::task_arena arena;
};

void EngineOptions::ApplyGravity(Problems* problems) {
  if (!gravity) return;
  if (const auto read = ReadGravity(*gravity, problems)) gravity_W = *read;
}

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
  require(settle_again >= 0 && settle_again <= 3600, "settle_again", settle_again,
          "0 (never) to 3600 s");
  require(threads >= 0 && threads <= 256, "threads", threads, "0 (one per core) to 256");
  require(links.max_gap > 0 && links.max_gap <= 10, "max_gap", links.max_gap,
          "more than 0 and at most 10 s");
  require(links.smooth == 0 || (links.smooth >= 0.1 && links.smooth <= 1000), "smooth",
          links.smooth, "0 (not at all) or 0.1 to 1000 Hz");
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

BodyMap MakeBodies(const VehicleModel& vehicle, int threads) {
  BodyMap bodies;
  MeshStore store;
  oneapi::tbb::task_arena arena(Concurrency(threads));
  arena.execute([&] {
    oneapi::tbb::task_group making;
    for (const bool visual : {false, true}) {
      for (const auto& [link, shapes] : visual ? vehicle.visual : vehicle.collision) {
        if (shapes.empty()) continue;
        making.run([&store, &shapes = shapes, &body = bodies[{link, visual}]] {
          body = std::make_unique<Body>(shapes, &store);
        });
      }
    }
    making.wait();
  });
  return bodies;
}

const Body* FindBody(const BodyMap& bodies, const CableModel& cable, const std::string& link) {
  const auto body = bodies.find({link, cable.avoid_visual.count(link) > 0});
  return body == bodies.end() ? nullptr : body->second.get();
}

CableEngine::CableEngine(const VehicleModel& vehicle, const BodyMap& bodies,
                         const std::vector<CableModel>& cables, EngineOptions options)
    : options_(std::move(options)),
      dt_(Period(1 / options_.dt)),
      telemetry_period_(Period(options_.telemetry_rate)),
      marker_period_(Period(options_.marker_rate)),
      diagnostics_period_(Period(options_.diagnostics_rate)),
      vehicle_root_(vehicle.root),
      links_(vehicle, NeededLinks(cables), options_.links),
      threads_(std::make_unique<Threads>(options_.threads)) {
  if (options_.links.judge)
    upright_ = std::make_unique<UprightWatch>(options_.gravity_W, vehicle_root_);
  for (const CableModel& model : cables) {
    std::vector<const Body*> obstacles;
    std::vector<std::size_t> frames;
    std::vector<std::string> names;
    for (const std::string& link : model.avoid) {
      const Body* body = FindBody(bodies, model, link);
      if (!body) continue;
      obstacles.push_back(body);
      frames.push_back(FrameIndex(link));
      names.push_back(link);
    }
    cables_.push_back(std::make_unique<SwayingCable>(
        model, obstacles,
        SwayingCable::Frames{FrameIndex(model.reference), FrameIndex(model.a.link),
                             FrameIndex(model.b.link), frames, names},
        cables_.size(), options_));
  }
  std::vector<CableSimulation*> simulations;
  for (const auto& cable : cables_) simulations.push_back(cable->simulation());
  fleet_ = std::make_unique<CableFleet>(simulations, threads_->arena.max_concurrency());
  groups_.resize(fleet_->group_count());
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    groups_[g].then.resize(fleet_->members(g).size());
    groups_[g].outcomes.resize(fleet_->members(g).size());
  }
}

CableEngine::~CableEngine() = default;

std::size_t CableEngine::FrameIndex(const std::string& link) const {
  const std::vector<std::string>& all = links_.links();
  return static_cast<std::size_t>(std::find(all.begin(), all.end(), link) - all.begin());
}

void CableEngine::Ingest(const tf2_msgs::TFMessage& message, bool is_static,
                         const std::string& publisher, std::int64_t recorded) {
  links_.Ingest(message, is_static, publisher, recorded);
  if (upright_) upright_->Look(links_);
}

void CableEngine::Ingest(const sensor_msgs::JointState& message, const std::string& publisher,
                         std::int64_t recorded) {
  links_.Ingest(message, publisher, recorded);
  if (upright_) upright_->Look(links_);
}

void CableEngine::Finish() {
  links_.Finish();
  finished_ = true;
}

void CableEngine::Follow(std::int64_t time, Instant* instant) {
  instant->time = time;
  instant->telemetry = Due(telemetry_period_, time);
  instant->markers = send_markers_ && Due(marker_period_, time);
  const std::vector<std::string>& links = links_.links();
  instant->frames.resize(links.size());
  instant->in_gap.resize(links.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    instant->frames[i] = links_.Follow(i, time);
    instant->in_gap[i] = instant->telemetry && links_.InGap(links[i], time);
  }
}

// Up to the next diagnostics: they tell of what all cables did until then.
void CableEngine::FollowBlock(std::int64_t from, std::int64_t ready, std::vector<Instant>* block) {
  // Instants keep their memory from block to block.
  std::size_t count = 0;
  while (from + dt_ <= ready && count < kBlock) {
    from += dt_;
    if (block->size() == count) block->emplace_back();
    Follow(from, &(*block)[count++]);
    if (Due(diagnostics_period_, from)) break;
  }
  block->resize(count);
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
  const std::int64_t start = std::max((begin + dt_ - 1) / dt_ * dt_, not_before_);
  if (start > ready) return false;
  now_ = start;
  // A localisation that begins later corrects the frame; where nothing is known above the vehicle,
  // its own motion may still begin.
  if (links_.world() != vehicle_root_) links_.KeepWorld();
  world_ = links_.world();
  Instant rest;
  Follow(now_, &rest);
  threads_->arena.execute([&] {
    oneapi::tbb::task_group settling;
    for (const auto& cable : cables_)
      settling.run([&, c = cable.get()] { c->Settle(rest, links_.world()); });
    settling.wait();
  });
  started_ = true;
  news_.push_back("cables settled at " + StampText(now_) + "; the inertial frame is '" +
                  links_.world() + "', " + GravityText(options_.gravity_W, links_.world()));
  for (const auto& cable : cables_) cable->Tell(rest, links_.world());
  CollectTold();
  MeasureClearances();
  Deliver(sink);
  return true;
}

// Where the motion that comes has nothing to do with what was.
void CableEngine::Restart() {
  std::string reason;
  if (links_.clear_count() != seen_clears_) {
    seen_clears_ = links_.clear_count();
    reason = links_.clear_reason();
    not_before_ = 0;
    const double lost = static_cast<double>(links_.cleared_until() - now_) * 1e-9;
    if (started_ && lost > 0) {
      char text[80];
      std::snprintf(text, sizeof text, "; the last %.2f s before were not simulated", lost);
      reason += text;
    }
  } else if (started_ && links_.world() != world_) {
    reason = "the vehicle moves in '" + links_.world() + "' from now on, not in '" + world_ + "'";
    not_before_ = now_;
  }
  if (reason.empty()) return;
  if (started_) {
    ++resets_;
    news_.push_back(reason + ": the cables settle anew");
  }
  started_ = false;
}

void CableEngine::Advance(OutputSink* sink, const std::function<bool()>& stop) {
  Restart();
  if (!started_ && !Start(sink)) return;
  std::int64_t begin = 0, ready = 0;
  if (!links_.Range(&begin, &ready)) return;
  SettleAgain();
  std::vector<Instant> block, next;
  FollowBlock(now_, ready, &next);
  while (!next.empty()) {
    std::swap(block, next);
    SwayThrough(block, ready, sink, &next);
    now_ = block.back().time;
    const std::uint64_t drops = steps_ / kDropInterval;
    steps_ += block.size();
    if (steps_ / kDropInterval != drops) links_.DropBefore(now_);
    CollectTold();
    if (stop && stop()) break;
  }
  MeasureClearances();
  Deliver(sink);
}

// What made a cable fail may be over: a pose that was reset, a clamp that was torn away.
void CableEngine::SettleAgain() {
  Instant now;
  for (const auto& cable : cables_) {
    if (!cable->MaySettleAgain(now_)) continue;
    if (now.frames.empty()) Follow(now_, &now);
    cable->Settle(now, links_.world());
    if (!cable->failed())
      news_.push_back("cable '" + cable->model().name + "' settled anew at " + StampText(now_));
  }
}

// While the cables sway through a block, the motion of the next is followed, the clearances of the
// last one are measured, and what was told of the one before is delivered.
void CableEngine::SwayThrough(const std::vector<Instant>& block, std::int64_t ready,
                              OutputSink* sink, std::vector<Instant>* next) {
  threads_->arena.execute([&] {
    oneapi::tbb::task_group tasks;
    // What takes longest goes first: other threads begin with the first of these, this one with the
    // last.
    const std::size_t last = groups_.size() - 1;
    for (std::size_t g = 0; g < last; ++g) tasks.run([&, g] { Sway(g, block); });
    tasks.run([&] { Deliver(sink); });
    for (std::size_t c = 0; c < cables_.size(); ++c) tasks.run([&, c] { MeasureClearances(c); });
    tasks.run([&] { Sway(last, block); });
    tasks.run_and_wait([&] { FollowBlock(block.back().time, ready, next); });
  });
  TakeMeasured();
}

void CableEngine::Sway(std::size_t group, const std::vector<Instant>& block) {
  Group& g = groups_[group];
  const std::vector<std::size_t>& members = fleet_->members(group);
  std::int64_t from = now_;
  for (const Instant& instant : block) {
    for (std::size_t k = 0; k < members.size(); ++k) g.then[k] = cables_[members[k]]->Then(instant);
    fleet_->StepGroup(group, static_cast<double>(dt_) * 1e-9, g.then, &g.outcomes);
    for (std::size_t k = 0; k < members.size(); ++k) {
      SwayingCable& cable = *cables_[members[k]];
      if (g.then[k]) cable.Take(g.outcomes[k], instant, from, links_.world());
      cable.Tell(instant, links_.world());
    }
    from = instant.time;
  }
}

bool CableEngine::Due(std::int64_t period, std::int64_t time) const {
  return period > 0 && time / period != (time - dt_) / period;
}

// In the order of time, and of the cables: whatever thread was first.
void CableEngine::CollectTold() {
  for (const auto& cable : cables_) {
    std::vector<Told> told = cable->TakeTold();
    std::move(told.begin(), told.end(), std::back_inserter(unmeasured_));
  }
  std::stable_sort(unmeasured_.begin(), unmeasured_.end(), [](const Told& a, const Told& b) {
    return std::tie(a.time, a.cable) < std::tie(b.time, b.cable);
  });
  for (const auto& cable : cables_) {
    std::vector<std::string> news = cable->TakeNews();
    std::move(news.begin(), news.end(), std::back_inserter(news_));
  }
  if (Due(diagnostics_period_, now_)) TellDiagnostics();
}

// A cable's are asked for one after the other.
void CableEngine::MeasureClearances(std::size_t cable) {
  for (Told& told : unmeasured_)
    if (told.cable == cable) cables_[cable]->MeasureClearance(&told);
}

void CableEngine::MeasureClearances() {
  threads_->arena.execute([&] {
    oneapi::tbb::task_group tasks;
    for (std::size_t c = 0; c < cables_.size(); ++c) tasks.run([&, c] { MeasureClearances(c); });
    tasks.wait();
  });
  TakeMeasured();
}

void CableEngine::TakeMeasured() {
  std::move(unmeasured_.begin(), unmeasured_.end(), std::back_inserter(told_));
  unmeasured_.clear();
}

// Of all that was told until now.
void CableEngine::TellDiagnostics() {
  MeasureClearances();
  diagnostic_msgs::DiagnosticArray message;
  message.header.stamp = ToRosTime(now_);
  const Findings findings = AllFindings();
  TellFindings(findings);
  message.status.push_back(InputDiagnostics(links_, resets_, findings, options_.links.smooth));
  AddValue("gravity", GravityText(options_.gravity_W, links_.world()), &message.status.back());
  for (const auto& cable : cables_) message.status.push_back(cable->Diagnostics());
  told_.push_back({now_, Told::kNoCable, std::move(message)});
}

void CableEngine::Deliver(OutputSink* sink) {
  for (const Told& told : told_) {
    if (const auto* telemetry = std::get_if<ApexTelemetry>(&told.message))
      sink->Telemetry(cables_[told.cable]->model().name, *telemetry);
    else if (const auto* markers = std::get_if<visualization_msgs::MarkerArray>(&told.message))
      sink->Markers(cables_[told.cable]->model().name, *markers);
    else
      sink->Diagnostics(std::get<diagnostic_msgs::DiagnosticArray>(told.message));
  }
  told_.clear();
}

bool CableEngine::AnyFailed() const {
  return std::any_of(cables_.begin(), cables_.end(),
                     [](const auto& c) { return !c->summary().failure.empty(); });
}

std::vector<std::string> CableEngine::Stopped() const {
  std::vector<std::string> names;
  for (const auto& cable : cables_)
    if (cable->failed()) names.push_back(cable->model().name);
  return names;
}

std::vector<std::string> CableEngine::TakeNews() {
  std::vector<std::string> news = std::exchange(news_, {});
  for (std::string& warning : links_.warnings().TakeNew()) news.push_back(std::move(warning));
  return news;
}

Findings CableEngine::AllFindings() const {
  Findings findings = options_.known;
  const auto add = [&findings](Findings more) {
    std::move(more.begin(), more.end(), std::back_inserter(findings));
  };
  add(links_.MotionFindings(links_.world()));
  if (upright_) add(upright_->Report(links_.world()));
  for (const auto& cable : cables_) add(cable->clamps().Report());
  return findings;
}

// Each kind of each subject once: what was known before the run is not news.
void CableEngine::TellFindings(const Findings& findings) {
  for (const Finding& finding : findings) {
    const bool is_new = told_findings_.insert(finding.kind + " " + finding.subject).second;
    const bool is_known =
        std::any_of(options_.known.begin(), options_.known.end(), [&](const Finding& known) {
          return known.kind == finding.kind && known.subject == finding.subject;
        });
    if (is_new && !is_known) news_.push_back(finding.ToString());
  }
}

Summary CableEngine::MakeSummary() const {
  Summary summary;
  summary.world_frame = links_.world();
  summary.gravity_W = options_.gravity_W;
  summary.use_record_times = options_.links.topics.use_record_times;
  summary.simulated_time = static_cast<double>(steps_) * static_cast<double>(dt_) * 1e-9;
  summary.resets = resets_;
  summary.gaps = links_.gap_count();
  summary.warnings = links_.warnings().counts();
  summary.warning_sentences =
      links_.warnings().Sentences(options_.links.judge ? 0 : links_.Start());
  summary.findings = AllFindings();
  summary.smooth = options_.links.smooth;
  for (const auto& cable : cables_) summary.cables.push_back(cable->summary());
  return summary;
}

}  // namespace cosserat_cable
