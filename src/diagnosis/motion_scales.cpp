#include "motion_scales.h"

#include <algorithm>
#include <cmath>

#include "cosserat_cable/cable/parameters.h"
#include "cosserat_cable/fit/damage.h"
#include "probe.h"

namespace cosserat_cable {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// The moments at the experiment's clamps, in clamp a's frame.
std::vector<Channel> ClampMoments(const Experiment& experiment) {
  std::vector<Channel> channels;
  for (const ClampSide clamp : {ClampSide::kA, ClampSide::kB}) {
    if (clamp == ClampSide::kB && experiment.b.kind != EndCondition::Kind::kClamp) continue;
    for (const int axis : {0, 1, 2}) {
      Channel channel;
      channel.column = "moment";
      channel.quantity = Quantity::kMoment;
      channel.clamp = clamp;
      channel.axis = axis;
      channel.in_frame_a = true;
      channels.push_back(channel);
    }
  }
  return channels;
}

}  // namespace

double MotionScales::Of(NumberScale scale, const std::string& path) const {
  const std::string clamp = path.find(".b.") != std::string::npos ? "b." : "a.";
  const bool twist = path.size() > 8 && path.rfind(".torsion") == path.size() - 8;
  const auto found = simpler.find(clamp + (twist ? "torsion" : "bending"));
  const double stiffness = found == simpler.end() ? 0.0 : found->second;
  switch (scale) {
    case NumberScale::kOne:
      return 1;
    case NumberScale::kTypical:
      return TypicalSize(path, keys);
    case NumberScale::kClampBending:
      return EI / length;
    case NumberScale::kClampTorsion:
      return GJ / length;
    case NumberScale::kSimplerStiffness:
      return stiffness;
    case NumberScale::kSimplerDashpot:
      return stiffness * period / (2 * kPi);
    case NumberScale::kSimplerAngle:
      return stiffness > 0 ? clamp_moment / stiffness : 0;
    case NumberScale::kClampDashpot:
      return EI / length * period / (2 * kPi);
    case NumberScale::kCurvature:
      return clamp_moment / EI;
    case NumberScale::kClampMoment:
      return clamp_moment;
    case NumberScale::kTwistMoment:
      return twist_moment;
    case NumberScale::kPeriod:
      return period;
    case NumberScale::kFrequency:
      return 1 / period;
    case NumberScale::kLength:
      return shortest;
  }
  return 1;
}

MotionScales FindMotionScales(const FitProblem& problem, const FitPoint& at) {
  const Unknowns& unknowns = problem.unknowns();
  MotionScales scales;
  scales.keys = unknowns.FilledKeys(at.values);
  scales.EI = GetParameter("EI", scales.keys).value_or(0.01);
  scales.GJ = GetParameter("GJ", scales.keys).value_or(scales.EI);
  const auto& experiments = unknowns.set().experiments;
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    Problems problems;
    const Specimen specimen = unknowns.MakeSpecimen(static_cast<int>(e), at.values, &problems);
    if (!problems.empty()) continue;
    scales.length = std::max(scales.length, specimen.cable.length);
    scales.shortest = scales.shortest > 0 ? std::min(scales.shortest, specimen.cable.length)
                                          : specimen.cable.length;
    scales.period = std::max(scales.period, SlowestPeriod(experiments[e], specimen.cable));
    const SimulatedRecord moments = Probe(experiments[e], specimen, ClampMoments(experiments[e]));
    if (!moments.ok) continue;
    // Twist is the small part of a moment across the frame; its change counts with the rest.
    const Eigen::RowVectorXd mean = moments.values.colwise().mean();
    const Eigen::MatrixXd change = moments.values.rowwise() - mean;
    for (Eigen::Index first = 0; first < change.cols(); first += 3)
      scales.clamp_moment =
          std::max(scales.clamp_moment, change.middleCols(first, 3).rowwise().norm().maxCoeff());
    scales.twist_moment = std::max(scales.twist_moment, change.col(2).cwiseAbs().maxCoeff());
  }
  if (!(scales.length > 0))
    scales.length = scales.shortest = scales.keys.length.value.value_or(1.0);
  if (!(scales.period > 0)) scales.period = 2 * kPi / BendingFrequency(scales.keys);
  if (!(scales.twist_moment > 0)) scales.twist_moment = 0.1 * scales.GJ / scales.length;
  if (!(scales.clamp_moment > 0)) scales.clamp_moment = 0.1 * scales.EI / scales.length;
  return scales;
}

}  // namespace cosserat_cable
