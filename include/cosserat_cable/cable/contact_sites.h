// Where along a cable contact is looked for.
#pragma once

#include <cmath>

namespace cosserat_cable {

/// A point of the centreline between two nodes.
struct ContactSite {
  int element;
  double xi;  ///< fraction of the element
  double s;   ///< arc length [m]
};

/// Nodes, and evenly spaced between them, no farther apart than the cable's radius, and none within
/// a diameter of a clamp, where the fitting is.
class ContactSites {
 public:
  ContactSites(double length, double diameter, int elements)
      : length_(length),
        diameter_(diameter),
        h_(length / elements),
        per_element_(static_cast<int>(std::ceil(h_ / (0.5 * diameter)))) {}

  /// Those from the node before the element on, without the one behind it.
  template <class Act>
  void ForEach(int element, const Act& act) const {
    for (int k = 0; k < per_element_; ++k) {
      const double xi = static_cast<double>(k) / per_element_;
      const double s = (element + xi) * h_;
      if (s >= diameter_ && s <= length_ - diameter_) act(ContactSite{element, xi, s});
    }
  }

 private:
  double length_, diameter_, h_;
  int per_element_;
};

}  // namespace cosserat_cable
