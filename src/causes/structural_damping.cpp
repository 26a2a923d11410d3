// `structural_damping`: a loss factor that does not depend on frequency, in bending and torsion.
#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "cosserat_cable/causes/cause.h"
#include "cosserat_cable/rod/maxwell.h"

namespace cosserat_cable {
namespace {

// A constant E''/E' over a band asks for a continuous spectrum of relaxation times; branches about
// a factor of 3.7 apart make one with a ripple of 1 % or so (test/cable/section_causes_test.cpp).
// The first and last stand so far outside of the band that their weights can make up for those that
// are not there. The band begins far below what oscillates: a cable that was held creeps back for
// as long as such losses last.
constexpr int kBranches = 9;
constexpr double kLowest = 0.02, kHighest = 100;   // of the band [Hz]
constexpr double kSlowest = 0.01, kFastest = 350;  // corner frequencies of the branches [Hz]
constexpr int kSamples = 80;                       // of the band, even in the logarithm
constexpr int kRounds = 8;                         // until the weights' error is relative

double Spread(double from, double to, int i, int count) {
  return from * std::pow(to / from, static_cast<double>(i) / (count - 1));
}

/// The branches' stiffnesses in units of the static one: E'' - loss_factor E', which is linear in
/// them, least in the mean square over the band, relative to E'.
Eigen::VectorXd BranchStiffnesses(double loss_factor) {
  Eigen::MatrixXd storage(kSamples, kBranches), loss(kSamples, kBranches);
  for (int i = 0; i < kSamples; ++i)
    for (int j = 0; j < kBranches; ++j) {
      const double x =
          Spread(kLowest, kHighest, i, kSamples) / Spread(kSlowest, kFastest, j, kBranches);
      storage(i, j) = x * x / (1 + x * x);
      loss(i, j) = x / (1 + x * x);
    }
  Eigen::VectorXd g = Eigen::VectorXd::Zero(kBranches);
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::VectorXd weight = (1 + (storage * g).array()).inverse();
    const Eigen::MatrixXd a = weight.asDiagonal() * (loss - loss_factor * storage);
    g = a.householderQr().solve(loss_factor * weight);
  }
  return g;
}

void Enter(const CableExtension& extension, rod::RodModel* rod) {
  const double loss_factor = extension.parts.front().at("loss_factor");
  if (loss_factor == 0) return;
  const Eigen::VectorXd g = BranchStiffnesses(loss_factor);
  for (int j = 0; j < kBranches; ++j) {
    rod::SectionValue stiffness;
    stiffness.M = g[j] * rod->section.C_M;
    const double tau = 1 / (2 * M_PI * Spread(kSlowest, kFastest, j, kBranches));
    rod->branches.push_back(std::make_shared<rod::MaxwellBranch>(stiffness, tau));
  }
}

}  // namespace

Cause StructuralDampingCause() {
  Cause cause;
  ExtensionLaw& law = cause.law.emplace();
  law.name = "structural_damping";
  law.shape = "a loss {loss_factor: ...}";
  law.fields = {{"loss_factor", "", NumberSpec::AtLeast(0, "").AtMost(1)}};
  law.enter = Enter;
  cause.name = law.name;
  cause.words = "a loss factor that is constant over frequency";
  cause.form = 0.03;  // no more constant than that, here and elsewhere
  using Role = HypothesisNumber::Role;
  cause.hypotheses = {
      {{{{"extensions.structural_damping.loss_factor", Role::kSize, 0.1, NumberScale::kOne}}}}};
  return cause;
}

}  // namespace cosserat_cable
