#include "cosserat_cable/identification/direct_evaluation.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>
#include <vector>

#include "cosserat_cable/cable/parameters.h"
#include "cosserat_cable/identification/ring_down.h"
#include "cosserat_cable/input/number_text.h"
#include "direct_biases.h"
#include "weighted_line.h"

namespace cosserat_cable {
namespace {

constexpr double kPi = 3.14159265358979323846;
// Of the strongest mode's root mean square: what a first mode has at least, where it was excited.
constexpr double kFirstModeShows = 0.05;
// Cosine of the angle to the tangent from which on a channel looks along the cable.
constexpr double kAlong = 0.9;
// Of gravity, across the cable, from which on there is a plane in which it sags.
constexpr double kSags = 0.05;
// A fit that is farther from the direct value disagrees with it: half widths of both intervals, and
// of the value, beside the biases that are known of the rig. Of those, what is no more than an
// order of magnitude counts so many times, and the others are right within this part of themselves.
constexpr double kHalfWidths = 3, kOfValue = 0.1, kOfOrder = 3, kOfBias = 0.5;
// Relative difference within which specimens have one length.
constexpr double kSameLength = 1e-3;

bool IsFixed(const EndCondition& end) {
  const auto any = [](const std::array<bool, 3>& free) { return free[0] || free[1] || free[2]; };
  return end.kind == EndCondition::Kind::kClamp && !end.motion && !any(end.translation_free) &&
         !any(end.rotation_free);
}

bool IsRingDown(const Experiment& e) {
  return !e.quasi_static() && IsFixed(e.a) && e.load.samples.empty();
}
bool IsBending(const Experiment& e) {
  return IsRingDown(e) && e.b.kind == EndCondition::Kind::kFree;
}
bool IsTorsion(const Experiment& e) {
  return IsRingDown(e) && e.b.kind == EndCondition::Kind::kDisc && e.b.disc.inertia > 0;
}

bool IsOfTwist(const Channel& channel) {
  return channel.quantity == Quantity::kAngle || channel.quantity == Quantity::kRate;
}

// The plane in which a bending channel sees motion; "" where it looks along the cable, or at twist.
std::string PlaneOf(const Experiment& e, const Channel& channel) {
  if (IsOfTwist(channel)) return "";
  const Eigen::Vector3d tangent = e.a.pose.q * Eigen::Vector3d::UnitZ();
  Eigen::Vector3d seen = Eigen::Vector3d::Unit(channel.axis);
  if (channel.in_frame_a) seen = e.a.pose.q * seen;
  if (std::abs(seen.dot(tangent)) > kAlong) return "";
  // A moment is about what it bends around.
  if (channel.quantity == Quantity::kMoment) seen = tangent.cross(seen);
  const Eigen::Vector3d across = e.gravity_W - e.gravity_W.dot(tangent) * tangent;
  if (across.norm() <= kSags * e.gravity_W.norm()) return "across";
  return std::abs(seen.dot(across.normalized())) > std::sqrt(0.5) ? "in the plane of the sag"
                                                                  : "across the sag";
}

const RingDownMode& FirstMode(const std::vector<RingDownMode>& modes) {
  const RingDownMode* first = &modes.front();
  for (const RingDownMode& mode : modes) {
    const bool shows = mode.strength >= kFirstModeShows * modes.front().strength;
    if (shows && mode.omega < first->omega) first = &mode;
  }
  return *first;
}

// Of the tip [m], from what a channel saw of the first mode; nothing from forces and moments.
std::optional<double> TipAmplitude(const Channel& channel, const RingDownMode& mode,
                                   double length) {
  const double w = std::hypot(mode.omega, mode.delta);
  double scale = 1;
  switch (channel.quantity) {
    case Quantity::kPosition:
      break;
    case Quantity::kVelocity:
      scale = 1 / w;
      break;
    case Quantity::kAcceleration:
      scale = 1 / (w * w);
      break;
    default:
      return std::nullopt;
  }
  const double shape = CantileverShape(channel.s / length);
  if (shape < 0.1) return std::nullopt;  // too near the clamp to say
  return scale * mode.amplitude() / shape;
}

// Channels of one experiment that show the same motion.
struct Seen {
  DirectRingDown ring;
  std::vector<RingDownMode> modes;  // the first one of each channel
  std::optional<double> tip_amplitude;
};

// Of each channel that shows the motion, side by side; nothing of the others.
std::vector<std::optional<RingDownFit>> FitChannels(
    const Experiment& e, const std::function<bool(const Channel&)>& shows) {
  std::vector<std::optional<RingDownFit>> fits(e.channels.size());
  tbb::parallel_for(std::size_t{0}, fits.size(), [&](std::size_t k) {
    if (!shows(e.channels[k])) return;
    const auto column = e.record.values.col(static_cast<Eigen::Index>(k));
    fits[k] = FitRingDown(e.record.t, column, e.channels[k].sigma);
  });
  return fits;
}

void See(const Channel& channel, const RingDownFit& fit, double length, Seen* seen) {
  if (!fit.refused.empty()) {
    seen->ring.messages.push_back(channel.column + ": " + fit.refused);
    return;
  }
  const RingDownMode& mode = FirstMode(fit.modes);
  seen->modes.push_back(mode);
  seen->ring.channels.push_back(channel.column);
  for (const std::string& text : fit.messages) {
    seen->ring.messages.push_back(channel.column + ": " + text);
  }
  const std::optional<double> tip = TipAmplitude(channel, mode, length);
  if (tip) seen->tip_amplitude = std::max(*tip, seen->tip_amplitude.value_or(0));
}

// Omega and delta over the channels. Their errors are all but independent of each other.
bool Combine(Seen* seen) {
  DirectRingDown& ring = seen->ring;
  const Eigen::Index n = static_cast<Eigen::Index>(seen->modes.size());
  if (n == 0) {
    ring.refused = "no channel shows a ring-down";
    return false;
  }
  Eigen::VectorXd omega(n), omega_variance(n), delta(n), delta_variance(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const RingDownMode& mode = seen->modes[static_cast<std::size_t>(i)];
    omega[i] = mode.omega;
    delta[i] = mode.delta;
    omega_variance[i] = mode.covariance(0, 0);
    delta_variance[i] = mode.covariance(1, 1);
  }
  const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(n, 1);
  const WeightedLine omega_mean = FitWeightedLine(ones, omega, omega_variance);
  const WeightedLine delta_mean = FitWeightedLine(ones, delta, delta_variance);
  ring.omega = omega_mean.estimate[0];
  ring.omega_sd = omega_mean.sd(0);
  ring.delta = delta_mean.estimate[0];
  ring.delta_sd = delta_mean.sd(0);
  ring.undamped = std::hypot(ring.omega, ring.delta);  // (11)
  if (omega_mean.scatters) {
    ring.messages.push_back("its channels differ in frequency by " +
                            FormatRounded(100 * omega_mean.scatter / ring.omega, 2) +
                            " %, more than their noise explains");
  }
  return true;
}

// Stiffness is w^2 times this, damping 2 delta times this.
void Convert(double factor, DirectRingDown* ring) {
  ring->stiffness = ring->undamped * ring->undamped * factor;
  ring->stiffness_sd =
      2 * factor * std::hypot(ring->omega * ring->omega_sd, ring->delta * ring->delta_sd);
  ring->damping = 2 * ring->delta * factor;
  ring->damping_sd = 2 * ring->delta_sd * factor;
}

void EvaluateBending(const MeasurementSet& set, const Experiment& e, DirectEvaluation* out) {
  const Specimen specimen(set, e);
  std::map<std::string, Seen> planes;
  const auto fits = FitChannels(
      e, [&](const Channel& channel) { return specimen.length && !PlaneOf(e, channel).empty(); });
  for (std::size_t k = 0; k < fits.size(); ++k)
    if (fits[k]) See(e.channels[k], *fits[k], *specimen.length, &planes[PlaneOf(e, e.channels[k])]);
  if (planes.empty()) planes[""].ring.messages.push_back("no channel looks across the cable");
  for (auto& [plane, seen] : planes) {
    DirectRingDown& ring = seen.ring;
    ring.experiment = e.name;
    ring.plane = plane;
    ring.length = specimen.length.value_or(0);
    if (!specimen.length || !specimen.mass_per_length) {
      ring.refused = "length or mass_per_length is not known";
    } else if (Combine(&seen)) {
      const double L = *specimen.length;
      Convert(*specimen.mass_per_length * std::pow(L / kFirstRoot, 4), &ring);
      AddBendingBiases(specimen, e, seen.tip_amplitude, &ring);
    }
    out->bending.push_back(ring);
  }
}

void EvaluateTorsion(const MeasurementSet& set, const Experiment& e, DirectEvaluation* out) {
  const Specimen specimen(set, e);
  Seen seen;
  seen.ring.experiment = e.name;
  seen.ring.inertia = e.b.disc.inertia;
  seen.ring.length = specimen.length.value_or(0);
  if (!specimen.length) {
    seen.ring.refused = "length is not known";
  } else {
    const auto fits = FitChannels(e, IsOfTwist);
    for (std::size_t k = 0; k < fits.size(); ++k)
      if (fits[k]) See(e.channels[k], *fits[k], *specimen.length, &seen);
    if (Combine(&seen)) {
      Convert(*specimen.length * e.b.disc.inertia, &seen.ring);
      AddTorsionBiases(specimen, e, &seen.ring);
    }
  }
  out->torsion.push_back(seen.ring);
}

DirectValue ValueOf(const WeightedLine& line, Eigen::Index k, double unit) {
  DirectValue value;
  value.value = line.estimate[k] * unit;
  value.sd = line.sd(k) * unit;
  value.low = value.value - line.quantile * value.sd;
  value.high = value.value + line.quantile * value.sd;
  value.count = line.freedom + static_cast<int>(line.estimate.size());
  value.scatter = line.scatter * unit;
  value.scatters = line.scatters;
  return value;
}

std::vector<DirectRingDown> Used(const std::vector<DirectRingDown>& rings) {
  std::vector<DirectRingDown> used;
  for (const DirectRingDown& ring : rings) {
    if (ring.refused.empty()) used.push_back(ring);
  }
  return used;
}

DirectValue Mean(const std::vector<DirectRingDown>& rings, double DirectRingDown::*value,
                 double DirectRingDown::*sd) {
  const Eigen::Index n = static_cast<Eigen::Index>(rings.size());
  Eigen::VectorXd y(n), variance(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const DirectRingDown& ring = rings[static_cast<std::size_t>(i)];
    y[i] = ring.*value;
    variance[i] = ring.*sd * ring.*sd;
  }
  // In units of the first: nobody's numbers underflow.
  const double unit = std::abs(y[0]);
  return ValueOf(FitWeightedLine(Eigen::MatrixXd::Ones(n, 1), y / unit, variance / (unit * unit)),
                 0, unit);
}

bool OneLength(const std::vector<DirectRingDown>& rings) {
  return std::all_of(rings.begin(), rings.end(), [&](const DirectRingDown& ring) {
    return std::abs(ring.length - rings.front().length) <= kSameLength * ring.length;
  });
}

// 2 J delta = eta_GJ/L + D_E over all pendulums.
void EvaluateTorsionalDamping(const std::vector<DirectRingDown>& rings, DirectEvaluation* out) {
  const Eigen::Index n = static_cast<Eigen::Index>(rings.size());
  const bool one_length = OneLength(rings);
  Eigen::VectorXd y(n), variance(n);
  Eigen::MatrixXd X = Eigen::MatrixXd::Ones(n, one_length ? 1 : 2);
  for (Eigen::Index i = 0; i < n; ++i) {
    const DirectRingDown& ring = rings[static_cast<std::size_t>(i)];
    y[i] = ring.damping / ring.length;
    variance[i] = std::pow(ring.damping_sd / ring.length, 2);
    if (!one_length) X(i, 0) = 1 / ring.length;
  }
  const double unit = std::abs(y[0]);
  const WeightedLine line = FitWeightedLine(X, y / unit, variance / (unit * unit));
  if (!one_length) {
    out->values["eta_GJ"] = ValueOf(line, 0, unit);
    out->values[kEndDamping] = ValueOf(line, 1, unit);
    out->eta_GJ_D_E_correlation = line.covariance(0, 1) / (line.sd(0) * line.sd(1));
    return;
  }
  out->combination = ValueOf(line, 0, unit);
  out->combination_length = rings.front().length;
  const std::string why =
      "all pendulums are " + FormatRounded(rings.front().length) +
      " m long: only eta_GJ/L + D_E = " + FormatRounded(out->combination->value) + " +- " +
      FormatRounded(out->combination->sd, 2) + " N m s is determined";
  out->undetermined["eta_GJ"] = why;
  out->undetermined[kEndDamping] = why;
}

// Eq. (10).
void AddCritical(const MeasurementSet& set, DirectEvaluation* out) {
  const Specimen s(set, Experiment());
  if (!s.length || !s.mass_per_length || !s.shape) return;
  const auto found = [&](const char* name) -> std::optional<double> {
    const auto value = out->values.find(name);
    if (value == out->values.end()) return std::nullopt;
    return value->second.value;
  };
  const double rhoA = *s.mass_per_length, slowest = 4 * *s.length / kPi;
  const double gyration = std::min(s.shape->gyration1(), s.shape->gyration2());
  std::optional<double> EI = found("EI"), GJ = found("GJ"), EA = s.EA;
  if (!EI && s.EI) EI = std::min((*s.EI)[0], (*s.EI)[1]);
  if (!GJ) GJ = s.GJ;
  if (!EA && EI) EA = *EI / gyration;
  if (GJ) out->critical["eta_GJ"] = slowest * std::sqrt(rhoA * s.shape->polar() * *GJ);
  if (EA) out->critical["eta_EA"] = slowest * std::sqrt(rhoA * *EA);
  const std::optional<double> GA = s.GA ? std::optional<double>(std::min((*s.GA)[0], (*s.GA)[1]))
                                        : (EA ? std::optional<double>(*EA / 3) : std::nullopt);
  if (GA) out->critical["eta_GA"] = 2 * std::sqrt(rhoA * gyration * *GA);
}

/// Relative: by how much a direct value is too high, and how well that is known.
struct KnownBias {
  double shift = 0, doubt = 0;
};

KnownBias BiasOf(const std::vector<DirectRingDown>& rings, const std::string& name) {
  KnownBias mean;
  const auto n = static_cast<double>(rings.size());
  for (const DirectRingDown& ring : rings)
    for (const DirectBias& bias : ring.biases) {
      if (bias.of != name) continue;
      if (!bias.order_only) mean.shift += bias.relative / n;
      mean.doubt += std::abs(bias.relative) * (bias.order_only ? kOfOrder : kOfBias) / n;
    }
  return mean;
}

}  // namespace

std::string DisagreementOf(const DirectEvaluation& evaluation, const std::string& name, double low,
                           double high) {
  const auto found = evaluation.values.find(name);
  const std::vector<DirectRingDown> rings =
      Used(name == "GJ" ? evaluation.torsion : evaluation.bending);
  if (found == evaluation.values.end() || (name != "EI" && name != "GJ") || rings.empty())
    return "";
  const DirectValue& direct = found->second;
  const KnownBias bias = BiasOf(rings, name);
  if (!(direct.value > 0) || !(1 + bias.shift > 0)) return "";
  const double value = direct.value / (1 + bias.shift), fit = 0.5 * (low + high);
  const double widths = 0.5 * (direct.high - direct.low) + 0.5 * (high - low);
  if (std::abs(value - fit) <= kHalfWidths * widths + (kOfValue + bias.doubt) * value) return "";
  std::string records;
  for (const DirectRingDown& ring : rings)
    if (records.find(ring.experiment) == std::string::npos)
      records += (records.empty() ? "" : ", ") + ring.experiment;
  return "the frequency alone of " + records + " makes [" + name + "] " + FormatRounded(value, 4) +
         " N m^2 (without the biases that are known of the rig), the fit " + FormatRounded(fit, 4) +
         ": they differ by far more than both intervals. One of them has taken another swing for "
         "that of the record: look at the report, and begin nearer to the right one";
}

DirectEvaluation EvaluateDirectly(const MeasurementSet& set) {
  // Each by itself, side by side; put together in the order of the set.
  std::vector<DirectEvaluation> each(set.experiments.size());
  tbb::parallel_for(std::size_t{0}, each.size(), [&](std::size_t k) {
    const Experiment& e = set.experiments[k];
    if (IsBending(e)) EvaluateBending(set, e, &each[k]);
    if (IsTorsion(e)) EvaluateTorsion(set, e, &each[k]);
  });
  DirectEvaluation out;
  for (DirectEvaluation& one : each) {
    const auto append = [](auto& to, auto& from) {
      to.insert(to.end(), std::make_move_iterator(from.begin()),
                std::make_move_iterator(from.end()));
    };
    append(out.bending, one.bending);
    append(out.torsion, one.torsion);
    append(out.messages, one.messages);
  }
  const std::vector<DirectRingDown> bending = Used(out.bending), torsion = Used(out.torsion);
  if (!bending.empty()) {
    out.values["EI"] = Mean(bending, &DirectRingDown::stiffness, &DirectRingDown::stiffness_sd);
    out.values["eta_EI"] = Mean(bending, &DirectRingDown::damping, &DirectRingDown::damping_sd);
  } else if (!out.bending.empty()) {
    out.undetermined["EI"] = out.undetermined["eta_EI"] = "no bending ring-down could be evaluated";
  }
  if (!torsion.empty()) {
    out.values["GJ"] = Mean(torsion, &DirectRingDown::stiffness, &DirectRingDown::stiffness_sd);
    EvaluateTorsionalDamping(torsion, &out);
  } else if (!out.torsion.empty()) {
    out.undetermined["GJ"] = out.undetermined["eta_GJ"] = out.undetermined[kEndDamping] =
        "no torsional pendulum could be evaluated";
  }
  AddCritical(set, &out);
  return out;
}

}  // namespace cosserat_cable
