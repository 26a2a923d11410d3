// How a cable comes to rest between clamps and bodies, and how it sets out from there.
#include <algorithm>
#include <array>

#include "cable_simulation_impl.h"
#include "cosserat_cable/math/rotation.h"
#include "cosserat_cable/rod/initial_shape.h"

namespace cosserat_cable {
namespace {

// Equilibrium with contact: rounds of looking for surfaces and settling on them.
constexpr int kMaxContactRounds = 40;
constexpr double kSettledMove = 1e-6;  // of the length, in one round
// Equilibria so far apart in time tell how the cable follows its clamps: short against any motion
// of a vehicle, long enough that accelerations are above the rounding of equilibria.
constexpr double kMoment = 1e-3;  // [s]

/// Where a frame is after `time` [s], its accelerations unchanged.
Pose After(const Motion& m, double time) {
  const double half = 0.5 * time * time;
  const Eigen::Vector3d turn = time * m.omega + half * m.alpha;
  return {m.X.p + time * m.v + half * m.a, (m.X.q * RotationExp(turn)).normalized()};
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

StepOutcome CableSimulation::Settle(const Surroundings& now) {
  Impl& m = *impl_;
  StepOutcome outcome;
  outcome.ok = false;
  if (!IsFinite(now)) {
    outcome.message = "a pose or velocity at rest is not finite";
    return outcome;
  }
  m.now = now;
  m.contact.Reset();
  m.rod.SetConfiguration(
      rod::BowedShape(now.a.X, now.b.X, m.model.length, m.model.elements, m.gravity_W));
  rod::SolveReport report = m.rod.Equilibrate();
  outcome.iterations = report.iterations;
  if (!report.converged) {
    outcome.message =
        "no equilibrium found in " + std::to_string(report.iterations) +
        " iterations (clamps too far apart, or a section parameter out of proportion?)";
    return outcome;
  }
  // Contact at rest: the surfaces near the shape, the shape that they leave, and again.
  bool settled = false;
  for (int round = 0; round < kMaxContactRounds && !settled; ++round) {
    m.TakePositions();
    const std::vector<Eigen::Vector3d> before = m.positions;
    m.contact.Search(m.positions, now.obstacles);
    if (m.contact.empty() && round == 0) {
      settled = true;
      break;
    }
    report = m.rod.Equilibrate(m.load());
    outcome.iterations += report.iterations;
    if (!report.converged) break;
    m.contact.Accept();
    double move = 0;
    for (int i = 0; i <= m.model.elements; ++i)
      move = std::max(move, (ToEigen(m.rod.position(i)) - before[i]).norm());
    settled = move < kSettledMove * m.model.length;
  }
  if (!settled) {
    outcome.message = "no equilibrium found against the bodies that the cable touches at rest";
    return outcome;
  }
  if (!Rests(now)) m.SetOut(now, &outcome);
  m.TakePositions();
  m.contact.Search(m.positions, now.obstacles);
  m.contact.Accept();
  m.UpdateNodes();
  outcome.ok = true;
  return outcome;
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
    std::vector<Pose>& poses = beside[time > 0];
    for (int i = 0; i < count; ++i) {
      poses.push_back(along * rod.pose(i));
      positions[i] = poses.back().p;
    }
    std::vector<Motion> bodies;
    for (const Motion& body : start.obstacles) bodies.push_back(Motion::Resting(After(body, time)));
    contact.Search(positions, bodies);
    moved.SetConfiguration(poses);
    moved.SetClamps(a, After(start.b, time));
    const rod::SolveReport report = moved.Equilibrate(load());
    outcome->iterations += report.iterations;
    if (!report.converged) {
      rod.AddRigidMotion(start.a);
      return;
    }
    for (int i = 0; i < count; ++i) poses[i] = moved.pose(i);
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
