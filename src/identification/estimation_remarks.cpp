#include "estimation_remarks.h"

#include <cmath>

#include "cable_number.h"
#include "channel_slips.h"
#include "cosserat_cable/input/number_text.h"
#include "noise_level.h"
#include "profile.h"

namespace cosserat_cable {
namespace {

// Half widths of an interval from a profile and from the curvature that differ by more than this
// factor are told.
constexpr double kCurved = 1.5;
// A fit that leaves so many times the noise is no ground for reasons.
constexpr double kBadFit = 5.0;

}  // namespace

void Judge(const Experiment& experiment, ChannelFit* channel, std::vector<std::string>* warnings) {
  const std::string name = experiment.name + "/" + channel->column;
  const auto samples = static_cast<double>(experiment.record.t.size());
  channel->times_noise = TimesNoise(channel->rms, channel->noise);
  channel->misfit = IsMisfit(channel->rms, samples, channel->noise);
  if (channel->noise.source == NoiseLevel::Source::kUnknown) {
    warnings->push_back(
        name +
        ": the record does not tell its noise, and the set gives no `sigma`: what the fit "
        "leaves, " +
        FormatRounded(channel->rms) + ", counts as noise, whatever it is");
  } else if (channel->misfit) {
    warnings->push_back(
        name + ": the fit leaves " + FormatRounded(channel->times_noise, 2) +
        " times the noise: what is left is " + FormatRounded(channel->rms) + ", the noise " +
        (channel->sigma_given ? "that the set gives " : "") + FormatRounded(channel->noise.sd) +
        ": the simulation lacks something that the data show. The intervals take what is left for "
        "noise");
  }
}

void TakeProfile(const Profile& profile, ParameterEstimate* estimate,
                 std::vector<std::string>* warnings) {
  if (profile.value.empty()) return;
  estimate->profile = profile;
  const std::string name = "[" + estimate->unknown.name + "]";
  const auto interval =
      IntervalOf(profile, estimate->value, estimate->quantile, estimate->unknown.lower);
  if (!interval) {
    warnings->push_back(
        name + ": the profile of the likelihood does not rise far enough to both sides of " +
        FormatRounded(estimate->value) +
        ": the interval is the one from the curvature of the likelihood");
    return;
  }
  const auto ratio = [](double profile_width, double width) {
    return width > 0 ? profile_width / width : 1.0;  // none: both end at the unknown's bound
  };
  const double below = ratio(estimate->value - interval->first, estimate->value - estimate->low);
  const double above = ratio(interval->second - estimate->value, estimate->high - estimate->value);
  const auto differs = [](double x) { return x > kCurved || x < 1 / kCurved; };
  if (differs(below) || differs(above))
    warnings->push_back(
        name + ": the records do not depend on it in a straight line: the interval from the " +
        "profile of the likelihood is " + FormatRounded(below, 2) + " (below) and " +
        FormatRounded(above, 2) + " (above) times as wide as the one from the curvature; " +
        "the profile's is the one that is reported");
  estimate->low = interval->first;
  estimate->high = interval->second;
}

void NameSlips(const Unknowns& unknowns, Estimation* estimation) {
  const auto& experiments = unknowns.set().experiments;
  for (ParameterEstimate& one : estimation->parameters) {
    if (one.determined || one.unknown.kind != Unknown::Kind::kCable) continue;
    std::string slips, bad;
    for (std::size_t e = 0; e < experiments.size(); ++e) {
      if (!unknowns.Concerns(unknowns.Find(one.unknown.name), static_cast<int>(e))) continue;
      for (const ChannelSlip& slip : estimation->slips)
        if (slip.experiment == experiments[e].name)
          slips += (slips.empty() ? "" : "; ") + slip.experiment + ": " + slip.text;
      for (const ChannelFit& channel : estimation->experiments[e].channels)
        if (channel.misfit && channel.times_noise > kBadFit)
          bad = experiments[e].name + "/" + channel.column;
    }
    if (!slips.empty())
      one.reason = "the record does not fit as it is; " + slips;
    else if (!bad.empty() && !estimation->experiments.empty())
      one.reason += " (seen at a fit that does not explain " + bad + ")";
  }
}

}  // namespace cosserat_cable
