#pragma once

#include <Eigen/Core>
#include <vector>

#include "../rigs.h"

namespace cosserat_cable::generator {

/// Coarse enough for a search, and still finer than noise.
Accuracy searchAccuracy();
/// For the records that are written.
Accuracy recordAccuracy(const Experiment& e);

/// The experiments without what they have beyond the plain rod.
std::vector<Experiment> plain(std::vector<Experiment> experiments);

/// Standard deviation of each experiment's channels, of positions the same: `snr` dB below what
/// moves.
std::vector<Eigen::VectorXd> noiseOf(const std::vector<Experiment>& experiments,
                                     const std::vector<Record>& records, double snr);

/// What remains of an effect after the plain rod's EI, eta_EI, GJ and eta_GJ have been fitted to
/// it: Gauss and Newton from where the last answer was, with the derivatives of the first rod.
class Recalibration {
 public:
  /// @param experiments with the smallest effect that will be asked for, or none.
  Recalibration(const std::vector<Experiment>& experiments, double snr);

  struct Answer {
    double strength = 0.0;            ///< rms over all samples, in sigma
    std::vector<double> experiments;  ///< the same of each
    Eigen::Vector4d change;           ///< of the logarithms of EI, eta_EI, GJ, eta_GJ
    Eigen::VectorXd residual;         ///< of all samples, in sigma
  };
  /// @param guess of the parameters' change.
  Answer fit(const std::vector<Experiment>& experiments, const Eigen::Vector4d& guess) const;

  /// Shared by all: one row per sample, in sigma per unit of a logarithm.
  const Eigen::MatrixXd& derivatives() const { return derivatives_; }
  const std::vector<Eigen::VectorXd>& sigma() const { return sigma_; }

 private:
  Eigen::VectorXd weighted(const std::vector<Experiment>& experiments,
                           const Eigen::Vector4d& change) const;

  std::vector<Eigen::VectorXd> sigma_;
  Eigen::MatrixXd derivatives_;
};

}  // namespace cosserat_cable::generator
