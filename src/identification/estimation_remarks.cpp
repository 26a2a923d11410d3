#include "estimation_remarks.h"

#include "channel_slips.h"
#include "cosserat_cable/cable/parameters.h"
#include "cosserat_cable/fit/noise_level.h"
#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {
namespace {

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
