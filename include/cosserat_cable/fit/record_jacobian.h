// Derivatives of the weighted residuals of all records, each record's by the unknowns that it
// shows: most unknowns of a set with unknown starts concern one record only.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace cosserat_cable {

/// By unknowns in units of their scales. Rows are those of WeightedResiduals: record by record,
/// then what is known beforehand of some unknowns.
class RecordJacobian {
 public:
  struct Record {
    std::vector<int> unknowns;  ///< of its columns
    Eigen::MatrixXd columns;    ///< a row per residual of the record
  };

  RecordJacobian() = default;
  /// `priors`: by unknown, derivative of what is known of it beforehand; zero where nothing is.
  RecordJacobian(std::vector<Record> records, const Eigen::VectorXd& priors)
      : records_(std::move(records)), priors_(priors) {}

  int unknowns() const { return static_cast<int>(priors_.size()); }
  const std::vector<Record>& records() const { return records_; }
  const Eigen::VectorXd& priors() const { return priors_; }

  /// J^T J.
  Eigen::MatrixXd Gram() const;
  /// J^T r. @pre `residuals` has this Jacobian's rows
  Eigen::VectorXd TransposeTimes(const Eigen::VectorXd& residuals) const;
  /// Squares of the columns' norms, records only.
  Eigen::VectorXd SquaredNorms() const;

 private:
  std::vector<Record> records_;
  Eigen::VectorXd priors_;
};

/// Adds a symmetric matrix over `which` to one over all unknowns.
void AddPart(const Eigen::MatrixXd& part, const std::vector<int>& which, Eigen::MatrixXd* all);

}  // namespace cosserat_cable
