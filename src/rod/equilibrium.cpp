// Static equilibrium: Newton's method on the potential energy, made to descend by a shift of the
// Hessian where it is not positive definite, and by a line search; from afar, first of a rod that
// stretches more easily.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lane_view.h"
#include "rod_impl.h"
#include "static_ends.h"
#include "step_kernels.h"

namespace cosserat_cable::rod {
namespace {

// At each stiffness. Two of ten thousand random cables, far from rest at first, went on descending
// beyond 300, and were there after 654.
constexpr int kMaxIterations = 1000;
// As many with the tangent of a time step, which is exact where elements turn little. Who needs
// more has elements that turn far or are pressed, and gets the exact one.
constexpr int kQuickIterations = 12;
constexpr double kTolerance = 1e-10;  // of the correction, relative to the length and in rad
// Below, energies differ by less than their rounding (its square is 1e-14): the step is Newton's,
// and a correction that no longer falls is rounding too.
constexpr double kEnergyBlind = 1e-7;
constexpr double kMaxTurn = 0.4;  // rad of one node in one iteration
constexpr double kMaxMove = 0.1;  // of the length, likewise
constexpr double kSufficientDecrease = 1e-4;
constexpr double kFirstShift = 1e-3;     // in units of what one element bends with
constexpr double kPull = 5;              // the tension's part in that unit
constexpr double kSmallestShift = 1e-7;  // below, none
constexpr double kLargestShift = 1e9;
constexpr int kMaxHalvings = 30;
// Rounding of the energy, relative to the sum of its parts: differences below are noise.
constexpr double kEnergyNoise = 1e-13;
// Strains below are rounding: a rod without any load has no energy to compare with.
constexpr double kStrainNoise = 1e-10;

// Turning nodes along straight lines stretches the elements between them, by half the square of the
// turn: the stiffer the rod, the shorter Newton's steps. So the shape is found with a rod in which
// stretching costs little more than bending, which is then stiffened.
constexpr double kSoftBending = 1e3;      // C_F of that rod at least, in C_M / length^2
constexpr double kSoftWeight = 30;        // the same, in weights of the rod
constexpr double kStiffening = 10;        // from one rod to the next
constexpr double kStageTolerance = 1e-3;  // a stage need not be stable: it is only on the way
constexpr int kStageIterations = 60;

// The law at the tensions of the last round: what is left of their change is squared in the shape.
constexpr double kTensionTolerance = 1e-9;  // of the bending stiffness
constexpr int kMaxTensionRounds = 20;

}  // namespace

SolveReport Rod::Impl::Minimise(double tolerance, int max_iterations, int quick_iterations,
                                const Load* load) {
  const int first = first_free(), last = last_free();
  const double bending = std::min(w.law.C_M.x, w.law.C_M.y);

  const LaneView<double> view(&w, &ends);
  const double unstrained_noise = kStrainNoise * kStrainNoise * w.law.C_F.z * model.length;
  double noise = 0;
  const auto energy = [&] {
    const double strain = StaticEnergy(), gravity = GravityEnergy(w.trial);
    const double outside = load ? load->Energy(view) : 0.0;
    noise = kEnergyNoise * (strain + std::abs(gravity) + std::abs(outside)) + unstrained_noise;
    return strain + gravity + outside;
  };

  // Without a potential there is nothing to descend: plain Newton, its steps bounded.
  const bool descends = !load || load->HasPotential();
  SolveReport report;
  double shift = 0;
  EvaluateStatics();
  double current = energy();
  std::vector<NodeState> start;
  std::vector<Vec6<double>> gradient;  // minus the energy's
  BlockTridiagonal<double> tangent = w.system;
  while (report.iterations < max_iterations) {
    ++report.iterations;
    // What an element bends with, and what it is pulled with: where a taut one is turned by more
    // than half a radian, twisting it is in error by a part of the latter.
    double tightest = 0;
    for (int e = 0; e < model.elements; ++e)
      tightest = std::max(tightest, std::abs(w.chain.Stress(e, 0).n.z));
    const double rotation_scale = bending / h + kPull * tightest * h;  // [N m]
    const double translation_scale = rotation_scale / (h * h);         // [N/m]
    AssembleStatics(report.iterations > quick_iterations);
    if (load) AddLoad(*load, ends, true, 0.0, &w);
    ConstrainEnds(ends, memory_, &w);
    gradient = w.rhs;
    // Newton direction, with the smallest shift that makes the Hessian positive definite.
    for (tangent = w.system;; w.system = tangent) {
      for (int i = first; i <= last; ++i)
        for (int k = 0; k < 3; ++k) {
          w.system.diagonal(i)[k][k] += shift * translation_scale;
          w.system.diagonal(i)[3 + k][3 + k] += shift * rotation_scale;
        }
      double pivot;
      Factorise(first, last, &w, &pivot);
      if (pivot > 0 || !descends) break;
      shift = std::max(kFirstShift, 4 * shift);
      if (shift > kLargestShift) return report;
    }
    Solve(&w);
    const CorrectionSize<double> size = MeasureCorrection(first, last, w);
    const double last_correction =
        report.iterations > 1 ? report.correction : std::numeric_limits<double>::infinity();
    report.correction = std::max(size.translation / model.length, size.rotation);
    if (!std::isfinite(size.sum)) return report;
    // A little shift may stay: a shape that can be turned freely has a singular Hessian.
    const bool near = shift <= kFirstShift && report.correction < kEnergyBlind;
    const bool rounding =
        near && last_correction < kEnergyBlind && report.correction >= last_correction;

    double slope = 0;
    for (int i = first; i <= last; ++i)
      for (int k = 0; k < 3; ++k) {
        slope -= gradient[i][k] * w.rhs[i][k] + gradient[i][3 + k] * w.rhs[i][3 + k];
      }
    const double longest =
        std::max(size.rotation / kMaxTurn, size.translation / model.length / kMaxMove);
    const std::vector<Vec6<double>> direction = w.rhs;
    start = w.trial;
    double fraction = longest > 1 ? 1 / longest : 1.0;
    bool accepted = false;
    for (int halving = 0; halving < kMaxHalvings && !accepted; ++halving, fraction *= 0.5) {
      for (int i = first; i <= last; ++i) {
        const Vec6<double>& d = direction[i];
        w.trial[i].r = start[i].r + fraction * V3{d[0], d[1], d[2]};
        w.trial[i].q = Normalized(start[i].q * Exp(fraction * V3{d[3], d[4], d[5]}));
      }
      ImposeEnds(ends, &w);
      EvaluateStatics();
      const double next = energy();
      accepted =
          !descends || near || next <= current + kSufficientDecrease * fraction * slope + noise;
      if (accepted) current = next;
    }
    if (!accepted) {
      w.trial = start;
      EvaluateStatics();
      shift = std::max(kFirstShift, 4 * shift);
      if (shift > kLargestShift) return report;
      continue;
    }
    const bool stable = shift <= kFirstShift || tolerance >= kStageTolerance;
    if (rounding || (stable && report.correction < tolerance)) {
      report.converged = true;
      break;
    }
    shift = shift > kSmallestShift ? shift / 8 : 0.0;
  }
  return report;
}

void Rod::Impl::BeginStatics(EndPart::Memory memory) {
  MoveOut();
  memory_ = has_history_ ? memory : EndPart::Memory::kRested;
  for (NodeState& n : w.node) n.v = n.omega = V3{};
  for (EndPart* end : {&ends.a, &ends.b}) end->Start(Motion::Resting(end->clamp().X));
  w.trial = w.node;
  ImposeEnds(ends, &w);
  PrepareStatics();
  if (memory_ == EndPart::Memory::kRested) laws.Reset();
}

void Rod::Impl::Soften(const Load* load, SolveReport* report) {
  const double length = model.length;
  const V3 C_F = w.law.C_F, C_M = w.law.C_M;
  const double weight = model.section.rhoA * length * std::sqrt(Dot(w.gravity, w.gravity));
  const std::vector<NodeState> from = w.trial;
  std::fill(tension.begin(), tension.end(), 0.0);
  StiffenElements();
  bool converged = true;
  for (double soft = std::max(kSoftBending * std::max(C_M.x, C_M.y) / (length * length),
                              kSoftWeight * weight);
       soft < C_F.z && converged; soft *= kStiffening) {
    w.law.C_F = {std::min(C_F.x, soft), std::min(C_F.y, soft), soft};
    const SolveReport stage = Minimise(kStageTolerance, kStageIterations, kQuickIterations, load);
    report->iterations += stage.iterations;
    converged = stage.converged;
    if (converged) UpdateTensions();
  }
  // Without bending stiffness worth the name, the soft rod's tension bends the stiffer one zigzag.
  if (!converged) {
    w.trial = from;
    std::fill(tension.begin(), tension.end(), 0.0);
    StiffenElements();
  }
  w.law.C_F = C_F;
}

void Rod::Impl::FinishStatics(const Load* load, SolveReport* report) {
  int iterations = report->iterations, quick = kQuickIterations;
  for (int round = 0; round < kMaxTensionRounds; ++round) {
    *report = Minimise(kTolerance, kMaxIterations, quick, load);
    if (report->iterations > quick) quick = 0;
    report->iterations = iterations += report->iterations;
    if (!report->converged) return;
    if (UpdateTensions() < kTensionTolerance) break;
  }
  // At the clamps, what is left of the forces is what they must supply.
  if (load) AddLoad(*load, ends, false, 0.0, &w);
  TakeRest();
  w.node = w.trial;
  for (auto* rates : {&w.rate, &w.algorithm, &w.mean})
    std::fill(rates->begin(), rates->end(), NodeRates<double>{});
  w.persistence = {};
}

SolveReport Rod::Impl::FindRest(EndPart::Memory memory, bool from_afar, const Load* given) {
  const Load* load = ActingAtRest(given);
  SolveReport report;
  SectionLaws before = laws;
  BeginStatics(memory);
  if (from_afar) Soften(load, &report);
  FinishStatics(load, &report);
  if (!report.converged) laws = std::move(before);
  return report;
}

SolveReport Rod::Equilibrate(const Load* load) {
  return impl_->FindRest(EndPart::Memory::kRested, true, load);
}

SolveReport Rod::EquilibrateNearby(const Load* load) {
  return impl_->FindRest(EndPart::Memory::kRested, false, load);
}

SolveReport Rod::EquilibrateWithHistory(const Load* load) {
  return impl_->FindRest(EndPart::Memory::kKept, true, load);
}

}  // namespace cosserat_cable::rod
