#include "cosserat_cable/rod/point_loads.h"

#include <algorithm>
#include <cmath>

#include "cosserat_cable/math/small_eigen.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::Vector3d;

Vector3d At(const Centreline& rod, int element, double xi) {
  return (1 - xi) * ToEigen(rod.position(element)) + xi * ToEigen(rod.position(element + 1));
}

Vector3d ForceOn(const PointLoad& load, const Centreline& rod, int node) {
  return load.follower ? ToEigen(rod.orientation(node)) * load.force : load.force;
}

Vector3d MomentOn(const PointLoad& load, const Centreline& rod, int node) {
  return load.follower ? load.moment : ToEigen(rod.orientation(node)).conjugate() * load.moment;
}

}  // namespace

PointLoads::Place PointLoads::PlaceOf(const PointLoad& load, const Centreline& rod) const {
  const int elements = rod.elements();
  const double position =
      std::clamp(load.s / length_ * elements, 0.0, static_cast<double>(elements));
  const int element = std::min(static_cast<int>(position), elements - 1);
  return {element, position - element, static_cast<int>(std::lround(position))};
}

void PointLoads::Evaluate(const Centreline& rod, LoadSink* sink) const {
  for (const PointLoad& load : loads) {
    const Place place = PlaceOf(load, rod);
    sink->AddForce(place.element, place.xi, ToSmall(ForceOn(load, rod, place.node)), {}, {});
    sink->AddMoment(place.node, ToSmall(MomentOn(load, rod, place.node)));
  }
}

double PointLoads::Energy(const Centreline& rod) const {
  double energy = 0;
  for (const PointLoad& load : loads) {
    if (load.follower) continue;
    const Place place = PlaceOf(load, rod);
    energy -= load.force.dot(At(rod, place.element, place.xi));
  }
  return energy;
}

bool PointLoads::HasPotential() const {
  return std::none_of(loads.begin(), loads.end(), [](const PointLoad& load) {
    return load.moment.any() || (load.follower && load.force.any());
  });
}

}  // namespace cosserat_cable::rod
