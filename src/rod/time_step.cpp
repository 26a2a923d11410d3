// One implicit step of generalised-alpha on the rod's configuration space R^3 x SO(3) per node.
#include <algorithm>
#include <cmath>

#include "cosserat_cable/rod/generalized_alpha.h"
#include "rod_impl.h"

namespace cosserat_cable::rod {
namespace {

constexpr int kMaxIterations = 12;
// Newton stops where the error still left, last correction times contraction, is below this
// fraction of the length (and rad): 2e-9 m for a 200 mm cable.
constexpr double kTolerance = 1e-8;
// A contraction worse than this is not worth keeping the factors for.
constexpr double kRefactorAbove = 0.2;
// A correction this small is converged whatever the contraction.
constexpr double kRoundOff = 1e-12;

V3 Translation(const Vec6<Scalar>& d) { return {d[0], d[1], d[2]}; }
V3 Rotation(const Vec6<Scalar>& d) { return {d[3], d[4], d[5]}; }

/// The system is solved for the variation phi in the section's frame; the step's rotation vector
/// Theta changes by Jr(Theta)^{-1} phi = phi + Theta x phi/2 + Theta x (Theta x phi)/12. With that,
/// the rates' tangent is `velocity_by_increment` times the strains' to first order in Theta: what
/// both leave out cancels.
void Correct(const Vec6<Scalar>& correction, Vec6<Scalar>* increment) {
  const V3 theta = Rotation(*increment), phi = Rotation(correction);
  const V3 across = Cross(theta, phi);
  const V3 d = phi + 0.5 * across + (1.0 / 12) * Cross(theta, across);
  for (int k = 0; k < 3; ++k) (*increment)[k] += correction[k];
  (*increment)[3] += d.x;
  (*increment)[4] += d.y;
  (*increment)[5] += d.z;
}

void Hold(const Motion& motion, const NodeState& before, NodeState* node, NodeRates* rate) {
  node->r = ToSmall(motion.X.p);
  node->q = ToSmall(motion.X.q);
  // q and -q are the same rotation: stay on the side from which the neighbours were reached.
  if (Dot(node->q, before.q) < 0) node->q = {-node->q.w, -node->q.x, -node->q.y, -node->q.z};
  node->v = ToSmall(motion.v);
  node->omega = ToSmall(motion.omega);
  *rate = {ToSmall(motion.a), ToSmall(motion.alpha)};
}

}  // namespace

SolveReport Rod::Step(double dt, const Motion& a, const Motion& b, const Load* load) {
  static constexpr GeneralizedAlpha kScheme{};
  Impl& m = *impl_;
  const int first = m.first_free(), last = m.last_free();
  const double velocity_by_increment = kScheme.gamma / (kScheme.beta * dt);
  const double acceleration_by_increment = 1.0 / (kScheme.beta * dt * dt);
  const double rate_by_increment =
      acceleration_by_increment * (1 - kScheme.alpha_m) / (1 - kScheme.alpha_f);

  m.PrepareStep(dt);
  if (m.model.held_a) Hold(a, m.node[0], &m.trial[0], &m.trial_rate[0]);
  if (m.model.held_b)
    Hold(b, m.node[m.count - 1], &m.trial[m.count - 1], &m.trial_rate[m.count - 1]);

  // Predictor: constant velocity (one with the acceleration blows up after a velocity jump).
  for (int i = first; i <= last; ++i) {
    const V3 dr = dt * m.node[i].v, dphi = dt * m.node[i].omega;
    m.increment[i] = {{dr.x, dr.y, dr.z, dphi.x, dphi.y, dphi.z}};
  }

  // Node state and rates that belong to the increment.
  const auto update = [&] {
    for (int i = first; i <= last; ++i) {
      const NodeState& from = m.node[i];
      const NodeRates &a0 = m.algorithm[i], &rate0 = m.rate[i];
      const V3 dr = Translation(m.increment[i]), dphi = Rotation(m.increment[i]);
      const double half_minus_beta = 0.5 - kScheme.beta;
      NodeRates& a1 = m.trial_algorithm[i];
      a1.v = acceleration_by_increment * (dr - dt * from.v - (dt * dt * half_minus_beta) * a0.v);
      a1.omega = acceleration_by_increment *
                 (dphi - dt * from.omega - (dt * dt * half_minus_beta) * a0.omega);
      NodeState& to = m.trial[i];
      to.r = from.r + dr;
      to.q = Normalized(from.q * Exp(dphi));
      to.v = from.v + (dt * (1 - kScheme.gamma)) * a0.v + (dt * kScheme.gamma) * a1.v;
      to.omega =
          from.omega + (dt * (1 - kScheme.gamma)) * a0.omega + (dt * kScheme.gamma) * a1.omega;
      const double scale = 1 / (1 - kScheme.alpha_f);
      m.trial_rate[i].v = scale * ((1 - kScheme.alpha_m) * a1.v + kScheme.alpha_m * a0.v -
                                   kScheme.alpha_f * rate0.v);
      m.trial_rate[i].omega = scale * ((1 - kScheme.alpha_m) * a1.omega +
                                       kScheme.alpha_m * a0.omega - kScheme.alpha_f * rate0.omega);
    }
  };
  const auto balance = [&] {
    m.EvaluateForces();
    for (int i = 0; i < m.count; ++i) {
      const V3 f = m.mass[i] * m.trial_rate[i].v;
      const V3& omega = m.trial[i].omega;
      const V3 g =
          Scale(m.inertia[i], m.trial_rate[i].omega) + Cross(omega, Scale(m.inertia[i], omega));
      Vec6<Scalar>& b = m.rhs[i];
      b[0] -= f.x;
      b[1] -= f.y;
      b[2] -= f.z;
      b[3] -= g.x;
      b[4] -= g.y;
      b[5] -= g.z;
    }
  };

  SolveReport report;
  double previous = 0;
  bool refactor = true;
  while (report.iterations < kMaxIterations) {
    ++report.iterations;
    update();
    balance();
    if (refactor) m.AssembleTangent(velocity_by_increment);
    if (load) m.AddLoad(*load, refactor, velocity_by_increment);
    if (refactor) {
      for (int i = first; i <= last; ++i) {
        const V3 j = rate_by_increment * m.inertia[i];
        const double mass = rate_by_increment * m.mass[i];
        Block6<Scalar>& d = m.system.diagonal(i);
        for (int k = 0; k < 3; ++k) d[k][k] += mass;
        d[3][3] += j.x;
        d[4][4] += j.y;
        d[5][5] += j.z;
      }
      if (!(m.system.Factorise(first, last) > 0)) return report;
    }
    m.system.Solve(m.rhs.data());
    report.correction = m.CorrectionNorm();
    if (!std::isfinite(report.correction)) return report;
    for (int i = first; i <= last; ++i) Correct(m.rhs[i], &m.increment[i]);

    const double contraction = previous > 0 ? report.correction / previous : 1.0;
    if (report.correction < kRoundOff || contraction * report.correction < kTolerance) {
      report.converged = true;
      break;
    }
    refactor = previous > 0 && contraction > kRefactorAbove;
    previous = report.correction;
  }
  if (!report.converged) return report;

  update();
  balance();
  if (load) m.AddLoad(*load, false, velocity_by_increment);
  for (int e = 0; e < m.model.elements; ++e) {
    const ElementState<Scalar>& state = m.element[e];
    m.shear[e][0] =
        m.shear1.Commit(m.shear[e][0], state.gamma.x - m.law.gamma0.x, state.gamma_dot.x);
    m.shear[e][1] =
        m.shear2.Commit(m.shear[e][1], state.gamma.y - m.law.gamma0.y, state.gamma_dot.y);
  }
  std::swap(m.node, m.trial);
  std::swap(m.rate, m.trial_rate);
  std::swap(m.algorithm, m.trial_algorithm);
  return report;
}

void Rod::Predict(double dt, const Motion& a, const Motion& b,
                  std::vector<Eigen::Vector3d>* positions) const {
  const Impl& m = *impl_;
  positions->resize(m.count);
  for (int i = 0; i < m.count; ++i) (*positions)[i] = ToEigen(m.node[i].r + dt * m.node[i].v);
  if (m.model.held_a) positions->front() = a.X.p;
  if (m.model.held_b) positions->back() = b.X.p;
}

}  // namespace cosserat_cable::rod
