#include "refit.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace cosserat_cable {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Tried side by side, against a normal matrix of unit diagonal: from the whole step of Gauss and
// Newton to a short one down the slope.
const double kDampings[] = {0, 1e-5, 1e-3, 0.1};
const double kMoreDampings[] = {1, 10, 100, 1000};  // where none of those gains
constexpr int kMostSteps = 12;
// Of the promised gain: a step that keeps less asks for new derivatives.
constexpr double kKept = 0.5;
// Eigenvalues of the normal matrix of unit diagonal that are rounding.
constexpr double kRounding = 1e-12;
// Of the derivative by a parameter's whole size, in standard deviations of the noise: less is no
// effect. What is so small cannot be known better than to four times its size.
constexpr double kNoEffect = 0.5;

/// A quadratic model of the sum of squares around a point, over the unknowns that may move.
class LocalModel {
 public:
  LocalModel(const Unknowns& unknowns, const VectorXd& values, const MatrixXd& J,
             const VectorXd& residuals, const std::vector<bool>& held)
      : unknowns_(unknowns), values_(values) {
    const VectorXd gradient = J.transpose() * residuals;
    for (int i = 0; i < unknowns.size(); ++i) {
      const Unknown& u = unknowns.all()[static_cast<std::size_t>(i)];
      const double size = J.col(i).norm();
      const bool moves = u.kind == Unknown::Kind::kCable
                             ? size * std::max(1.0, std::abs(values[i]) / u.scale) > kNoEffect
                             : size > 0;
      const bool outwards =
          (values[i] <= u.lower && gradient[i] > 0) || (values[i] >= u.upper && gradient[i] < 0);
      if (moves && !outwards && (held.empty() || !held[static_cast<std::size_t>(i)]))
        free_.push_back(i);
    }
    const auto n = static_cast<Eigen::Index>(free_.size());
    MatrixXd columns(J.rows(), n);
    for (Eigen::Index k = 0; k < n; ++k) columns.col(k) = J.col(free_[static_cast<std::size_t>(k)]);
    size_ = columns.colwise().norm();
    columns = (columns * size_.cwiseInverse().asDiagonal()).eval();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(
        n > 0 ? MatrixXd(columns.transpose() * columns) : MatrixXd::Identity(1, 1));
    eigenvalues_ = eigen.eigenvalues().head(n);
    vectors_ = eigen.eigenvectors().topLeftCorner(n, n);
    slopes_ = vectors_.transpose() * (columns.transpose() * residuals);
  }

  double gain() const {
    double sum = 0;
    for (Eigen::Index k = 0; k < slopes_.size(); ++k)
      if (eigenvalues_[k] > kRounding) sum += slopes_[k] * slopes_[k] / eigenvalues_[k];
    return sum;
  }

  /// Where a step with this damping leads, within the unknowns' bounds.
  VectorXd Step(double damping) const {
    VectorXd along(slopes_.size());
    for (Eigen::Index k = 0; k < slopes_.size(); ++k)
      along[k] = eigenvalues_[k] > kRounding ? -slopes_[k] / (eigenvalues_[k] + damping) : 0.0;
    const VectorXd move = (vectors_ * along).cwiseQuotient(size_);
    VectorXd values = values_;
    for (std::size_t k = 0; k < free_.size(); ++k) {
      const int i = free_[k];
      const Unknown& u = unknowns_.all()[static_cast<std::size_t>(i)];
      values[i] =
          std::clamp(values[i] + move[static_cast<Eigen::Index>(k)] * u.scale, u.lower, u.upper);
    }
    return values;
  }

 private:
  const Unknowns& unknowns_;
  const VectorXd& values_;
  std::vector<int> free_;
  VectorXd size_;         // of the columns
  VectorXd eigenvalues_;  // of the normal matrix of unit columns
  MatrixXd vectors_;
  VectorXd slopes_;  // along the eigenvectors
};

/// A job on its way.
struct Walk {
  const RefitJob* job = nullptr;
  Refitted result;
  bool fresh = false;   // the derivatives are of this very point
  bool short_ = false;  // only strongly damped steps are tried
  bool done = false;
};

class Walker {
 public:
  Walker(const RecordModel& model, const NoiseLevels& noise) : model_(model), noise_(noise) {}

  std::vector<Walk> Begin(const std::vector<RefitJob>& jobs) const {
    std::vector<VectorXd> points;
    for (const RefitJob& job : jobs) points.push_back(job.values);
    const auto simulated = model_.Simulate(points, model_.WholeHorizon());
    std::vector<Walk> walks(jobs.size());
    for (std::size_t k = 0; k < jobs.size(); ++k) {
      Walk& walk = walks[k];
      walk.job = &jobs[k];
      walk.result.values = jobs[k].values;
      walk.result.ok = simulated[k].ok;
      walk.done = !simulated[k].ok;
      if (walk.done) continue;
      walk.result.residuals =
          WeightedResiduals(model_, jobs[k].values, simulated[k].records, noise_);
      walk.result.cost = walk.result.residuals.squaredNorm();
      walk.result.jacobian = jobs[k].jacobian;
      if (jobs[k].jacobian.size() == 0) Renew(&walk);
    }
    return walks;
  }

  /// One step of every walk that is not done.
  void Step(std::vector<Walk>* walks) const {
    std::vector<VectorXd> points;
    std::vector<std::size_t> whose;
    for (std::size_t k = 0; k < walks->size(); ++k) {
      Walk& walk = (*walks)[k];
      if (walk.done) continue;
      Refitted& at = walk.result;
      const LocalModel local(model_.unknowns(), at.values, at.jacobian, at.residuals,
                             walk.job->held);
      at.left = local.gain();
      walk.done = at.left < walk.job->tolerance;
      if (walk.done) continue;
      for (const double damping : walk.short_ ? kMoreDampings : kDampings) {
        points.push_back(local.Step(damping));
        whose.push_back(k);
      }
    }
    if (points.empty()) return;
    const auto simulated = model_.Simulate(points, model_.WholeHorizon());
    std::vector<Refitted> best(walks->size());
    for (std::size_t p = 0; p < points.size(); ++p) {
      if (!simulated[p].ok) continue;
      const VectorXd residuals = WeightedResiduals(model_, points[p], simulated[p].records, noise_);
      Refitted& one = best[whose[p]];
      if (one.ok && !(residuals.squaredNorm() < one.cost)) continue;
      one.ok = true;
      one.values = points[p];
      one.residuals = residuals;
      one.cost = residuals.squaredNorm();
    }
    for (std::size_t k = 0; k < walks->size(); ++k)
      if (!(*walks)[k].done) Take(best[k], &(*walks)[k]);
  }

 private:
  void Renew(Walk* walk) const {
    const auto found = model_.Differentiate(walk->result.values, model_.WholeHorizon(),
                                            RecordModel::Difference::kForward);
    walk->fresh = true;
    if (found.at.ok)
      walk->result.jacobian = WeightedJacobian(model_, found, noise_);
    else
      walk->done = true;
  }

  void Take(const Refitted& best, Walk* walk) const {
    Refitted& at = walk->result;
    const double gained = best.ok ? at.cost - best.cost : 0.0;
    const bool was_fresh = walk->fresh;
    if (gained > 0) {
      at.values = best.values;
      at.residuals = best.residuals;
      at.cost = best.cost;
      walk->fresh = false;
    }
    if (gained > walk->job->tolerance) walk->short_ = false;
    if (gained > kKept * at.left) return;
    if (was_fresh && !(gained > walk->job->tolerance)) {
      walk->done = walk->short_;
      walk->short_ = true;
    }
    if (!walk->done && !walk->fresh) Renew(walk);
  }

  const RecordModel& model_;
  const NoiseLevels& noise_;
};

}  // namespace

double PromisedGain(const RecordModel& model, const VectorXd& values, const MatrixXd& jacobian,
                    const VectorXd& residuals, const std::vector<bool>& held) {
  return LocalModel(model.unknowns(), values, jacobian, residuals, held).gain();
}

std::vector<Refitted> Refit(const RecordModel& model, const NoiseLevels& noise,
                            const std::vector<RefitJob>& jobs, const FitProgress& progress) {
  const Walker walker(model, noise);
  std::vector<Walk> walks = walker.Begin(jobs);
  bool interrupted = false;
  for (int step = 0; step < kMostSteps && !interrupted; ++step) {
    if (std::all_of(walks.begin(), walks.end(), [](const Walk& walk) { return walk.done; })) break;
    interrupted = progress && !progress("step " + std::to_string(step + 1));
    if (!interrupted) walker.Step(&walks);
  }
  std::vector<Refitted> results;
  for (Walk& walk : walks) {
    walk.result.interrupted = interrupted;
    results.push_back(std::move(walk.result));
  }
  return results;
}

}  // namespace cosserat_cable
