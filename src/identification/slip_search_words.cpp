// What was found for a record, in words.
#include <algorithm>
#include <cmath>

#include "cosserat_cable/cable/parameters.h"
#include "cosserat_cable/input/number_text.h"
#include "slip_search.h"
#include "slip_units.h"

namespace cosserat_cable {

ChannelSlip SlipSearch::OfChannel(std::size_t c, const FormFit& fit) const {
  const Channel& channel = experiment_.channels[c];
  const RecordForm plain = model_.Plain();
  const ChannelForm& form = fit.form.channels[c];
  ChannelSlip slip;
  slip.column = channel.column;
  slip.factor = form.factor;
  slip.constant = plain.channels[c].free_constant ? 0.0 : form.constant;
  std::string text;
  const auto also = [&](const std::string& more) {
    text += (text.empty() ? " fits " : ", ") + more;
  };
  if (form.shows != plain.channels[c].shows) {
    slip.kind = "axis";
    for (std::size_t other = 0; other < experiment_.channels.size(); ++other)
      if (other != c && plain.channels[other].shows == form.shows &&
          fit.form.channels[other].shows == plain.channels[c].shows) {
        slip.kind = "swapped";
        slip.shows = experiment_.channels[other].column;
        text = " is " + slip.shows + " (swapped?)";
      }
    if (slip.kind == "axis") {
      for (int axis = 0; axis < 3; ++axis)
        if (model_.ColumnOf(static_cast<int>(c), axis) == form.shows) slip.shows = "xyz"[axis];
      also("as axis " + slip.shows);
    }
  }
  const auto kind = [&](const char* name) {
    if (slip.kind.empty()) slip.kind = name;
  };
  if (form.factor != 1) {
    const char* unit = nullptr;
    for (const Unit& one : UnitsOf(channel.quantity))
      if (std::abs(std::abs(form.factor) / one.factor - 1) < 1e-9) unit = one.name;
    if (form.factor == -1) {
      kind("sign");
      also("with its sign turned");
    } else if (unit) {
      kind("unit");
      also(std::string("as ") + unit + " (factor " + FormatRounded(1 / form.factor, 4) + ")");
    } else {
      kind("gain");
      also("with a factor of " + FormatRounded(form.factor, 3) + " (gain?)");
    }
  }
  if (slip.constant != 0) {
    kind("offset");
    also("with a constant of " + WithUnit(channel.quantity, slip.constant) +
         ": `offset: unknown`?");
    constexpr double kNearGravity = 0.05;
    const double g = experiment_.gravity_W.norm();
    if (channel.quantity == Quantity::kAcceleration && g > 0 &&
        std::abs(std::abs(slip.constant) / g - 1) < kNearGravity)
      text += " Gravity seems to be in it";
  }
  slip.text = slip.kind.empty() ? "" : channel.column + text;
  return slip;
}

ChannelSlip SlipSearch::OfClock(const FormFit& fit) const {
  ChannelSlip slip;
  if (fit.form.free_rate) {
    slip.kind = "clock";
    slip.factor = 1 + fit.form.rate;
    slip.text = "fits with a clock that is " + FormatRounded(100 * std::abs(fit.form.rate), 2) +
                " % " + (fit.form.rate > 0 ? "fast" : "slow") +
                ": `faults.clock.scale` in `uncertain`?";
    return slip;
  }
  slip.delay = fit.form.delay;
  slip.kind = "delay";
  if (fit.form.delayed >= 0) {
    slip.column = experiment_.channels[static_cast<std::size_t>(fit.form.delayed)].column;
    slip.text = slip.column + " fits with times that are " + Seconds(std::abs(slip.delay)) +
                (slip.delay > 0 ? " late" : " early") + " beside the other channels";
    return slip;
  }
  const bool driven = experiment_.a.motion || experiment_.b.motion;
  if (driven) {
    slip.text = "fits with times that are " + Seconds(std::abs(slip.delay)) +
                (slip.delay > 0 ? " late" : " early") + " beside the clamps' motion";
  } else if (slip.delay > 0) {
    slip.kind = "start";
    slip.text =
        "still until " + Seconds(experiment_.record.t.front() + slip.delay) + ": let go there?";
  } else {
    slip.kind = "start";
    slip.text = "swings already for " + Seconds(-slip.delay) +
                " when the record begins: `start: {unknown: true}`?";
  }
  return slip;
}

ChannelSlip SlipSearch::OfInput(const Found& found) const {
  const InputSlip& input = *found.input;
  ChannelSlip slip;
  slip.kind = input.kind;
  slip.factor = found.factor;
  slip.text = "fits " +
              (input.free_factor() ? "with " + FormatRounded(found.factor, 3) + " " : "") +
              input.text;
  if (!input.named.empty()) {
    const double given = GetParameter(input.named, SpecimenKeys(set_, experiment_)).value_or(0);
    slip.factor = given > 0 ? found.fit.named / given : 1.0;
    slip.text = "fits with [" + input.named + "] = " + FormatRounded(found.fit.named) +
                " instead of the set's " + FormatRounded(given) + ": name it in `uncertain`?";
  }
  return slip;
}

std::vector<ChannelSlip> SlipSearch::Words(const Found& found,
                                           const std::vector<const Found*>& others) const {
  std::vector<ChannelSlip> slips;
  const FormFit& fit = found.fit;
  if (found.input) {
    slips.push_back(OfInput(found));
  } else {
    if (fit.form.free_delay || fit.form.free_rate) slips.push_back(OfClock(fit));
    for (std::size_t c = 0; c < experiment_.channels.size(); ++c) {
      const ChannelSlip slip = OfChannel(c, fit);
      if (!slip.kind.empty()) slips.push_back(slip);
    }
  }
  std::string as_well;
  for (const Found* other : others)
    if (const std::vector<ChannelSlip> words = Words(*other, {}); !words.empty())
      as_well += (as_well.empty() ? "" : "; ") + words.front().text;
  if (!as_well.empty() && !slips.empty()) slips.front().text += " (as well: " + as_well + ")";
  for (ChannelSlip& slip : slips) {
    slip.experiment = experiment_.name;
    slip.values = found.values;
    slip.of_record = !found.input;
    slip.of_set = found.input && found.input->of_set;
    double before = before_.mean(), after = fit.mean();
    for (std::size_t c = 0; c < experiment_.channels.size(); ++c)
      if (experiment_.channels[c].column == slip.column) {
        before = before_[static_cast<Eigen::Index>(c)];
        after = fit.left[static_cast<Eigen::Index>(c)];
      }
    slip.before = std::sqrt(before);
    slip.after = std::sqrt(after);
  }
  return slips;
}

}  // namespace cosserat_cable
