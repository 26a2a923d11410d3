// Where a closed form is an equation and not a formula.
#pragma once

namespace cosserat_cable {

/// The root of a function that changes sign once between `low` and `high`, by bisection.
template <class Function>
double Root(const Function& f, double low, double high) {
  const bool rises = f(high) > 0;
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (low + high);
    ((f(middle) > 0) == rises ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace cosserat_cable
