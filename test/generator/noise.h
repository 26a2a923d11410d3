#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>

namespace cosserat_cable::generator {

/// Random numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high);
  double logUniform(double low, double high);
  double normal();
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }

 private:
  std::mt19937_64 engine_;
};

/// Times [s] from 0 over `duration`, `rate` [Hz] on average: each but the first off its place by up
/// to `jitter` (0..0.5) periods either way.
Eigen::VectorXd jitteredTimes(double duration, double rate, double jitter, Random* random);

/// Standard deviation of noise `snr` dB below the rms of what remains of `values` beside `rest`.
double noiseSigma(const Eigen::VectorXd& values, double rest, double snr);

/// White Gaussian noise on top of `values`.
void addNoise(double sigma, Random* random, Eigen::Ref<Eigen::VectorXd> values);

/// The same with a correlation between neighbours (AR(1)); `sigma` is the marginal one.
void addNoise(double sigma, double correlation, Random* random, Eigen::Ref<Eigen::VectorXd> values);

}  // namespace cosserat_cable::generator
