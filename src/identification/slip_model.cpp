#include "slip_model.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "cosserat_cable/fit/damage.h"

namespace cosserat_cable {
namespace {

// No finer grid is simulated than this many samples.
constexpr int kMostSamples = 6000;
// Of the record: the first part, in which a swing is not taken for the next, and the second; in
// periods of the slowest swing, samples and parts of the record at least.
constexpr double kFirstPeriods = 1.2, kSecondPeriods = 4, kFirstPart = 0.06, kSecondPart = 0.25;
constexpr Eigen::Index kFewestSamples = 40;
// How far a camera may have begun after the release: periods of the slowest swing.
constexpr double kLatePeriods = 2;
// Points of the search, and factors within which they lie around the start: what a set says of a
// stiffness may be far off.
constexpr int kPoints = 36, kPointsAtRest = 8, kBest = 3;
constexpr double kStiffnessSpread = 4.0, kDampingSpread = 6.0;
// No clock is off by more, relative.
constexpr double kMostOfRate = 0.03;
constexpr std::uint32_t kSeed = 20150113;
constexpr double kDifference = 1e-3;  // of a parameter's logarithm
constexpr double kLongestStep = 0.4;  // likewise
const double kDampings[] = {1e-4, 1e-1, 1e1};
constexpr int kFirstIterations = 6, kLaterIterations = 8;
constexpr double kSettled = 1e-4;  // gain of the cost that ends the search
// Delays that are tried in the first part: by period.
constexpr int kDelaysByPeriod = 12;

/// Cubic through the four nearest samples of an even grid; its end values hold beyond it.
void Interpolate(const Eigen::MatrixXd& values, double x, Eigen::Ref<Eigen::RowVectorXd> out) {
  const auto n = static_cast<double>(values.rows());
  const double place = std::clamp(x, 0.0, n - 1);
  const auto i = static_cast<Eigen::Index>(std::min(std::floor(place), n - 2));
  const double u = place - static_cast<double>(i);
  if (i < 1 || i + 2 >= values.rows()) {
    out = (1 - u) * values.row(i) + u * values.row(i + 1);
    return;
  }
  out = -u * (u - 1) * (u - 2) / 6 * values.row(i - 1) +
        (u + 1) * (u - 1) * (u - 2) / 2 * values.row(i) -
        (u + 1) * u * (u - 2) / 2 * values.row(i + 1) +
        (u + 1) * u * (u - 1) / 6 * values.row(i + 2);
}

bool HasAxes(Quantity quantity) {
  return quantity != Quantity::kAngle && quantity != Quantity::kRate;
}

}  // namespace

SlipModel::~SlipModel() = default;

SlipModel::SlipModel(const MeasurementSet& set, int experiment, const Eigen::VectorXd& level,
                     const Eigen::MatrixXd& usable,
                     const std::vector<std::vector<std::pair<std::string, double>>>& points,
                     const std::function<bool()>& stop, bool near)
    : experiment_(set.experiments[static_cast<std::size_t>(experiment)]),
      level_(level),
      usable_(usable) {
  const std::vector<double>& t = experiment_.record.t;
  if (t.size() < 3) return;
  MeasurementSet one = set;
  one.experiments = {experiment_};
  Experiment& shown = one.experiments.front();
  shown.channels.clear();
  const auto column_of = [&](const Channel& channel) {
    for (std::size_t k = 0; k < shown.channels.size(); ++k) {
      const Channel& other = shown.channels[k];
      if (other.quantity == channel.quantity && other.axis == channel.axis &&
          other.s == channel.s && other.clamp == channel.clamp &&
          other.in_frame_a == channel.in_frame_a)
        return static_cast<int>(k);
    }
    shown.channels.push_back(channel);
    shown.channels.back().unknown_offset = false;
    return static_cast<int>(shown.channels.size()) - 1;
  };
  for (const Channel& channel : experiment_.channels) {
    axes_.emplace_back();
    for (int axis = 0; axis < (HasAxes(channel.quantity) ? 3 : 1); ++axis) {
      Channel other = channel;
      if (HasAxes(channel.quantity)) other.axis = axis;
      axes_.back().push_back(column_of(other));
    }
  }
  shown_level_ = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(shown.channels.size()),
                                           std::numeric_limits<double>::max());
  for (std::size_t c = 0; c < axes_.size(); ++c)
    for (const int column : axes_[c])
      shown_level_[column] = std::min(shown_level_[column], level_[static_cast<Eigen::Index>(c)]);
  UnknownOptions options;
  Problems problems;
  const Specimen specimen =
      Unknowns(one, options, &problems)
          .MakeSpecimen(0, Unknowns(one, options, &problems).StartValues(), &problems);
  if (!problems.empty()) return;
  period_ = SlowestPeriod(experiment_, specimen.cable);
  const double duration = t.back() - t.front();
  const bool begins = experiment_.start.kind != StartCondition::Kind::kRest;
  if (!experiment_.quasi_static() && (begins || experiment_.a.motion || experiment_.b.motion)) {
    const double late = period_ > 0 ? kLatePeriods * period_ : kFirstPart * duration;
    earliest_ = -std::min(late, 0.5 * duration);
    latest_ = std::max(0.5 * duration,
                       duration - std::max(kFirstPeriods * period_, kFirstPart * duration));
  }
  if (experiment_.quasi_static()) {
    grid_ = t;
  } else {
    const double first = std::min(t.front(), experiment_.start_time());
    const double last = t.back() - earliest_;
    const int count = std::clamp(
        static_cast<int>(std::ceil((last - first) / MedianInterval(t))) + 1, 4, kMostSamples);
    for (int i = 0; i < count; ++i) grid_.push_back(first + (last - first) * i / (count - 1));
  }
  shown.record.t = grid_;
  // What the record shows there says how fine the steps have to be.
  shown.record.values.resize(static_cast<Eigen::Index>(grid_.size()),
                             static_cast<Eigen::Index>(shown.channels.size()));
  for (std::size_t c = 0; c < axes_.size(); ++c)
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      const auto after = std::upper_bound(t.begin(), t.end(), grid_[i]) - t.begin();
      const double value = experiment_.record.values(std::max<Eigen::Index>(after - 1, 0),
                                                     static_cast<Eigen::Index>(c));
      for (const int column : axes_[c])
        shown.record.values(static_cast<Eigen::Index>(i), column) = value;
    }
  unknowns_ = std::make_unique<Unknowns>(one, options, &problems);
  if (!problems.empty()) return;
  model_ = std::make_unique<RecordModel>(*unknowns_);
  model_->SetStop(stop);
  for (int i = 0; i < unknowns_->size(); ++i)
    if (unknowns_->all()[static_cast<std::size_t>(i)].kind == Unknown::Kind::kCable &&
        unknowns_->Concerns(i, 0))
      free_.push_back(i);

  const auto part = [&](double periods, double share) {
    Part result;
    const double until = t.front() + std::max(periods * period_, share * duration);
    result.rows = std::max<Eigen::Index>(kFewestSamples,
                                         std::upper_bound(t.begin(), t.end(), until) - t.begin());
    result.rows = std::min<Eigen::Index>(result.rows, static_cast<Eigen::Index>(t.size()));
    if (experiment_.quasi_static()) result.rows = static_cast<Eigen::Index>(t.size());
    result.until = t[static_cast<std::size_t>(result.rows - 1)] - earliest_;
    return result;
  };
  first_ = part(kFirstPeriods, kFirstPart);
  second_ = part(kSecondPeriods, kSecondPart);
  whole_ = part(0, 1);

  if (!near || points.empty()) points_.push_back(Logarithms({}));
  for (const auto& named : points) points_.push_back(Logarithms(named));
  // A Latin hypercube: every unknown takes each of its levels once, the first in order.
  std::mt19937 random(kSeed);
  const std::size_t given = points_.size();
  // No swing is taken for another one where nothing swings.
  const std::size_t count = near ? 0 : experiment_.quasi_static() ? kPointsAtRest : kPoints;
  points_.resize(given + count, points_.front());
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const Unknown& u = unknowns_->all()[static_cast<std::size_t>(free_[k])];
    const double spread = u.damping && !u.start_known ? kDampingSpread : kStiffnessSpread;
    std::vector<std::size_t> order(count);
    for (std::size_t p = 0; p < count; ++p) order[p] = p;
    for (std::size_t p = count; p-- > 1 && k > 0;)
      std::swap(order[p], order[random() % static_cast<std::uint32_t>(p + 1)]);
    for (std::size_t p = 0; p < count; ++p)
      points_[given + p][static_cast<Eigen::Index>(k)] +=
          (2 * (static_cast<double>(order[p]) + 0.5) / static_cast<double>(count) - 1) *
          std::log(spread);
  }
  looked_ = Simulate(points_, first_.until);
  ok_ = std::any_of(looked_.begin(), looked_.end(),
                    [](const Eigen::MatrixXd& one) { return one.size() > 0; });
}

int SlipModel::ColumnOf(int channel, int axis) const {
  const std::vector<int>& axes = axes_[static_cast<std::size_t>(channel)];
  return axes.size() == 3 ? axes[static_cast<std::size_t>(axis)] : -1;
}

RecordForm SlipModel::Plain() const {
  RecordForm form;
  for (std::size_t c = 0; c < experiment_.channels.size(); ++c) {
    const Channel& channel = experiment_.channels[c];
    ChannelForm one;
    one.shows =
        axes_[c].size() == 3 ? axes_[c][static_cast<std::size_t>(channel.axis)] : axes_[c].front();
    one.free_constant = channel.unknown_offset;
    form.channels.push_back(one);
  }
  return form;
}

/// The parameters' start with these in their place.
Eigen::VectorXd SlipModel::Logarithms(
    const std::vector<std::pair<std::string, double>>& named) const {
  Eigen::VectorXd values = unknowns_->StartValues();
  for (const auto& [name, value] : named)
    if (const int i = unknowns_->Find(name); i >= 0 && std::isfinite(value)) values[i] = value;
  Eigen::VectorXd at(static_cast<Eigen::Index>(free_.size()));
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const Unknown& u = unknowns_->all()[static_cast<std::size_t>(free_[k])];
    at[static_cast<Eigen::Index>(k)] =
        std::log(std::clamp(values[free_[k]], std::max(u.lower, 1e-6 * u.scale), u.upper));
  }
  return at;
}

FormFit SlipModel::At(const std::vector<std::pair<std::string, double>>& values) const {
  FormFit fit;
  fit.ok = true;
  fit.at = Logarithms(values);
  fit.form = Plain();
  return Judge(fit);
}

Eigen::VectorXd SlipModel::AllOf(const Eigen::VectorXd& at) const {
  Eigen::VectorXd all = unknowns_->StartValues();
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const Unknown& u = unknowns_->all()[static_cast<std::size_t>(free_[k])];
    all[free_[k]] = std::clamp(std::exp(at[static_cast<Eigen::Index>(k)]), u.lower, u.upper);
  }
  return all;
}

bool SlipModel::Refine(const FormFit& fit) const {
  if (!fit.ok) return false;
  model_->Refine(AllOf(fit.at), {shown_level_});
  return !model_->Stopping();
}

/// Empty where a simulation fails.
std::vector<Eigen::MatrixXd> SlipModel::Simulate(const std::vector<Eigen::VectorXd>& at,
                                                 double until) const {
  std::vector<Eigen::VectorXd> values;
  for (const Eigen::VectorXd& one : at) values.push_back(AllOf(one));
  std::vector<Eigen::MatrixXd> records;
  for (RecordModel::Simulated& one : model_->Simulate(values, {std::min(until, grid_.back())}))
    records.push_back(one.ok ? std::move(one.records.front()) : Eigen::MatrixXd());
  return records;
}

/// What the channels show, before factor and constant: at the record's samples that are reached.
Eigen::MatrixXd SlipModel::Predict(const Eigen::MatrixXd& simulated, const RecordForm& form) const {
  const std::vector<double>& t = experiment_.record.t;
  const auto at_record = [&](double delay) -> Eigen::MatrixXd {
    if (experiment_.quasi_static()) return simulated;
    Eigen::MatrixXd all(static_cast<Eigen::Index>(t.size()), simulated.cols());
    const double interval = grid_[1] - grid_[0];
    Eigen::RowVectorXd row(simulated.cols());
    for (std::size_t i = 0; i < t.size(); ++i) {
      const double since = (t[i] - delay - grid_.front()) / (1 + form.rate);
      Interpolate(simulated, since / interval, row);
      all.row(static_cast<Eigen::Index>(i)) = row;
    }
    return all;
  };
  const Eigen::MatrixXd all = at_record(form.delayed < 0 ? form.delay : 0);
  Eigen::MatrixXd shown(all.rows(), static_cast<Eigen::Index>(form.channels.size()));
  for (std::size_t c = 0; c < form.channels.size(); ++c)
    shown.col(static_cast<Eigen::Index>(c)) = all.col(form.channels[c].shows);
  if (form.delayed >= 0)
    shown.col(form.delayed) =
        at_record(form.delay).col(form.channels[static_cast<std::size_t>(form.delayed)].shows);
  return shown;
}

std::optional<double> SlipModel::ValueOf(const std::string& name, const FormFit& fit) const {
  for (std::size_t k = 0; k < free_.size(); ++k)
    if (unknowns_->all()[static_cast<std::size_t>(free_[k])].name == name)
      return std::exp(fit.at[static_cast<Eigen::Index>(k)]);
  return std::nullopt;
}

std::vector<std::pair<std::string, double>> SlipModel::ValuesOf(const FormFit& fit) const {
  std::vector<std::pair<std::string, double>> values;
  for (std::size_t k = 0; k < free_.size(); ++k)
    values.push_back({unknowns_->all()[static_cast<std::size_t>(free_[k])].name,
                      std::exp(fit.at[static_cast<Eigen::Index>(k)])});
  return values;
}

/// What the set says of the noise may be in SI units where the channel is in others.
double SlipModel::LevelOf(Eigen::Index channel, const ChannelForm& form) const {
  const bool given = experiment_.channels[static_cast<std::size_t>(channel)].sigma.has_value();
  return level_[channel] *
         (given && !form.free_factor ? std::max(1.0, std::abs(form.factor)) : 1.0);
}

FormFit SlipModel::Measure(const Eigen::VectorXd& at, const Eigen::MatrixXd& simulated,
                           RecordForm form, const Part& part) const {
  FormFit fit;
  if (simulated.size() == 0) return fit;
  double samples = 0;
  const Eigen::MatrixXd shown = Predict(simulated, form).topRows(part.rows);
  fit.at = at;
  fit.left.resize(shown.cols());
  for (Eigen::Index c = 0; c < shown.cols(); ++c) {
    ChannelForm& channel = form.channels[static_cast<std::size_t>(c)];
    const Eigen::VectorXd weight = usable_.col(c).head(part.rows);
    const Eigen::VectorXd y = experiment_.record.values.col(c).head(part.rows);
    const Eigen::VectorXd x = shown.col(c);
    const double n = std::max(weight.sum(), 1.0);
    if (channel.free_factor) {
      const double mean_x = channel.free_constant ? weight.dot(x) / n : 0.0;
      const double mean_y = channel.free_constant ? weight.dot(y) / n : 0.0;
      const Eigen::VectorXd about = (x.array() - mean_x) * weight.array();
      const double square = about.squaredNorm();
      channel.factor = square > 0 ? about.dot((y.array() - mean_y).matrix()) / square : 1.0;
    }
    if (channel.free_constant) channel.constant = weight.dot(y - channel.factor * x) / n;
    const Eigen::VectorXd residual = (y - channel.factor * x).array() - channel.constant;
    fit.left[c] =
        residual.cwiseProduct(weight).squaredNorm() / n / std::pow(LevelOf(c, channel), 2);
    // As if each channel's noise were unknown: one that slips counts little beside the others.
    fit.cost += n * std::log(1 + fit.left[c]);
    samples += n;
  }
  fit.cost /= samples;
  fit.form = std::move(form);
  fit.ok = std::isfinite(fit.cost);
  return fit;
}

/// As long a part from a late beginning on: before it there is nothing to be seen.
SlipModel::Part SlipModel::Later(Part part, const RecordForm& form) const {
  if (!(form.delay > 0) || form.delayed >= 0) return part;
  const std::vector<double>& t = experiment_.record.t;
  const double until = t[static_cast<std::size_t>(part.rows - 1)] + form.delay;
  part.rows = std::min<Eigen::Index>(static_cast<Eigen::Index>(t.size()),
                                     std::upper_bound(t.begin(), t.end(), until) - t.begin());
  return part;
}

FormFit SlipModel::Look(const RecordForm& form) const {
  std::vector<double> delays = {form.delay};
  if (form.free_delay) {
    const double step =
        (period_ > 0 ? period_ : experiment_.record.t.back() - experiment_.record.t.front()) /
        kDelaysByPeriod;
    // One sensor beside the others is late by less than a swing.
    const double most = form.delayed < 0 ? latest_ : std::min(latest_, kDelaysByPeriod * step);
    for (double delay = std::max(earliest_, form.delayed < 0 ? earliest_ : -most); delay < most;
         delay += step)
      delays.push_back(delay);
  }
  std::vector<FormFit> found;
  for (std::size_t p = 0; p < points_.size(); ++p)
    for (const double delay : delays) {
      RecordForm moved = form;
      moved.delay = delay;
      FormFit fit = Measure(points_[p], looked_[p], moved, Later(first_, moved));
      if (fit.ok) found.push_back(std::move(fit));
    }
  std::sort(found.begin(), found.end(),
            [](const FormFit& a, const FormFit& b) { return a.cost < b.cost; });
  FormFit best;
  for (std::size_t k = 0; k < std::min<std::size_t>(kBest, found.size()); ++k) {
    const FormFit fit = Descend(found[k], first_, kFirstIterations);
    if (fit.ok && (!best.ok || fit.cost < best.cost)) best = fit;
  }
  return best;
}

FormFit SlipModel::Fit(const FormFit& from, bool whole) const {
  return from.ok ? Descend(from, whole ? whole_ : second_, kLaterIterations) : from;
}

FormFit SlipModel::With(const FormFit& fit, const RecordForm& form) const {
  FormFit changed = fit;
  changed.form = form;
  return changed;
}

FormFit SlipModel::Judge(const FormFit& fit) const {
  if (!fit.ok) return fit;
  return Measure(fit.at, Simulate({fit.at}, whole_.until).front(), fit.form, whole_);
}

/// Gauss and Newton's method, damped, with factors and constants projected out.
FormFit SlipModel::Descend(const FormFit& from, const Part& without_delay, int iterations) const {
  const Part part = Later(without_delay, from.form);
  const auto d = static_cast<Eigen::Index>(free_.size());
  const bool delay = from.form.free_delay, rate = from.form.free_rate;
  // Of the clock, by which the record's end is off by a sample.
  const double of_rate =
      (grid_[1] - grid_[0]) / (experiment_.record.t.back() - experiment_.record.t.front());
  const double until = part.until + (delay ? std::max(0.0, -from.form.delay) : 0.0);
  FormFit best;
  Eigen::MatrixXd simulated;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    const Eigen::VectorXd at = best.ok ? best.at : from.at;
    std::vector<Eigen::VectorXd> points = {at};
    for (Eigen::Index k = 0; k < d; ++k) {
      points.push_back(at);
      points.back()[k] += kDifference;
    }
    const std::vector<Eigen::MatrixXd> all = Simulate(points, until);
    if (std::any_of(all.begin(), all.end(),
                    [](const Eigen::MatrixXd& one) { return one.size() == 0; }))
      return best;
    if (!best.ok) best = Measure(at, all.front(), from.form, part);
    if (!best.ok) return best;

    const Eigen::Index rows = part.rows, channels = best.left.size();
    const Eigen::MatrixXd shown = Predict(all.front(), best.form).topRows(rows);
    std::vector<Eigen::MatrixXd> slopes;
    for (Eigen::Index k = 0; k < d; ++k)
      slopes.push_back(
          (Predict(all[static_cast<std::size_t>(k) + 1], best.form).topRows(rows) - shown) /
          kDifference);
    const double interval = grid_[1] - grid_[0];
    if (delay) {
      RecordForm later = best.form;
      later.delay += 0.5 * interval;
      RecordForm earlier = best.form;
      earlier.delay -= 0.5 * interval;
      slopes.push_back(Predict(all.front(), later).topRows(rows) -
                       Predict(all.front(), earlier).topRows(rows));
    }
    if (rate) {
      RecordForm faster = best.form;
      faster.rate += 0.5 * of_rate;
      RecordForm slower = best.form;
      slower.rate -= 0.5 * of_rate;
      slopes.push_back(Predict(all.front(), faster).topRows(rows) -
                       Predict(all.front(), slower).topRows(rows));
    }
    const auto unknowns = static_cast<Eigen::Index>(slopes.size());
    if (unknowns == 0) return best;
    Eigen::MatrixXd J(rows * channels, unknowns);
    Eigen::VectorXd r(rows * channels);
    for (Eigen::Index c = 0; c < channels; ++c) {
      const ChannelForm& form = best.form.channels[static_cast<std::size_t>(c)];
      const double weight = 1 / (LevelOf(c, form) * std::sqrt(1 + best.left[c]));
      const Eigen::VectorXd use = usable_.col(c).head(rows);
      Eigen::MatrixXd free(rows, (form.free_factor ? 1 : 0) + (form.free_constant ? 1 : 0));
      if (form.free_factor) free.col(0) = shown.col(c).cwiseProduct(use);
      if (form.free_constant) free.col(free.cols() - 1) = use;
      const Eigen::MatrixXd normal_of_free = free.transpose() * free;
      const auto rest = [&](Eigen::VectorXd v) -> Eigen::VectorXd {
        v = v.cwiseProduct(use).eval();
        if (free.cols() > 0) v -= (free * normal_of_free.ldlt().solve(free.transpose() * v)).eval();
        return weight * v;
      };
      r.segment(c * rows, rows) =
          rest(experiment_.record.values.col(c).head(rows) - form.factor * shown.col(c) -
               Eigen::VectorXd::Constant(rows, form.constant));
      for (Eigen::Index k = 0; k < unknowns; ++k)
        J.col(k).segment(c * rows, rows) =
            rest(form.factor * slopes[static_cast<std::size_t>(k)].col(c));
    }
    const Eigen::MatrixXd normal = J.transpose() * J;
    const double ridge = 1e-9 * normal.trace() + 1e-300;
    std::vector<Eigen::VectorXd> next;
    std::vector<RecordForm> forms;
    for (const double damping : kDampings) {
      Eigen::MatrixXd damped = normal;
      damped.diagonal() *= 1 + damping;
      damped.diagonal().array() += ridge;
      Eigen::VectorXd step = damped.ldlt().solve(J.transpose() * r);
      if (!step.allFinite()) return best;
      next.push_back(at + step.head(d).cwiseMax(-kLongestStep).cwiseMin(kLongestStep));
      forms.push_back(best.form);
      if (delay) {
        const double most = period_ > 0 ? 0.1 * period_ : 10 * interval;
        forms.back().delay = std::clamp(
            best.form.delay + std::clamp(step[d] * interval, -most, most), earliest_, latest_);
      }
      if (rate)
        forms.back().rate =
            std::clamp(best.form.rate + step[unknowns - 1] * of_rate, -kMostOfRate, kMostOfRate);
    }
    const std::vector<Eigen::MatrixXd> tried = Simulate(next, until);
    const double before = best.cost;
    for (std::size_t k = 0; k < next.size(); ++k) {
      const FormFit fit = Measure(next[k], tried[k], forms[k], part);
      if (fit.ok && fit.cost < best.cost) best = fit;
    }
    if (before - best.cost < kSettled) break;
  }
  return best;
}

}  // namespace cosserat_cable
