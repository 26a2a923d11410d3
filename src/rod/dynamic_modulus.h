// What a section component answers to a strain that varies as exp(lambda t).
#pragma once

#include <complex>
#include <vector>

namespace cosserat_cable::rod {

/// k(lambda) = C + V lambda + sum_b G_b lambda/(lambda + rate_b): a spring and a dashpot beside any
/// number of Maxwell branches. Every linear viscoelastic law of springs and dashpots has this form.
struct DynamicModulus {
  struct Branch {
    double G;     ///< stiffness that it adds to fast motion, in units of C
    double rate;  ///< its relaxation rate [1/s]
  };

  double C = 0;  ///< static stiffness [N] or [N m^2]
  double V = 0;  ///< [N s] or [N m^2 s]
  std::vector<Branch> branches;

  std::complex<double> operator()(const std::complex<double>& lambda) const {
    std::complex<double> k = C + V * lambda;
    for (const Branch& b : branches) k += b.G * lambda / (lambda + b.rate);
    return k;
  }
  /// dk/d(lambda).
  std::complex<double> Derivative(const std::complex<double>& lambda) const {
    std::complex<double> k = V;
    for (const Branch& b : branches) k += b.G * b.rate / ((lambda + b.rate) * (lambda + b.rate));
    return k;
  }
};

}  // namespace cosserat_cable::rod
