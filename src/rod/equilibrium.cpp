// Static equilibrium: Newton's method on the potential energy, made to descend by a shift of the
// Hessian where it is not positive definite, and by a line search.
#include <algorithm>
#include <cmath>

#include "lane_view.h"
#include "rod_impl.h"
#include "static_ends.h"
#include "step_kernels.h"

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
// Strains below are rounding: a rod without any load has no energy to compare with.
constexpr double kStrainNoise = 1e-10;

}  // namespace

SolveReport Rod::Equilibrate(const Load* load) {
  Impl& m = *impl_;
  const int first = m.first_free(), last = m.last_free();
  for (NodeState& n : m.w.node) n.v = n.omega = V3{};
  for (EndPart* end : {&m.ends.a, &m.ends.b}) end->Start(Motion::Resting(end->clamp().X));
  m.w.trial = m.w.node;
  ImposeEnds(m.ends, &m.w);
  m.PrepareStatics();

  const double bending = std::min(m.w.law.C_M.x, m.w.law.C_M.y);
  const double rotation_scale = bending / m.h;                   // [N m]
  const double translation_scale = bending / (m.h * m.h * m.h);  // [N/m]

  const LaneView<double> view(&m.w, 0);
  const double unstrained_noise = kStrainNoise * kStrainNoise * m.w.law.C_F.z * m.model.length;
  double noise = 0;
  const auto energy = [&] {
    const double strain = m.StaticEnergy(), gravity = m.GravityEnergy(m.w.trial);
    const double outside = load ? load->Energy(view) : 0.0;
    noise = kEnergyNoise * (strain + std::abs(gravity) + std::abs(outside)) + unstrained_noise;
    return strain + gravity + outside;
  };

  // Without a potential there is nothing to descend: plain Newton, its steps bounded.
  const bool descends = !load || load->HasPotential();
  SolveReport report;
  double shift = 0;
  EvaluateForces(&m.w);
  double current = energy();
  std::vector<NodeState> start;
  std::vector<Vec6<double>> internal, gradient;  // minus the energy's, without and with the load
  while (report.iterations < kMaxIterations) {
    ++report.iterations;
    // Newton direction, with the smallest shift that makes the Hessian positive definite.
    internal = m.w.rhs;
    for (;;) {
      m.w.rhs = internal;
      AssembleTangent(0.0, &m.w);
      if (load) AddLoad(*load, 0, true, 0.0, &m.w);
      ConstrainEnds(m.ends, &m.w);
      for (int i = first; i <= last; ++i)
        for (int k = 0; k < 3; ++k) {
          m.w.system.diagonal(i)[k][k] += shift * translation_scale;
          m.w.system.diagonal(i)[3 + k][3 + k] += shift * rotation_scale;
        }
      double pivot;
      Factorise(first, last, &m.w, &pivot);
      if (pivot > 0 || !descends) break;
      shift = std::max(kFirstShift, 4 * shift);
      if (shift > kLargestShift) return report;
    }
    gradient = m.w.rhs;
    Solve(&m.w);
    const CorrectionSize<double> size = MeasureCorrection(first, last, m.w);
    report.correction = std::max(size.translation / m.model.length, size.rotation);
    if (!std::isfinite(size.sum)) return report;

    double slope = 0;
    for (int i = first; i <= last; ++i)
      for (int k = 0; k < 3; ++k) {
        slope -= gradient[i][k] * m.w.rhs[i][k] + gradient[i][3 + k] * m.w.rhs[i][3 + k];
      }
    const double longest =
        std::max(size.rotation / kMaxTurn, size.translation / m.model.length / kMaxMove);
    const std::vector<Vec6<double>> direction = m.w.rhs;
    start = m.w.trial;
    double fraction = longest > 1 ? 1 / longest : 1.0;
    bool accepted = false;
    for (int halving = 0; halving < kMaxHalvings && !accepted; ++halving, fraction *= 0.5) {
      for (int i = first; i <= last; ++i) {
        const Vec6<double>& d = direction[i];
        m.w.trial[i].r = start[i].r + fraction * V3{d[0], d[1], d[2]};
        m.w.trial[i].q = Normalized(start[i].q * Exp(fraction * V3{d[3], d[4], d[5]}));
      }
      ImposeEnds(m.ends, &m.w);
      EvaluateForces(&m.w);
      const double next = energy();
      accepted = !descends || next <= current + kSufficientDecrease * fraction * slope + noise;
      if (accepted) current = next;
    }
    if (!accepted) {
      m.w.trial = start;
      EvaluateForces(&m.w);
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

  // At the clamps, what is left of the forces is what they must supply.
  if (load) AddLoad(*load, 0, false, 0.0, &m.w);
  m.TakeRest();
  m.w.node = m.w.trial;
  std::fill(m.w.rate.begin(), m.w.rate.end(), NodeRates<double>{});
  std::fill(m.w.algorithm.begin(), m.w.algorithm.end(), NodeRates<double>{});
  return report;
}

}  // namespace cosserat_cable::rod
