// How a cable comes to rest between clamps and bodies, and how it sets out from there.
#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "cable_simulation_impl.h"
#include "cosserat_cable/cable/cable_check.h"
#include "cosserat_cable/cable/extension_law.h"
#include "cosserat_cable/math/rotation.h"
#include "cosserat_cable/rod/initial_shape.h"

namespace cosserat_cable {
namespace {

// Equilibrium with contact: rounds of looking for surfaces and settling on them.
constexpr int kMaxContactRounds = 40;
constexpr double kSettledMove = 1e-6;  // of the length, in one round
// What sinks in deeper is not pressed there but was inside from the start.
constexpr double kDeepest = 0.5;  // of the diameter
// A cable that is paid out: how long it is at first, as the clamps' distance, in how many stages it
// grows, and for how many steps it falls in each and in the last.
constexpr double kShortest = 1.01;
constexpr double kSmallestLoop = 0.05;  // of its length, where the clamps are nearly at one place
constexpr int kStages = 40, kStepsOfStage = 20, kMaxSteps = 20000;
constexpr double kFallStep = 2e-3;  // [s]
// It has fallen where a swing has so much less kinetic energy than the highest.
constexpr double kFallen = 1e-8;
// How much farther than clamps and bodies go, as clamp a sees them, a cable follows them.
constexpr double kFollows = 10;
// Equilibria so far apart in time tell how the cable follows its clamps: short against any motion
// of a vehicle, long enough that accelerations are above the rounding of equilibria.
constexpr double kMoment = 1e-3;  // [s]

// A motion that grows more slowly is not seen in minutes, and hardly told from rounding [1/s].
constexpr double kGrowsSlowly = 0.05;
// How far it is pushed along what grows, of the length; and how often, as one fall may end on
// another saddle.
constexpr double kPush = 0.02;
constexpr int kMostFalls = 4;

/// Where a frame is after `time` [s], its accelerations unchanged.
Pose After(const Motion& m, double time) {
  const double half = 0.5 * time * time;
  const Eigen::Vector3d turn = time * m.omega + half * m.alpha;
  return {m.X.p + time * m.v + half * m.a, (m.X.q * RotationExp(turn)).normalized()};
}

bool HasObstacle(const CableModel& cable) {
  return std::any_of(
      cable.extensions.begin(), cable.extensions.end(),
      [](const CableExtension& extension) { return LawOf(extension).depth != nullptr; });
}

bool Rests(const Motion& m) {
  return m.v.isZero(0) && m.omega.isZero(0) && m.a.isZero(0) && m.alpha.isZero(0);
}

bool Rests(const Surroundings& s) {
  return Rests(s.a) && Rests(s.b) &&
         std::all_of(s.obstacles.begin(), s.obstacles.end(),
                     [](const Motion& m) { return Rests(m); });
}

}  // namespace

StepOutcome CableSimulation::Settle(const Surroundings& now, Unstable unstable) {
  Impl& m = *impl_;
  StepOutcome outcome;
  outcome.ok = false;
  if (!IsFinite(now)) {
    outcome.message = "a pose or velocity at rest is not finite";
    return outcome;
  }
  m.now = now;
  m.contact.Reset();
  m.TakeSection(now);
  m.rod.SetConfiguration(
      rod::BowedShape(now.a.X, now.b.X, m.model.length, m.model.elements, m.rod.model().gravity));
  rod::SolveReport report = m.rod.Equilibrate(now.load);
  outcome.iterations = report.iterations;
  if (!report.converged) {
    const std::string inside = ClampsInside(m.model, now.a.X, now.b.X);
    outcome.message =
        "no equilibrium found in " + std::to_string(report.iterations) + " iterations (" +
        (inside.empty() ? "clamps too far apart, or a section parameter out of proportion?"
                        : inside) +
        ")";
    return outcome;
  }
  m.TakePositions();
  m.contact.Search(now.a.X, m.positions, now.obstacles);
  const double deepest = kDeepest * m.model.diameter, inside = m.Depth();
  const bool settled = m.contact.empty() || m.SettleOnBodies(&outcome);
  if (!settled || m.Depth() > deepest) m.PayOut(&outcome);
  if (m.Depth() > deepest) {
    char text[160];
    std::snprintf(text, sizeof text,
                  "no equilibrium found against the bodies that the cable touches at rest: hanging "
                  "freely it would be %.1f mm deep in them",
                  1e3 * inside);
    outcome.message = text;
    return outcome;
  }
  if (unstable == Unstable::kFalls) {
    outcome.remark = ClampsInside(m.model, now.a.X, now.b.X);
    m.LeaveUnstable(&outcome);
  }
  if (!Rests(now)) m.SetOut(now, &outcome);
  m.Begin(now);
  outcome.ok = true;
  return outcome;
}

double CableSimulation::Impl::Grows(rod::Mode* mode) {
  try {
    std::vector<rod::Mode> modes = rod::FindModes(rod, 1, LoadIn(now));
    if (modes.empty() || modes[0].lambda.real() < kGrowsSlowly) return 0;
    *mode = std::move(modes[0]);
    return mode->lambda.real();
  } catch (const std::runtime_error&) {
    return 0;
  }
}

// By symmetry an arch may stand upright that would fall over, and a straight cable bear more than
// it can. Which way it falls is chance: here it is the positive side of the motion that grows. What
// lies on something is left there: friction would hold it, which contact here has not.
void CableSimulation::Impl::LeaveUnstable(StepOutcome* outcome) {
  const std::vector<ContactPoint> contacts = contact.Points(rod);
  if (std::any_of(contacts.begin(), contacts.end(),
                  [](const ContactPoint& point) { return point.penetration > 0; }) ||
      HasObstacle(model))
    return;
  std::vector<Pose> first(model.elements + 1);
  TakeShape(&first);
  const auto take = [&](const std::vector<Pose>& shape) {
    rod.SetConfiguration(shape);
    rod.SetClamps(now.a.X, now.b.X);
    return SettleOnBodies(outcome) && Depth() <= kDeepest * model.diameter;
  };
  double grows = 0;
  for (int fall = 0; fall < kMostFalls; ++fall) {
    rod::Mode mode;
    const double rate = Grows(&mode);
    if (fall == 0) grows = rate;
    if (rate == 0) break;
    std::vector<Pose> shape(first.size());
    TakeShape(&shape);
    for (std::size_t i = 1; i + 1 < shape.size(); ++i) {
      const double push = kPush * model.length;
      shape[i].p += push * mode.displacement[i];
      shape[i].q = RotationExp(push * mode.rotation[i]) * shape[i].q;
    }
    if (!take(shape)) {
      take(first);
      break;
    }
  }
  if (grows == 0) return;
  rod::Mode mode;
  const double left = Grows(&mode);
  char text[300];
  if (left > 0) {
    std::snprintf(
        text, sizeof text,
        "it rests in an unstable equilibrium: the slightest motion makes it fall (it grows "
        "by a factor e in %.2g s), and what is simulated then is chance; do clamps or "
        "length have to be otherwise?",
        1 / left);
  } else {
    double farthest = 0;
    for (int i = 0; i <= model.elements; ++i)
      farthest = std::max(farthest, (rod.pose(i).p - first[static_cast<std::size_t>(i)].p).norm());
    std::snprintf(
        text, sizeof text,
        "it would balance in an unstable equilibrium, by symmetry; it rests beside it, up to "
        "%.3g mm away, where it falls to: the other side would do as well",
        1e3 * farthest);
  }
  outcome->remark = text;
}

void CableSimulation::Impl::Begin(const Surroundings& start) {
  if (contact.has_bodies()) {
    TakePositions();
    contact.Search(start.a.X, positions, start.obstacles);
  }
  Accept(start);
}

double CableSimulation::Impl::Depth() const {
  double depth = 0;
  for (const ContactPoint& point : contact.Points(rod)) depth = std::max(depth, point.penetration);
  return depth;
}

// The surfaces near the shape, the shape that they leave, and again.
bool CableSimulation::Impl::SettleOnBodies(StepOutcome* outcome) {
  for (int round = 0; round < kMaxContactRounds; ++round) {
    TakePositions();
    const std::vector<Eigen::Vector3d> before = positions;
    contact.Search(now.a.X, positions, now.obstacles);
    const rod::SolveReport report = rod.EquilibrateNearby(LoadIn(now));
    outcome->iterations += report.iterations;
    if (!report.converged) return false;
    contact.Accept();
    TakePositions();
    double move = 0;
    for (int i = 0; i <= model.elements; ++i)
      move = std::max(move, (positions[i] - before[i]).norm());
    if (move < kSettledMove * model.length) return true;
  }
  return false;
}

// The cable that hangs freely is so far inside of a body that it finds no way out. One that is
// hardly longer than its clamps are apart may pass the body by; it grows from there, and falls on
// what is in its way: in steps of time, for on round bodies the way to rest is long. Between falls
// it is stopped.
void CableSimulation::Impl::PayOut(StepOutcome* outcome) {
  Surroundings still{Motion::Resting(now.a.X), Motion::Resting(now.b.X), {}, now.load, nullptr};
  for (const Motion& body : now.obstacles) still.obstacles.push_back(Motion::Resting(body.X));
  const double chord = (now.b.X.p - now.a.X.p).norm() / model.length;
  const double shortest = std::clamp(kShortest * chord, kSmallestLoop, 1.0);
  rod::RodModel growing = rod.model();
  std::vector<Pose> shape =
      rod::BowedShape(now.a.X, now.b.X, shortest * model.length, model.elements, growing.gravity);
  contact.Reset();
  for (int stage = 0; stage <= kStages; ++stage) {
    // The sag of a taut cable grows with the root of its length.
    const double x = static_cast<double>(stage) / kStages;
    growing.section.gamma0.z() = shortest + x * x * (1 - shortest);
    rod = rod::Rod(growing);
    rod.SetConfiguration(shape);
    rod.SetClamps(now.a.X, now.b.X);
    if (stage == 0) outcome->iterations += rod.Equilibrate(now.load).iterations;
    const int steps = stage < kStages ? kStepsOfStage : kMaxSteps;
    double energy = 0, highest = 0;
    for (int step = 0; step < steps; ++step) {
      SearchContact(kFallStep, still);
      const rod::SolveReport report = rod.Step(kFallStep, still.a.X, still.b.X, LoadIn(still));
      outcome->iterations += report.iterations;
      if (!report.converged) break;
      contact.Accept();
      const double before = std::exchange(energy, rod.kinetic_energy());
      highest = std::max(highest, energy);
      if (energy >= before) continue;
      if (stage == kStages && before < kFallen * highest) break;
      TakeShape(&shape);
      rod.SetConfiguration(shape);
      rod.SetClamps(now.a.X, now.b.X);
      energy = 0;
    }
    TakeShape(&shape);
  }
  rod.SetConfiguration(shape);
  rod.SetClamps(now.a.X, now.b.X);
  if (SettleOnBodies(outcome) && Depth() < kDeepest * model.diameter) return;
  // It may slide on for long: what it has come to is a rest as good as any.
  rod.SetConfiguration(shape);
  rod.SetClamps(now.a.X, now.b.X);
  TakePositions();
  contact.Search(now.a.X, positions, now.obstacles);
}

// As if the cable had followed clamps and bodies from equilibrium to equilibrium: a clamp that
// moves already would otherwise tear at a cable that stands still.
void CableSimulation::Impl::SetOut(const Surroundings& start, StepOutcome* outcome) {
  const int count = model.elements + 1;
  std::array<std::vector<Pose>, 2> beside;  // the equilibria before and after
  for (const double time : {-kMoment, kMoment}) {
    rod::Rod moved(rod);
    const Pose a = After(start.a, time);
    const Pose along = a * start.a.X.Inverse();
    const auto way_to = [&](const Pose& from, const Pose& to) {
      return (to.p - from.p).norm() + model.length * to.q.angularDistance(from.q);
    };
    std::vector<Pose>& poses = beside[time > 0];
    for (int i = 0; i < count; ++i) {
      poses.push_back(along * rod.pose(i));
      positions[i] = poses.back().p;
    }
    const Pose b = After(start.b, time);
    double way = model.length * a.q.angularDistance(start.a.X.q) + way_to(along * start.b.X, b);
    std::vector<Motion> bodies;
    for (const Motion& body : start.obstacles) {
      bodies.push_back(Motion::Resting(After(body, time)));
      way += way_to(along * body.X, bodies.back().X);
    }
    contact.Search(a, positions, bodies);
    moved.SetConfiguration(poses);
    moved.SetClamps(a, b);
    const rod::SolveReport report = moved.EquilibrateNearby(LoadIn(now));
    outcome->iterations += report.iterations;
    double farthest = 0;
    for (int i = 0; i < count; ++i)
      farthest =
          std::max(farthest, (moved.pose(i).p - std::exchange(poses[i], moved.pose(i)).p).norm());
    // A cable that may slide goes to an equilibrium elsewhere: nothing to follow.
    if (!report.converged || farthest > kFollows * way) {
      rod.AddRigidMotion(start.a);
      return;
    }
  }
  std::vector<Motion> nodes;
  for (int i = 0; i < count; ++i) {
    Motion node = Motion::Resting(rod.pose(i));
    const auto& [before, after] = beside;
    const Eigen::Vector3d back = RotationLog(node.X.q.conjugate() * before[i].q);
    const Eigen::Vector3d forth = RotationLog(node.X.q.conjugate() * after[i].q);
    node.v = (after[i].p - before[i].p) / (2 * kMoment);
    node.a = (after[i].p - 2 * node.X.p + before[i].p) / (kMoment * kMoment);
    node.omega = (forth - back) / (2 * kMoment);
    node.alpha = (forth + back) / (kMoment * kMoment);
    nodes.push_back(node);
  }
  rod.SetMotion(nodes, start.a, start.b);
}

}  // namespace cosserat_cable
