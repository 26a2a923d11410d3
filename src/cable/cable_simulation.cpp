#include "cosserat_cable/cable/cable_simulation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cable_simulation_impl.h"
#include "cosserat_cable/cable/cable_rod.h"
#include "cosserat_cable/cable/resolution.h"
#include "cosserat_cable/input/number_text.h"
#include "cosserat_cable/math/motion_between.h"

namespace cosserat_cable {
namespace {

// A step that does not converge is halved up to so often.
constexpr int kMaxHalvings = 5;

// Needs no more than the two ends, and is off from a smooth way between them by O(h^6) only: so
// those who step need not tell the way.
Surroundings Between(const Surroundings& left, const Surroundings& right, double h, double time) {
  Surroundings between;
  between.load = right.load;
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

}  // namespace

bool IsFinite(const Surroundings& s) {
  return IsFinite(s.a) && IsFinite(s.b) &&
         std::all_of(s.obstacles.begin(), s.obstacles.end(),
                     [](const Motion& m) { return IsFinite(m); });
}

StepOutcome RefuseNonFinite() {
  StepOutcome outcome;
  outcome.ok = false;
  outcome.substeps = 0;
  outcome.message = "a clamp's or body's motion is not finite";
  return outcome;
}

CableSimulation::Impl::Impl(const CableModel& m, rod::Rod at_start,
                            const std::vector<const Body*>& bodies, double clearance_reach)
    : model(m),
      rod(std::move(at_start)),
      contact(m, bodies),
      nearest(contact.sites(), bodies, clearance_reach + 0.5 * m.diameter),
      nodes(m.elements + 1),
      positions(m.elements + 1) {}

CableSimulation::CableSimulation(const CableModel& model, std::vector<const Body*> obstacles,
                                 const Eigen::Vector3d& gravity_W, double clearance_reach)
    : impl_(std::make_unique<Impl>(model, rod::Rod(MakeRodModel(model, gravity_W)), obstacles,
                                   clearance_reach)) {}
CableSimulation::CableSimulation(const CableModel& model, rod::Rod rod, const Surroundings& now,
                                 std::vector<const Body*> obstacles, double clearance_reach)
    : impl_(std::make_unique<Impl>(model, std::move(rod), obstacles, clearance_reach)) {
  impl_->Begin(now);
}
CableSimulation::~CableSimulation() = default;
CableSimulation::CableSimulation(CableSimulation&&) noexcept = default;
CableSimulation& CableSimulation::operator=(CableSimulation&&) noexcept = default;

StepOutcome CableSimulation::Step(double dt, const Surroundings& then) {
  Impl& m = *impl_;
  if (!IsFinite(then)) return RefuseNonFinite();
  m.TakeSection(then);
  m.SearchContact(dt, then);
  const rod::SolveReport report = m.rod.Step(dt, then.a.X, then.b.X, m.LoadIn(then));
  if (!report.converged) return m.StepInParts(dt, then, report.iterations);
  m.Accept(then);
  StepOutcome outcome;
  outcome.iterations = report.iterations;
  return outcome;
}

StepOutcome CableSimulation::Impl::StepInParts(double dt, const Surroundings& then,
                                               int iterations_so_far) {
  StepOutcome outcome;
  outcome.iterations = iterations_so_far;
  outcome.substeps = 0;
  rod::Rod rod_at_start = rod;
  ContactSet contact_at_start = contact;
  double done = 0, step = 0.5 * dt;
  int halvings = 1;
  while (done < dt) {
    const bool last = done + step >= dt * (1 - 1e-9);
    const double part = last ? dt - done : step;
    const Surroundings next = last ? then : Between(now, then, dt, done + step);
    SearchContact(part, next);
    const rod::SolveReport report = rod.Step(part, next.a.X, next.b.X, LoadIn(next));
    outcome.iterations += report.iterations;
    if (report.converged) {
      contact.Accept();
      ++outcome.substeps;
      done = last ? dt : done + step;
    } else if (halvings < kMaxHalvings) {
      ++halvings;
      step *= 0.5;
    } else {
      rod = std::move(rod_at_start);
      contact = std::move(contact_at_start);
      outcome.ok = false;
      outcome.message = WhyNotConverged(step);
      return outcome;
    }
  }
  now = then;
  nodes_are_known = false;
  return outcome;
}

std::vector<double> CableSimulation::State() const {
  StateArchive state;
  impl_->ExchangeState(&state);
  std::vector<double> numbers = state.numbers();
  const std::vector<double> of_rod = impl_->rod.State();
  numbers.insert(numbers.end(), of_rod.begin(), of_rod.end());
  return numbers;
}

void CableSimulation::SetState(const std::vector<double>& state) {
  Impl& m = *impl_;
  StateArchive own;
  m.ExchangeState(&own);
  const std::size_t count = std::min(own.numbers().size(), state.size());
  const auto middle = state.begin() + static_cast<std::ptrdiff_t>(count);
  StateArchive archive({state.begin(), middle});
  m.ExchangeState(&archive);
  m.rod.SetState({middle, state.end()});
  m.nodes_are_known = false;
}

std::string CableSimulation::Impl::WhyNotConverged(double step) const {
  double tension = 0, curvature = 0;
  for (int e = 0; e < model.elements; ++e) {
    tension = std::max(tension, rod.force(e).z());
    curvature = std::max(curvature, rod.curvature(e).head<2>().norm());
  }
  const std::string too_long = TooLongElements(model, tension, curvature);
  return "Newton's iteration does not converge, with steps down to " + FormatRounded(1e6 * step) +
         " us: do clamps or bodies jump, or shake faster than the time step resolves?" +
         (too_long.empty() ? "" : " Or else, " + too_long);
}

const CableModel& CableSimulation::model() const { return impl_->model; }
const rod::Rod& CableSimulation::rod() const { return impl_->rod; }
const std::vector<Pose>& CableSimulation::nodes() const { return impl_->Nodes(); }
Pose CableSimulation::node(int i) const { return impl_->rod.pose(i); }

std::vector<double> CableSimulation::curvatures() const {
  std::vector<double> curvatures(impl_->model.elements);
  for (int e = 0; e < impl_->model.elements; ++e)
    curvatures[e] = impl_->rod.curvature(e).head<2>().norm();
  return curvatures;
}

std::vector<ContactPoint> CableSimulation::contacts() const {
  return impl_->contact.Points(impl_->rod);
}

ContactPoint CableSimulation::DeepestContact() const {
  ContactPoint deepest;
  if (impl_->contact.empty()) return deepest;
  for (const ContactPoint& point : contacts())
    if (deepest.obstacle < 0 || point.penetration > deepest.penetration) deepest = point;
  return deepest;
}

std::vector<rod::Mode> CableSimulation::FindModes(int count) const {
  return rod::FindModes(impl_->rod, count, impl_->LoadIn(impl_->now));
}

CableReport CableSimulation::Report() {
  CableReport report = ReportForces();
  report.clearance = Clearance(posture());
  return report;
}

CablePosture CableSimulation::posture() const {
  CablePosture posture;
  posture.nodes.reserve(static_cast<std::size_t>(impl_->model.elements) + 1);
  for (int i = 0; i <= impl_->model.elements; ++i)
    posture.nodes.push_back(ToEigen(impl_->rod.position(i)));
  posture.a = impl_->now.a.X;
  posture.obstacles = impl_->now.obstacles;
  return posture;
}

double CableSimulation::Clearance(const CablePosture& posture) {
  return impl_->nearest.Distance(posture.a, posture.nodes, posture.obstacles) -
         0.5 * impl_->model.diameter;
}

CableReport CableSimulation::ReportForces() const {
  const Impl& m = *impl_;
  const double h = m.model.length / m.model.elements;
  CableReport report;
  const int e = std::clamp(static_cast<int>(m.model.apex_s / h), 0, m.model.elements - 1);
  const double xi = m.model.apex_s / h - e;
  report.apex = (1 - xi) * ToEigen(m.rod.position(e)) + xi * ToEigen(m.rod.position(e + 1));
  report.apex_velocity =
      (1 - xi) * ToEigen(m.rod.velocity(e)) + xi * ToEigen(m.rod.velocity(e + 1));
  report.tension_max = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < m.model.elements; ++i) {
    report.curvature_max = std::max(report.curvature_max, m.rod.curvature(i).head<2>().norm());
    report.tension_max = std::max(report.tension_max, m.rod.force(i).z());
  }
  for (const ContactPoint& point : contacts()) report.contact_force += point.force_W.norm();
  const rod::Wrench a = m.rod.reaction_a(), b = m.rod.reaction_b();
  report.force_a = a.force;
  report.moment_a = a.moment;
  report.force_b = b.force;
  report.moment_b = b.moment;
  report.energy = m.rod.energy_balance();
  return report;
}

}  // namespace cosserat_cable
