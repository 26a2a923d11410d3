// Static equilibrium: Newton's method on the potential energy, made to descend by a shift of the
// Hessian where it is not positive definite, and by a line search.
#include <algorithm>
#include <cmath>

#include "rod_impl.h"

namespace cosserat_cable::rod {
namespace {

constexpr int kMaxIterations = 300;
constexpr double kTolerance = 1e-10;  // of the correction, relative to the length and in rad
constexpr double kMaxTurn = 0.4;      // rad of one node in one iteration
constexpr double kMaxMove = 0.1;      // of the length, likewise
constexpr double kSufficientDecrease = 1e-4;
constexpr double kFirstShift = 1e-3;     // in units of the bending stiffness of one element
constexpr double kSmallestShift = 1e-7;  // below, none
constexpr double kLargestShift = 1e9;
constexpr int kMaxHalvings = 30;
// Rounding of the energy, relative to the sum of its parts: differences below are noise.
constexpr double kEnergyNoise = 1e-13;

}  // namespace

SolveReport Rod::Equilibrate(const Load* load) {
  Impl& m = *impl_;
  const int first = m.first_free(), last = m.last_free();
  for (NodeState& n : m.node) n.v = n.omega = V3{};
  m.trial = m.node;
  m.PrepareStatics();

  const double bending = std::min(m.law.C_M.x, m.law.C_M.y);
  const double rotation_scale = bending / m.h;                   // [N m]
  const double translation_scale = bending / (m.h * m.h * m.h);  // [N/m]

  double noise = 0;
  const auto energy = [&] {
    const double strain = m.StrainEnergy(), gravity = m.GravityEnergy(m.trial);
    const double outside = load ? load->Energy(m) : 0.0;
    noise = kEnergyNoise * (strain + std::abs(gravity) + std::abs(outside));
    return strain + gravity + outside;
  };

  SolveReport report;
  double shift = 0;
  m.EvaluateForces();
  double current = energy();
  std::vector<NodeState> start;
  std::vector<Vec6<Scalar>> internal, gradient;  // minus the energy's, without and with the load
  while (report.iterations < kMaxIterations) {
    ++report.iterations;
    // Newton direction, with the smallest shift that makes the Hessian positive definite.
    internal = m.rhs;
    for (;;) {
      m.rhs = internal;
      m.AssembleTangent(0.0);
      if (load) m.AddLoad(*load, true, 0.0);
      for (int i = first; i <= last; ++i)
        for (int k = 0; k < 3; ++k) {
          m.system.diagonal(i)[k][k] += shift * translation_scale;
          m.system.diagonal(i)[3 + k][3 + k] += shift * rotation_scale;
        }
      if (Factorise(&m.system, first, last) > 0) break;
      shift = std::max(kFirstShift, 4 * shift);
      if (shift > kLargestShift) return report;
    }
    gradient = m.rhs;
    Solve(m.system, m.rhs.data());
    report.correction = m.CorrectionNorm();
    if (!std::isfinite(report.correction)) return report;

    double turn = 0, move = 0, slope = 0;
    for (int i = first; i <= last; ++i)
      for (int k = 0; k < 3; ++k) {
        move = std::max(move, std::abs(m.rhs[i][k]) / m.model.length);
        turn = std::max(turn, std::abs(m.rhs[i][3 + k]));
        slope -= gradient[i][k] * m.rhs[i][k] + gradient[i][3 + k] * m.rhs[i][3 + k];
      }
    const double longest = std::max(turn / kMaxTurn, move / kMaxMove);
    const std::vector<Vec6<Scalar>> direction = m.rhs;
    start = m.trial;
    double fraction = longest > 1 ? 1 / longest : 1.0;
    bool accepted = false;
    for (int halving = 0; halving < kMaxHalvings && !accepted; ++halving, fraction *= 0.5) {
      for (int i = first; i <= last; ++i) {
        const Vec6<Scalar>& d = direction[i];
        m.trial[i].r = start[i].r + fraction * V3{d[0], d[1], d[2]};
        m.trial[i].q = Normalized(start[i].q * Exp(fraction * V3{d[3], d[4], d[5]}));
      }
      m.EvaluateForces();
      const double next = energy();
      accepted = next <= current + kSufficientDecrease * fraction * slope + noise;
      if (accepted) current = next;
    }
    if (!accepted) {
      m.trial = start;
      m.EvaluateForces();
      shift = std::max(kFirstShift, 4 * shift);
      if (shift > kLargestShift) return report;
      continue;
    }
    // A little shift may stay: a shape that can be turned freely has a singular Hessian.
    if (shift <= kFirstShift && report.correction < kTolerance) {
      report.converged = true;
      break;
    }
    shift = shift > kSmallestShift ? shift / 8 : 0.0;
  }
  if (!report.converged) return report;

  m.node = m.trial;
  for (int e = 0; e < m.model.elements; ++e)
    m.shear[e] = {m.shear1.Rest(m.chain.gamma(e).x - m.law.gamma0.x),
                  m.shear2.Rest(m.chain.gamma(e).y - m.law.gamma0.y)};
  // `rhs` holds forces in balance; at the clamps it holds what they must supply.
  if (load) m.AddLoad(*load, false, 0.0);
  std::fill(m.rate.begin(), m.rate.end(), NodeRates{});
  std::fill(m.algorithm.begin(), m.algorithm.end(), NodeRates{});
  return report;
}

}  // namespace cosserat_cable::rod
