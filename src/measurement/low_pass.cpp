#include "low_pass.h"

#include <algorithm>
#include <cmath>

namespace cosserat_cable {
namespace {

constexpr int kMostCoefficients = 6;

/// The response at the step's end to u^n, n = 0, 1, ..., over a step of `a` time constants:
/// int_0^1 a exp(-a (1 - u)) u^n du.
std::array<double, kMostCoefficients> Responses(double a) {
  std::array<double, kMostCoefficients> response{};
  if (a < 1) {
    // sum_m (-1)^m a^(m+1) n!/(n + m + 1)!, where the recursion below would cancel.
    for (int n = 0; n < kMostCoefficients; ++n) {
      double term = a / (n + 1), sum = term;
      for (int m = 1; m < 30; ++m) sum += (term *= -a / (n + m + 1));
      response[static_cast<std::size_t>(n)] = sum;
    }
    return response;
  }
  response[0] = -std::expm1(-a);
  for (std::size_t n = 1; n < kMostCoefficients; ++n)
    response[n] = 1 - static_cast<double>(n) / a * response[n - 1];
  return response;
}

}  // namespace

LowPass::LowPass(const Trace& trace, int quantity, double time_constant, Before before)
    : trace_(trace), quantity_(quantity), w_(1 / time_constant) {
  y_.reserve(static_cast<std::size_t>(trace.steps()));
  y_.push_back(Start(before));
  const double a = w_ * trace.dt(), decay = std::exp(-a);
  const std::array<double, kMostCoefficients> response = Responses(a);
  for (int k = 0; k + 1 < trace.steps(); ++k) {
    const std::array<double, 6> x = trace.Polynomial(quantity, k);
    double next = decay * y_.back();
    for (std::size_t n = 0; n < x.size(); ++n) next += x[n] * response[n];
    y_.push_back(next);
  }
}

double LowPass::Start(Before before) const {
  const double start = trace_.start(), x = trace_.Evaluate(quantity_, start, 0);
  if (before == Before::kStands) return x;
  const double rate = trace_.Evaluate(quantity_, start, 1);
  if (before == Before::kGoesSteady) return x - rate / w_;
  const int steps = trace_.steps();
  double mean = 0, square = 0, rates = 0;
  for (int k = 0; k < steps; ++k) mean += trace_.value(quantity_, k) / steps;
  for (int k = 0; k < steps; ++k) {
    square += std::pow(trace_.value(quantity_, k) - mean, 2);
    rates += std::pow(trace_.Evaluate(quantity_, start + k * trace_.dt(), 1), 2);
  }
  if (!(square > 0)) return x;
  return mean + (x - mean - rate / w_) / (1 + rates / square / (w_ * w_));
}

double LowPass::Behind(int k, double u) const {
  const double a = w_ * trace_.dt() * u;
  const std::array<double, 6> x = trace_.Polynomial(quantity_, k);
  const std::array<double, kMostCoefficients> response = Responses(a);
  double y = std::exp(-a) * y_[static_cast<std::size_t>(k)], power = 1;
  for (std::size_t n = 0; n < x.size(); ++n, power *= u) y += x[n] * power * response[n];
  return y;
}

double LowPass::Evaluate(double t, int order) const {
  const double place = (t - trace_.start()) / trace_.dt();
  const int k = std::clamp(static_cast<int>(std::floor(place)), 0, std::max(0, trace_.steps() - 2));
  const double y = Behind(k, place - k);
  if (order == 0) return y;
  const double rate = w_ * (trace_.Evaluate(quantity_, t, 0) - y);
  if (order == 1) return rate;
  return w_ * (trace_.Evaluate(quantity_, t, 1) - rate);
}

}  // namespace cosserat_cable
