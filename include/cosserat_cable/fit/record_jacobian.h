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

  /// By unknown, whether derivatives by it are there.
  std::vector<bool> Known() const;
  /// Those by some of the unknowns.
  RecordJacobian Only(const std::vector<bool>& which) const;
  /// Adds those by some of the unknowns, which are not here yet, from another Jacobian of the same
  /// records.
  void Add(const RecordJacobian& other, const std::vector<bool>& which);

  /// Corrected by what a step did to the residuals: the least change with which it says so, each
  /// unknown measured by what it does to the record (Broyden 1965). `step` in units of the scales;
  /// `change` in this Jacobian's rows.
  void Correct(const Eigen::VectorXd& step, const Eigen::VectorXd& change);

 private:
  std::vector<Record> records_;
  Eigen::VectorXd priors_;
};

/// Adds a symmetric matrix over `which` to one over all unknowns.
void AddPart(const Eigen::MatrixXd& part, const std::vector<int>& which, Eigen::MatrixXd* all);

}  // namespace cosserat_cable
