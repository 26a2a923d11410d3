// Sums of decaying oscillations and decaying exponentials, fitted to a record by variable
// projection: the linear amplitudes are eliminated, what is searched for are frequencies and decay
// rates.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace cosserat_cable {

/// exp(-delta t) (c cos(psi) + s sin(psi)), psi = omega t + shift (1 - exp(-2 delta t))/(2 delta);
/// or exp(-delta t) c where it does not oscillate. t counts from the first sample.
struct DampedTerm {
  bool oscillates = true;
  double omega = 0;  ///< [rad/s], of small amplitudes
  double delta = 0;  ///< [1/s]
  /// Whether the frequency depends on the amplitude's square; then it is higher by `shift` [rad/s]
  /// at the first sample.
  bool shifts = false;
  double shift = 0;

  int nonlinear() const { return oscillates ? (shifts ? 3 : 2) : 1; }
  int linear() const { return oscillates ? 2 : 1; }
};

/// Noise whose correlation falls exponentially: correlation[i] is that of samples i - 1 and i;
/// empty: white.
struct NoiseCorrelation {
  Eigen::VectorXd correlation;

  bool white() const { return correlation.size() == 0; }
  /// Makes noise of standard deviation s in each column white, of the same s.
  void Whiten(Eigen::Ref<Eigen::MatrixXd> columns) const;
  /// Of the matrix that Whiten() multiplies with the inverse square root of.
  double LogDeterminant() const;
};

/// 1, then one or two columns per term.
Eigen::MatrixXd TermColumns(const Eigen::VectorXd& t, const std::vector<DampedTerm>& terms);

struct TermsFit {
  bool converged = false;
  std::vector<DampedTerm> terms;
  Eigen::VectorXd amplitudes;       ///< offset, then c (and s) per term
  Eigen::VectorXd residual;         ///< record - fit
  Eigen::VectorXd white_residual;   ///< made white
  Eigen::MatrixXd inverse_hessian;  ///< times the noise's variance: covariance of (omega, delta,
                                    ///< shift) of all terms, those that each has
  double sum_of_squares = 0;        ///< of white_residual
};

/// Weighted least squares from the given start.
/// @pre t increases from 0, and is as long as y
TermsFit FitTerms(const Eigen::VectorXd& t, const Eigen::VectorXd& y,
                  const std::vector<DampedTerm>& start, const NoiseCorrelation& noise);

/// Derivatives of the fit by all that it adjusts: amplitudes, then (omega, delta, shift) of each
/// term.
Eigen::MatrixXd FitSlopes(const Eigen::VectorXd& t, const TermsFit& fit);

}  // namespace cosserat_cable
