#include "column_span.h"

#include <utility>

namespace cosserat_cable {
namespace {

// Reciprocal condition of the Gram matrix from which on its solutions, with one correction, are as
// good as those of a QR decomposition.
constexpr double kWellConditioned = 1e-10;

}  // namespace

ColumnSpan::ColumnSpan(Eigen::MatrixXd columns)
    : columns_(std::move(columns)), scale_(columns_.colwise().norm().cwiseInverse()) {
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(columns_.cols(), columns_.cols());
  gram.selfadjointView<Eigen::Lower>().rankUpdate(columns_.transpose());
  gram_.compute(scale_.asDiagonal() * gram * scale_.asDiagonal());
  if (gram_.info() != Eigen::Success || !(gram_.rcond() > kWellConditioned)) qr_.emplace(columns_);
}

Eigen::MatrixXd ColumnSpan::Coefficients(const Eigen::MatrixXd& m) const {
  return scale_.asDiagonal() * gram_.solve(scale_.asDiagonal() * (columns_.transpose() * m).eval());
}

Eigen::VectorXd ColumnSpan::Solve(const Eigen::VectorXd& y) const {
  if (qr_) return qr_->solve(y);
  const Eigen::VectorXd found = Coefficients(y);
  return found + Coefficients(y - columns_ * found);
}

void ColumnSpan::Leave(Eigen::Ref<Eigen::MatrixXd> m) const {
  if (!qr_) {
    // The second time takes what the first one leaves for the condition's sake.
    for (int time = 0; time < 2; ++time) m -= columns_ * Coefficients(m);
    return;
  }
  Eigen::MatrixXd rotated = qr_->householderQ().adjoint() * m;
  rotated.topRows(columns_.cols()).setZero();
  m = qr_->householderQ() * rotated;
}

double ColumnSpan::LogDeterminantOfGram() const {
  if (qr_) return 2 * qr_->matrixQR().diagonal().cwiseAbs().array().log().sum();
  return 2 * (gram_.matrixLLT().diagonal().array() / scale_.array()).log().sum();
}

}  // namespace cosserat_cable
