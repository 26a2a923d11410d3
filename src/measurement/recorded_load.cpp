#include "recorded_load.h"

#include <algorithm>

#include "cosserat_cable/math/small_eigen.h"

namespace cosserat_cable {

template <class Use>
void RecordedLoad::ForEach(const rod::Centreline& rod, const Use& use) const {
  const auto act = [&](double s, const Eigen::Vector3d& force_W) {
    const int elements = rod.elements();
    const double x = std::clamp(s / length_ * elements, 0.0, static_cast<double>(elements));
    const int element = std::min(static_cast<int>(x), elements - 1);
    use(element, x - element, force_W);
  };
  const std::vector<ExperimentLoad::Sample>& samples = load_.samples;
  if (load_.file.empty()) {
    for (const ExperimentLoad::Sample& sample : samples) act(sample.s, sample.force_W);
    return;
  }
  // Samples of one time are forces at several points: the i-th goes over into the i-th.
  const double t = rod.time();
  const auto after = std::upper_bound(
      samples.begin(), samples.end(), t,
      [](double time, const ExperimentLoad::Sample& sample) { return time < sample.t; });
  const auto first_at = [&](double time) {
    return std::lower_bound(
        samples.begin(), samples.end(), time,
        [](const ExperimentLoad::Sample& sample, double limit) { return sample.t < limit; });
  };
  auto left = after == samples.begin() ? after : first_at((after - 1)->t);
  auto right = after == samples.end() ? left : after;
  const double from = left->t, to = right->t;
  const double part = to > from ? std::clamp((t - from) / (to - from), 0.0, 1.0) : 0.0;
  for (; left != samples.end() && left->t == from; ++left) {
    const bool paired = right != samples.end() && right->t == to;
    const ExperimentLoad::Sample& next = paired ? *right++ : *left;
    act(left->s + part * (next.s - left->s), left->force_W + part * (next.force_W - left->force_W));
  }
}

void RecordedLoad::Evaluate(const rod::Centreline& rod, rod::LoadSink* sink) const {
  ForEach(rod, [&](int element, double xi, const Eigen::Vector3d& force_W) {
    sink->AddForce(element, xi, ToSmall(force_W), {}, {});
  });
}

double RecordedLoad::Energy(const rod::Centreline& rod) const {
  double energy = 0;
  ForEach(rod, [&](int element, double xi, const Eigen::Vector3d& force_W) {
    const Eigen::Vector3d p =
        (1 - xi) * ToEigen(rod.position(element)) + xi * ToEigen(rod.position(element + 1));
    energy -= force_W.dot(p);
  });
  return energy;
}

}  // namespace cosserat_cable
