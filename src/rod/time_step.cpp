// One implicit step of generalised-alpha on the rod's configuration space R^3 x SO(3) per node.
#include <algorithm>
#include <cmath>

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
  Impl& m = *impl_;
  const int first = m.first_free(), last = m.last_free();
  const StepCoefficients c(dt);

  m.PrepareStep(dt);
  if (m.model.held_a) Hold(a, m.node[0], &m.trial[0], &m.trial_rate[0]);
  if (m.model.held_b)
    Hold(b, m.node[m.count - 1], &m.trial[m.count - 1], &m.trial_rate[m.count - 1]);

  // Predictor: constant velocity (one with the acceleration blows up after a velocity jump).
  for (int i = first; i <= last; ++i) {
    const V3 dr = dt * m.node[i].v, dphi = dt * m.node[i].omega;
    m.increment[i] = {{dr.x, dr.y, dr.z, dphi.x, dphi.y, dphi.z}};
  }

  const NodeStep step{m.node.data(),      m.algorithm.data(), m.rate.data(),
                      m.increment.data(), m.trial.data(),     m.trial_algorithm.data(),
                      m.trial_rate.data()};
  const auto balance = [&] {
    UpdateNodes(c, step, first, last);
    m.EvaluateForces();
    SubtractInertia(m.mass.data(), m.inertia.data(), m.trial.data(), m.trial_rate.data(), m.count,
                    m.rhs.data());
  };

  SolveReport report;
  double previous = 0;
  bool refactor = true;
  while (report.iterations < kMaxIterations) {
    ++report.iterations;
    balance();
    if (refactor) m.AssembleTangent(c.velocity_by_increment);
    if (load) m.AddLoad(*load, refactor, c.velocity_by_increment);
    if (refactor) {
      for (int i = first; i <= last; ++i) {
        const V3 j = c.rate_by_increment * m.inertia[i];
        const double mass = c.rate_by_increment * m.mass[i];
        Block6<Scalar>& d = m.system.diagonal(i);
        for (int k = 0; k < 3; ++k) d[k][k] += mass;
        d[3][3] += j.x;
        d[4][4] += j.y;
        d[5][5] += j.z;
      }
      if (!(Factorise(&m.system, first, last) > 0)) return report;
    }
    Solve(m.system, m.rhs.data());
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

  balance();
  if (load) m.AddLoad(*load, false, c.velocity_by_increment);
  for (int e = 0; e < m.model.elements; ++e) {
    const V3 gamma = m.chain.gamma(e) - m.law.gamma0, gamma_dot = m.chain.gamma_dot(e);
    m.shear[e][0] = m.shear1.Commit(m.shear[e][0], gamma.x, gamma_dot.x);
    m.shear[e][1] = m.shear2.Commit(m.shear[e][1], gamma.y, gamma_dot.y);
  }
  for (NodeState& n : m.trial) n.q = Normalized(n.q);  // rounding would add up over many steps
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
