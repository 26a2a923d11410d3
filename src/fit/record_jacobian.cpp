#include "cosserat_cable/fit/record_jacobian.h"

namespace cosserat_cable {

void AddPart(const Eigen::MatrixXd& part, const std::vector<int>& which, Eigen::MatrixXd* all) {
  for (std::size_t i = 0; i < which.size(); ++i)
    for (std::size_t k = 0; k < which.size(); ++k)
      (*all)(which[i], which[k]) +=
          part(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
}

Eigen::MatrixXd RecordJacobian::Gram() const {
  Eigen::MatrixXd gram = priors_.cwiseAbs2().asDiagonal();
  for (const Record& record : records_) {
    const Eigen::MatrixXd square = record.columns.transpose() * record.columns;
    AddPart(square, record.unknowns, &gram);
  }
  return gram;
}

Eigen::VectorXd RecordJacobian::TransposeTimes(const Eigen::VectorXd& residuals) const {
  Eigen::VectorXd product = Eigen::VectorXd::Zero(unknowns());
  Eigen::Index row = 0;
  for (const Record& record : records_) {
    const Eigen::VectorXd part =
        record.columns.transpose() * residuals.segment(row, record.columns.rows());
    for (std::size_t k = 0; k < record.unknowns.size(); ++k)
      product[record.unknowns[k]] += part[static_cast<Eigen::Index>(k)];
    row += record.columns.rows();
  }
  for (int i = 0; i < unknowns(); ++i)
    if (priors_[i] != 0) product[i] += priors_[i] * residuals[row++];
  return product;
}

Eigen::VectorXd RecordJacobian::SquaredNorms() const {
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(unknowns());
  for (const Record& record : records_)
    for (std::size_t k = 0; k < record.unknowns.size(); ++k)
      squares[record.unknowns[k]] += record.columns.col(static_cast<Eigen::Index>(k)).squaredNorm();
  return squares;
}

}  // namespace cosserat_cable
