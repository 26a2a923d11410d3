// The span of the few columns of a tall matrix: least squares, and what is left beside it.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/QR>
#include <optional>

namespace cosserat_cable {

/// Through the columns' Gram matrix, which takes a fraction of the time of a QR decomposition of
/// the columns; through that where they are too near to being dependent.
class ColumnSpan {
 public:
  /// @pre columns are finite, none is zero, and there are no more of them than rows
  explicit ColumnSpan(Eigen::MatrixXd columns);

  /// Coefficients of the columns with the least sum of squares.
  Eigen::VectorXd Solve(const Eigen::VectorXd& y) const;
  /// Takes out of each column of m what the span has of it.
  void Leave(Eigen::Ref<Eigen::MatrixXd> m) const;
  /// ln det(columns^T columns).
  double LogDeterminantOfGram() const;

 private:
  Eigen::MatrixXd Coefficients(const Eigen::MatrixXd& m) const;

  Eigen::MatrixXd columns_;
  Eigen::VectorXd scale_;  // makes the columns' norms 1
  Eigen::LLT<Eigen::MatrixXd> gram_;
  std::optional<Eigen::HouseholderQR<Eigen::MatrixXd>> qr_;
};

}  // namespace cosserat_cable
