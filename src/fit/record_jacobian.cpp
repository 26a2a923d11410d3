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

std::vector<bool> RecordJacobian::Known() const {
  std::vector<bool> known(static_cast<std::size_t>(unknowns()), false);
  for (const Record& record : records_)
    for (const int i : record.unknowns) known[static_cast<std::size_t>(i)] = true;
  return known;
}

RecordJacobian RecordJacobian::Only(const std::vector<bool>& which) const {
  RecordJacobian some(std::vector<Record>(records_.size()), priors_);
  for (std::size_t e = 0; e < records_.size(); ++e)
    some.records_[e].columns.resize(records_[e].columns.rows(), 0);
  some.Add(*this, which);
  return some;
}

void RecordJacobian::Add(const RecordJacobian& other, const std::vector<bool>& which) {
  for (std::size_t e = 0; e < records_.size(); ++e) {
    Record& to = records_[e];
    const Record& from = other.records_[e];
    for (std::size_t k = 0; k < from.unknowns.size(); ++k) {
      if (!which[static_cast<std::size_t>(from.unknowns[k])]) continue;
      to.columns.conservativeResize(Eigen::NoChange, to.columns.cols() + 1);
      to.columns.rightCols<1>() = from.columns.col(static_cast<Eigen::Index>(k));
      to.unknowns.push_back(from.unknowns[k]);
    }
  }
}

void RecordJacobian::Correct(const Eigen::VectorXd& step, const Eigen::VectorXd& change) {
  Eigen::Index row = 0;
  for (Record& record : records_) {
    const Eigen::Index rows = record.columns.rows();
    Eigen::VectorXd own(record.columns.cols());
    for (Eigen::Index k = 0; k < own.size(); ++k)
      own[k] = step[record.unknowns[static_cast<std::size_t>(k)]];
    const Eigen::VectorXd weighted =
        own.cwiseProduct(record.columns.colwise().squaredNorm().transpose());
    const double length = own.dot(weighted);
    if (length > 0)
      record.columns +=
          (change.segment(row, rows) - record.columns * own) * (weighted / length).transpose();
    row += rows;
  }
}

}  // namespace cosserat_cable
