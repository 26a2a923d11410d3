#include "noise.h"

#include <cmath>

namespace cosserat_cable::generator {

double Random::uniform(double low, double high) {
  return low + (high - low) * static_cast<double>(engine_() >> 11) / 9007199254740992.0;  // 2^53
}

double Random::logUniform(double low, double high) {
  return std::exp(uniform(std::log(low), std::log(high)));
}

double Random::normal() {
  // Box and Muller; 1 - u is never 0.
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(0.0, 1.0)));
  return radius * std::cos(2.0 * std::acos(-1.0) * uniform(0.0, 1.0));
}

Eigen::VectorXd jitteredTimes(double duration, double rate, double jitter, Random* random) {
  const int count = static_cast<int>(std::floor(duration * rate)) + 1;
  Eigen::VectorXd times(count);
  times[0] = 0.0;
  for (int i = 1; i < count; ++i) times[i] = (i + random->uniform(-jitter, jitter)) / rate;
  return times;
}

double noiseSigma(const Eigen::VectorXd& values, double rest, double snr) {
  const double rms = std::sqrt((values.array() - rest).square().mean());
  return rms / std::pow(10.0, snr / 20.0);
}

void addNoise(double sigma, Random* random, Eigen::Ref<Eigen::VectorXd> values) {
  for (double& value : values) value += sigma * random->normal();
}

void addNoise(double sigma, double correlation, Random* random,
              Eigen::Ref<Eigen::VectorXd> values) {
  const double fresh = std::sqrt(1.0 - correlation * correlation);
  double noise = random->normal();
  for (double& value : values) {
    value += sigma * noise;
    noise = correlation * noise + fresh * random->normal();
  }
}

}  // namespace cosserat_cable::generator
