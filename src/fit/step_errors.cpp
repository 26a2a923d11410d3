#include "cosserat_cable/fit/step_errors.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "cosserat_cable/fit/fit.h"

namespace cosserat_cable {
namespace {

// What the simulation's remaining error may move any unknown by, in its standard deviations.
constexpr double kMostShift = 0.2;
// Squared norm of a derivative, by an unknown's scale, that shows nothing of it; and what keeps
// directions that the records do not show from passing for some that they do.
constexpr double kUnshown = 1e-3, kRidge = 1e-10;

}  // namespace

/// An error moves no unknown by more, in its standard deviations, than the part of the error that
/// lies in the derivatives' space is long.
bool SharpenWhereItMoves(const RecordJacobian& jacobian, const NoiseLevels& noise,
                         RecordModel* model) {
  // The part of an error e in the derivatives' space: |R^-T J^T e|, with R^T R = J^T J.
  const Eigen::MatrixXd gram = jacobian.Gram();
  const Eigen::VectorXd unit =
      gram.diagonal().unaryExpr([](double x) { return x > kUnshown ? 1 / std::sqrt(x) : 0.0; });
  Eigen::MatrixXd normal = unit.asDiagonal() * gram * unit.asDiagonal();
  normal.diagonal().array() += kRidge;
  const Eigen::LLT<Eigen::MatrixXd> factor(normal);
  bool sharper = false;
  for (std::size_t e = 0; e < jacobian.records().size(); ++e) {
    const Eigen::MatrixXd error = model->error()[e].cwiseProduct(SampleWeights(*model, e, noise));
    const Eigen::Map<const Eigen::VectorXd> column(error.data(), error.size());
    const RecordJacobian::Record& record = jacobian.records()[e];
    const Eigen::VectorXd part = record.columns.transpose() * column;
    Eigen::VectorXd all = Eigen::VectorXd::Zero(gram.rows());
    for (std::size_t k = 0; k < record.unknowns.size(); ++k)
      all[record.unknowns[k]] = unit[record.unknowns[k]] * part[static_cast<Eigen::Index>(k)];
    const double shift = factor.matrixL().solve(all).norm();
    if (shift > kMostShift) sharper |= model->Sharpen(static_cast<int>(e));
  }
  return sharper;
}

}  // namespace cosserat_cable
