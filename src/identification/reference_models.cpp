#include "cosserat_cable/identification/reference_models.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "cosserat_cable/fit/noise.h"
#include "cosserat_cable/math/pose_curve.h"

namespace cosserat_cable {
namespace {

// How far back the filter looks [s], and in how many steps.
constexpr double kMemory = 0.6;
constexpr int kTaps = 13;
// A clamp's inputs: its position, and two of its axes.
constexpr int kInputs = 9;
// Of the ridge, by sample: what is tried.
constexpr double kRidges[] = {1e-6, 1e-4, 1e-2, 0.1, 1};

bool IsFiltered(const Experiment& experiment) {
  return !experiment.quasi_static() && (experiment.a.motion || experiment.b.motion);
}

/// What the filter sees of an experiment, a row per sample.
struct Inputs {
  Eigen::MatrixXd rows;  ///< the constant one, then what the clamps have done until then
  /// In the middle of the clamps [m]: positions are seen from there, wherever in the world it is.
  Eigen::MatrixXd middle;
};

Inputs InputsOf(const Experiment& experiment) {
  const std::vector<double>& t = experiment.record.t;
  const auto samples = static_cast<Eigen::Index>(t.size());
  Inputs inputs{Eigen::MatrixXd::Zero(samples, 1 + 2 * kTaps * kInputs),
                Eigen::MatrixXd::Zero(samples, 3)};
  inputs.rows.col(0).setOnes();
  std::vector<PoseCurve> curves;
  for (const EndCondition* end : {&experiment.a, &experiment.b}) {
    if (end->kind != EndCondition::Kind::kClamp) continue;
    PoseCurve curve(std::numeric_limits<double>::infinity());
    if (end->motion)
      for (std::size_t i = 0; i < end->motion->t.size(); ++i)
        curve.Append(end->motion->t[i], end->motion->poses[i]);
    else
      curve.Append(t.front(), end->pose);
    curve.Finish();
    curves.push_back(std::move(curve));
  }
  for (Eigen::Index i = 0; i < samples; ++i) {
    const double now = t[static_cast<std::size_t>(i)];
    for (PoseCurve& curve : curves)
      inputs.middle.row(i) +=
          curve.Follow(now).X.p.transpose() / static_cast<double>(curves.size());
  }
  Eigen::Index column = 1;
  for (PoseCurve& curve : curves)
    for (int tap = 0; tap < kTaps; ++tap, column += kInputs)
      for (Eigen::Index i = 0; i < samples; ++i) {
        const double then = t[static_cast<std::size_t>(i)] - kMemory * tap / (kTaps - 1);
        const Pose pose = curve.Follow(then).X;
        const Eigen::Matrix3d R = pose.q.toRotationMatrix();
        inputs.rows.row(i).segment<kInputs>(column) << pose.p.transpose() - inputs.middle.row(i),
            R.col(0).transpose(), R.col(2).transpose();
      }
  return inputs;
}

/// The samples of one column in one record.
struct Part {
  std::size_t experiment, channel;
  Eigen::MatrixXd inputs;
  Eigen::VectorXd values;
};

/// The inputs' products, which say all that least squares need. Of the Gram matrix the lower half.
struct Products {
  explicit Products(Eigen::Index columns)
      : gram(Eigen::MatrixXd::Zero(columns, columns)),
        with_values(Eigen::VectorXd::Zero(columns)) {}
  explicit Products(const Part& part) : Products(part.inputs.cols()) {
    gram.selfadjointView<Eigen::Lower>().rankUpdate(part.inputs.transpose());
    with_values.noalias() = part.inputs.transpose() * part.values;
  }

  void Add(const Products& other, double sign) {
    gram += sign * other.gram;
    with_values += sign * other.with_values;
  }
  Eigen::VectorXd Weights(double ridge) const {
    Eigen::MatrixXd damped = gram;
    damped.diagonal().tail(damped.rows() - 1).array() += ridge * gram(0, 0);
    return damped.selfadjointView<Eigen::Lower>().ldlt().solve(with_values);
  }

  Eigen::MatrixXd gram;
  Eigen::VectorXd with_values;
};

double LeftBy(const Part& part, const Eigen::VectorXd& weights) {
  return RootMeanSquare(part.values - part.inputs * weights);
}

/// About the means over all records and in units of their spread, so that one ridge serves all.
void Standardise(std::vector<Part>* parts) {
  const Eigen::Index columns = parts->front().inputs.cols();
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(columns), squares = sum;
  double count = 0;
  for (const Part& part : *parts) {
    sum += part.inputs.colwise().sum().transpose();
    count += static_cast<double>(part.inputs.rows());
  }
  const Eigen::VectorXd mean = sum / std::max(count, 1.0);
  for (const Part& part : *parts)
    squares += (part.inputs.rowwise() - mean.transpose()).colwise().squaredNorm().transpose();
  for (Part& part : *parts)
    for (Eigen::Index k = 1; k < columns; ++k) {
      const double sd = std::sqrt(squares[k] / std::max(count, 1.0));
      part.inputs.col(k).array() -= mean[k];
      if (sd > 0) part.inputs.col(k) /= sd;
    }
}

void Filter(std::vector<Part> parts, std::vector<std::vector<ReferenceResiduals>>* all) {
  Standardise(&parts);
  const Eigen::Index columns = parts.front().inputs.cols();
  Products whole(columns);
  std::vector<Products> own;
  for (const Part& part : parts) {
    own.emplace_back(part);
    whole.Add(own.back(), 1);
  }
  double best = std::numeric_limits<double>::infinity();
  for (const double ridge : kRidges) {
    const Eigen::VectorXd weights = whole.Weights(ridge);
    std::vector<double> seen, unseen;
    double squares = 0;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      seen.push_back(LeftBy(parts[k], weights));
      unseen.push_back(ReferenceResiduals::kNone);
      if (parts.size() > 1) {
        Products others = whole;
        others.Add(own[k], -1);
        unseen.back() = LeftBy(parts[k], others.Weights(ridge));
      }
      const double counts = parts.size() > 1 ? unseen.back() : seen.back();
      squares += counts * counts * static_cast<double>(parts[k].values.size());
    }
    if (!(squares < best)) continue;
    best = squares;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      ReferenceResiduals& one = (*all)[parts[k].experiment][parts[k].channel];
      one.filter = seen[k];
      one.filter_unseen = unseen[k];
    }
  }
}

}  // namespace

std::vector<std::vector<ReferenceResiduals>> FindReferenceResiduals(const MeasurementSet& set,
                                                                    const Records& usable) {
  std::vector<std::vector<ReferenceResiduals>> all;
  std::map<std::string, std::vector<Part>> by_column;
  for (std::size_t e = 0; e < set.experiments.size(); ++e) {
    const Experiment& experiment = set.experiments[e];
    all.emplace_back(experiment.channels.size(), ReferenceResiduals());
    const Inputs inputs = IsFiltered(experiment) ? InputsOf(experiment) : Inputs();
    for (std::size_t c = 0; c < experiment.channels.size(); ++c) {
      const auto column = static_cast<Eigen::Index>(c);
      std::vector<Eigen::Index> rows;
      for (Eigen::Index i = 0; i < usable[e].rows(); ++i)
        if (usable[e](i, column) > 0) rows.push_back(i);
      if (rows.empty()) continue;
      Part part{e, c, {}, Eigen::VectorXd(static_cast<Eigen::Index>(rows.size()))};
      for (std::size_t k = 0; k < rows.size(); ++k)
        part.values[static_cast<Eigen::Index>(k)] = experiment.record.values(rows[k], column);
      all[e][c].constant = RootMeanSquare((part.values.array() - part.values.mean()).matrix());
      if (inputs.rows.size() == 0) continue;
      const Channel& channel = experiment.channels[c];
      const bool in_world = channel.quantity == Quantity::kPosition && !channel.in_frame_a;
      part.inputs.resize(part.values.size(), inputs.rows.cols());
      for (std::size_t k = 0; k < rows.size(); ++k) {
        part.inputs.row(static_cast<Eigen::Index>(k)) = inputs.rows.row(rows[k]);
        if (in_world)
          part.values[static_cast<Eigen::Index>(k)] -= inputs.middle(rows[k], channel.axis);
      }
      by_column[experiment.channels[c].column].push_back(std::move(part));
    }
  }
  std::vector<std::vector<Part>*> columns;
  for (auto& [name, parts] : by_column) columns.push_back(&parts);
  tbb::parallel_for(std::size_t{0}, columns.size(),
                    [&](std::size_t k) { Filter(std::move(*columns[k]), &all); });
  return all;
}

}  // namespace cosserat_cable
