#include "direct_biases.h"

#include <algorithm>
#include <cmath>

#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {
namespace {

// w^2 of a hanging cantilever's first mode rises by so much times g/L: Rayleigh's quotient of the
// mode without gravity.
constexpr double kHanging = 1.571;
// Relative biases below this are not worth a line.
constexpr double kNegligible = 1e-4;

template <typename T>
std::optional<T> Either(const CableKey<T>& own, const CableKey<T>& shared) {
  return own.value ? own.value : shared.value;
}

std::string Percent(double relative) {
  const std::string sign = relative > 0 ? "+" : "";
  return sign + FormatRounded(100 * relative, 2) + " %";
}

std::string OrderPercent(double relative) { return FormatRounded(100 * relative, 2) + " %"; }

Eigen::Vector3d Tangent(const Experiment& experiment) {
  return experiment.a.pose.q * Eigen::Vector3d::UnitZ();
}

void Add(DirectBias bias, DirectRingDown* ring) {
  if (std::abs(bias.relative) > kNegligible) ring->biases.push_back(std::move(bias));
}

}  // namespace

Specimen::Specimen(const MeasurementSet& set, const Experiment& experiment) {
  const CableKeys& own = experiment.specimen;
  length = Either(own.length, set.cable.length);
  shape = ShapeOf(own);
  if (!shape) shape = ShapeOf(set.cable);
  mass_per_length = Either(own.mass_per_length, set.cable.mass_per_length);
  GJ = Either(own.GJ, set.cable.GJ);
  EA = Either(own.EA, set.cable.EA);
  EI = Either(own.EI, set.cable.EI);
  GA = Either(own.GA, set.cable.GA);
  const auto given = Either(own.masses, set.cable.masses);
  if (given) {
    for (const LumpedMassKey& key : *given) masses.push_back(key.mass);
  }
}

double CantileverShape(double x) {
  const auto shape = [](double z) {
    const double ratio = (std::cosh(kFirstRoot) + std::cos(kFirstRoot)) /
                         (std::sinh(kFirstRoot) + std::sin(kFirstRoot));
    return std::cosh(z) - std::cos(z) - ratio * (std::sinh(z) - std::sin(z));
  };
  return shape(kFirstRoot * x) / shape(kFirstRoot);
}

void AddBendingBiases(const Specimen& specimen, const Experiment& experiment,
                      std::optional<double> tip_amplitude, DirectRingDown* ring) {
  const double L = *specimen.length, rhoA = *specimen.mass_per_length;
  const double square = ring->undamped * ring->undamped;
  const Eigen::Vector3d tangent = Tangent(experiment);
  const double along = experiment.gravity_W.dot(tangent);
  const double gained = kHanging * along / L;
  const std::string way = along > 0 ? "hangs: gravity stiffens it" : "stands: gravity softens it";
  if (square > gained) {
    const double relative = square / (square - gained) - 1;
    Add({"gravity", "EI", relative, false, "the cable " + way + ", [EI] " + Percent(relative)},
        ring);
  } else {
    Add({"gravity", "EI", 1, true, "gravity alone explains the frequency: a pendulum, not a beam"},
        ring);
  }
  const double across = (experiment.gravity_W - along * tangent).norm();
  // Of a cantilever under its own weight.
  const double sag = rhoA * across * std::pow(L, 4) / (8 * ring->stiffness);
  Add({"sag", "EI", std::pow(sag / L, 2), true,
       "the tip sags by " + FormatRounded(sag / L, 2) + " of the length: of the order of " +
           OrderPercent(std::pow(sag / L, 2)) + " of [EI]"},
      ring);
  if (tip_amplitude) {
    const double a = *tip_amplitude / L;
    Add({"large_amplitude", "EI", a * a, true,
         "the tip swings by " + FormatRounded(a, 2) + " of the length at first: of the order of " +
             OrderPercent(a * a) + " of [EI]"},
        ring);
  }
  double added = 0;  // over the mode's own mass, rhoA L/4 at the tip
  for (const LumpedMass& mass : specimen.masses) {
    added += mass.mass * std::pow(CantileverShape(mass.s / L), 2) / (rhoA * L / 4);
  }
  const double relative = 1 / (1 + added) - 1;
  Add({"masses", "EI", relative, false,
       "lumped masses slow it down, [EI] and [eta_EI] " + Percent(relative)},
      ring);
}

void AddTorsionBiases(const Specimen& specimen, const Experiment& experiment,
                      DirectRingDown* ring) {
  const double L = *specimen.length;
  if (!specimen.shape) return;
  const double polar = specimen.shape->polar();
  if (specimen.mass_per_length) {
    const double own = *specimen.mass_per_length * polar * L / 3;
    const double relative = 1 / (1 + own / ring->inertia) - 1;
    Add({"cable_inertia", "GJ", relative, false,
         "the cable turns with the disc, which (12) and (13) leave out: [GJ] and the damping " +
             Percent(relative)},
        ring);
  }
  const double tension = experiment.b.disc.mass * experiment.gravity_W.dot(Tangent(experiment));
  const double relative = tension * polar / ring->stiffness;
  Add({"disc_weight", "GJ", relative, false,
       "the disc's weight pulls twisted fibres straight, in a solid section [GJ] " +
           Percent(relative)},
      ring);
}

}  // namespace cosserat_cable
