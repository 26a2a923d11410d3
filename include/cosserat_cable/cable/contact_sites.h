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
  /// `end`: whether b is a clamp, or may be an end that touches with its tip.
  enum class End { kClamp, kTip };
  ContactSites(double length, double diameter, int elements, End end = End::kClamp)
      : length_(length),
        diameter_(diameter),
        h_(length / elements),
        elements_(elements),
        per_element_(static_cast<int>(std::ceil(h_ / (0.5 * diameter)))),
        end_(end) {}

  /// Those from the node before the element on, without the one behind it; but for the tip.
  template <class Act>
  void ForEach(int element, const Act& act) const {
    for (int k = 0; k < per_element_; ++k) {
      const double xi = static_cast<double>(k) / per_element_;
      const double s = (element + xi) * h_;
      if (s >= diameter_ && (end_ == End::kTip || s <= length_ - diameter_))
        act(ContactSite{element, xi, s});
    }
    if (end_ == End::kTip && element == elements_ - 1) act(ContactSite{element, 1.0, length_});
  }

 private:
  double length_, diameter_, h_;
  int elements_, per_element_;
  End end_;
};

}  // namespace cosserat_cable
