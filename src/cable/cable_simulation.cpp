#include "cosserat_cable/cable/cable_simulation.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "contact_set.h"
#include "cosserat_cable/math/motion_between.h"
#include "cosserat_cable/math/small_eigen.h"
#include "cosserat_cable/rod/initial_shape.h"
#include "cosserat_cable/rod/rod.h"
#include "nearest_body.h"

namespace cosserat_cable {
namespace {

// A step that does not converge is halved up to so often.
constexpr int kMaxHalvings = 5;
// Equilibrium with contact: rounds of looking for surfaces and settling on them.
constexpr int kMaxContactRounds = 40;
constexpr double kSettledMove = 1e-6;  // of the length, in one round

rod::RodModel MakeRodModel(const CableModel& cable, const Eigen::Vector3d& gravity_W) {
  rod::RodModel rod;
  rod.length = cable.length;
  rod.elements = cable.elements;
  rod.gravity = gravity_W;
  rod::Section& section = rod.section;
  section.C_F = {cable.GA1, cable.GA2, cable.EA};
  section.C_M = {cable.EI1, cable.EI2, cable.GJ};
  section.V_F = {cable.eta_GA1, cable.eta_GA2, cable.eta_EA};
  section.V_M = {cable.eta_EI1, cable.eta_EI2, cable.eta_GJ};
  section.rhoA = cable.mass_per_length;
  section.rhoJ = {cable.rhoI(), cable.rhoI(), cable.rhoJ()};
  for (const LumpedMass& m : cable.masses) rod.masses.push_back({m.s, m.mass});
  return rod;
}

Surroundings Between(const Surroundings& left, const Surroundings& right, double h, double time) {
  Surroundings between;
  between.a = MotionBetween(left.a, right.a, h, time);
  between.b = MotionBetween(left.b, right.b, h, time);
  for (std::size_t i = 0; i < right.obstacles.size(); ++i)
    between.obstacles.push_back(MotionBetween(left.obstacles[i], right.obstacles[i], h, time));
  return between;
}

bool IsFinite(const Motion& m) {
  return m.X.p.allFinite() && m.X.q.coeffs().allFinite() && m.v.allFinite() &&
         m.omega.allFinite() && m.a.allFinite() && m.alpha.allFinite();
}

bool IsFinite(const Surroundings& s) {
  return IsFinite(s.a) && IsFinite(s.b) &&
         std::all_of(s.obstacles.begin(), s.obstacles.end(),
                     [](const Motion& m) { return IsFinite(m); });
}

}  // namespace

struct CableSimulation::Impl {
  Impl(const CableModel& m, const std::vector<const Body*>& bodies, const Eigen::Vector3d& gravity,
       double clearance_reach)
      : model(m),
        gravity_W(gravity),
        rod(MakeRodModel(m, gravity)),
        contact(m, bodies),
        nearest(contact.sites(), bodies, clearance_reach + 0.5 * m.diameter),
        nodes(m.elements + 1),
        positions(m.elements + 1) {}

  void UpdateNodes() {
    for (int i = 0; i <= model.elements; ++i) nodes[i] = rod.pose(i);
  }
  void Positions() {
    for (int i = 0; i <= model.elements; ++i) positions[i] = ToEigen(rod.position(i));
  }
  const rod::Load* load() const { return contact.empty() ? nullptr : &contact; }

  rod::SolveReport SubStep(double dt, const Surroundings& then) {
    rod.Predict(dt, then.a, then.b, &positions);
    contact.Search(positions, then.obstacles);
    return rod.Step(dt, then.a, then.b, load());
  }

  CableModel model;
  Eigen::Vector3d gravity_W;
  rod::Rod rod;
  ContactSet contact;
  NearestBody nearest;
  Surroundings now;
  std::vector<Pose> nodes;
  std::vector<Eigen::Vector3d> positions;  // scratch: where contact is searched
};

CableSimulation::CableSimulation(const CableModel& model, std::vector<const Body*> obstacles,
                                 const Eigen::Vector3d& gravity_W, double clearance_reach)
    : impl_(std::make_unique<Impl>(model, obstacles, gravity_W, clearance_reach)) {}
CableSimulation::~CableSimulation() = default;
CableSimulation::CableSimulation(CableSimulation&&) noexcept = default;
CableSimulation& CableSimulation::operator=(CableSimulation&&) noexcept = default;

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
    m.Positions();
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
  m.Positions();
  m.contact.Search(m.positions, now.obstacles);
  m.contact.Accept();
  m.rod.AddRigidMotion(now.a.X.p, now.a.v, now.a.X.q * now.a.omega);
  m.UpdateNodes();
  outcome.ok = true;
  return outcome;
}

StepOutcome CableSimulation::Step(double dt, const Surroundings& then) {
  Impl& m = *impl_;
  StepOutcome outcome;
  outcome.substeps = 0;
  if (!IsFinite(then)) {
    outcome.ok = false;
    outcome.message = "a clamp's or body's motion is not finite";
    return outcome;
  }
  // Halve the step where it does not converge. A step that fails leaves the state as it was.
  std::optional<std::pair<rod::Rod, ContactSet>> start;  // set before the first substep only
  double done = 0, step = dt;
  int halvings = 0;
  while (done < dt) {
    const bool last = done + step >= dt * (1 - 1e-9);
    const rod::SolveReport report =
        m.SubStep(last ? dt - done : step, last ? then : Between(m.now, then, dt, done + step));
    outcome.iterations += report.iterations;
    if (report.converged) {
      m.contact.Accept();
      ++outcome.substeps;
      done = last ? dt : done + step;
    } else if (halvings < kMaxHalvings) {
      if (!start) start.emplace(m.rod, m.contact);
      ++halvings;
      step *= 0.5;
    } else {
      m.rod = std::move(start->first);
      m.contact = std::move(start->second);
      outcome.ok = false;
      outcome.message = "Newton's iteration does not converge, with steps down to " +
                        std::to_string(step * 1e6) + " us";
      return outcome;
    }
  }
  m.now = then;
  m.UpdateNodes();
  return outcome;
}

const CableModel& CableSimulation::model() const { return impl_->model; }
const std::vector<Pose>& CableSimulation::nodes() const { return impl_->nodes; }

std::vector<double> CableSimulation::curvatures() const {
  std::vector<double> curvatures(impl_->model.elements);
  for (int e = 0; e < impl_->model.elements; ++e)
    curvatures[e] = impl_->rod.curvature(e).head<2>().norm();
  return curvatures;
}

std::vector<ContactPoint> CableSimulation::contacts() const {
  return impl_->contact.Points(impl_->rod);
}

CableReport CableSimulation::Report() {
  Impl& m = *impl_;
  const double h = m.model.length / m.model.elements;
  CableReport report;
  const int e = std::clamp(static_cast<int>(m.model.apex_s / h), 0, m.model.elements - 1);
  const double xi = m.model.apex_s / h - e;
  report.apex = (1 - xi) * m.nodes[e].p + xi * m.nodes[e + 1].p;
  report.apex_velocity =
      (1 - xi) * ToEigen(m.rod.velocity(e)) + xi * ToEigen(m.rod.velocity(e + 1));
  report.tension_max = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < m.model.elements; ++i) {
    report.curvature_max = std::max(report.curvature_max, m.rod.curvature(i).head<2>().norm());
    report.tension_max = std::max(report.tension_max, m.rod.force(i).z());
  }
  report.clearance = m.nearest.Distance(m.nodes, m.now.obstacles) - 0.5 * m.model.diameter;
  for (const ContactPoint& point : contacts()) report.contact_force += point.force_W.norm();
  const rod::Wrench a = m.rod.reaction_a(), b = m.rod.reaction_b();
  report.force_a = a.force;
  report.moment_a = a.moment;
  report.force_b = b.force;
  report.moment_b = b.moment;
  return report;
}

}  // namespace cosserat_cable
