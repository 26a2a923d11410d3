// `contact`: an obstacle beside the cable that no file has a body for: a plane or a peg, to be
// found.
//
// It stands in clamp a's frame and moves with it. The cable's surface is the row of spheres that it
// is against bodies (contact_set.h), each pressed by the contact law of the cable.
#include <algorithm>
#include <cmath>
#include <limits>

#include "cosserat_cable/cable/contact_sites.h"
#include "cosserat_cable/causes/cause.h"
#include "cosserat_cable/math/small_eigen.h"

namespace cosserat_cable {
namespace {

using Eigen::Vector3d;

Vector3d Direction(double azimuth, double elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

/// A half space n.x < offset, or a cylinder without end, in a frame.
struct Obstacle {
  bool plane;
  Vector3d direction;  // normal of the plane, axis of the peg
  Vector3d point;      // on the plane, on the axis [m]
  double radius;       // of the peg [m]
};

/// From the surface to a point.
struct Nearest {
  double distance;  // [m]
  Vector3d normal;
  double to_axis;  // distance from the axis about which the normal turns [m]; infinite for a plane
};

/// The obstacle at one instant, in W.
class Placed {
 public:
  Placed(const Obstacle& obstacle, const Motion& a)
      : obstacle_(obstacle),
        origin_(a.X.p),
        v_(a.v),
        omega_(a.X.q * a.omega),
        direction_(a.X.q * obstacle.direction),
        point_(a.X.p + a.X.q * obstacle.point) {}

  Nearest To(const Vector3d& p) const {
    const Vector3d d = p - point_;
    if (obstacle_.plane)
      return {direction_.dot(d), direction_, std::numeric_limits<double>::infinity()};
    const Vector3d across = d - direction_.dot(d) * direction_;
    const double to_axis = std::max(across.norm(), kOnAxis);
    return {to_axis - obstacle_.radius, across / to_axis, to_axis};
  }
  /// The normal turns by so much where the point moves along this.
  Vector3d Around(const Nearest& nearest) const { return direction_.cross(nearest.normal); }
  Vector3d VelocityAt(const Vector3d& p) const { return v_ + omega_.cross(p - origin_); }

 private:
  static constexpr double kOnAxis = 1e-9;  // [m] nearer to the axis than this, no side is nearer

  const Obstacle& obstacle_;
  Vector3d origin_, v_, omega_, direction_, point_;
};

class ObstacleContact final : public rod::Load {
 public:
  ObstacleContact(const Obstacle& obstacle, const ContactLaw& law, const CableModel& cable)
      : obstacle_(obstacle), law_(law), length_(cable.length), diameter_(cable.diameter) {}

  void Evaluate(const rod::Centreline& rod, rod::LoadSink* sink) const override {
    const Placed placed(obstacle_, rod.clamp_a());
    double dissipation = 0;
    ForEachNear(rod, placed, [&](const ContactSite& site, const Vector3d& p) {
      const Nearest nearest = placed.To(p);
      const double depth = 0.5 * diameter_ - nearest.distance;
      const Vector3d v = (1 - site.xi) * ToEigen(rod.velocity(site.element)) +
                         site.xi * ToEigen(rod.velocity(site.element + 1));
      const double closing = -nearest.normal.dot(v - placed.VelocityAt(p));
      const ContactLaw::Force force = law_.Evaluate(depth, closing);
      if (force.value == 0) return;
      const Vec3<double> n = ToSmall(nearest.normal);
      const Mat3<double> nn = Outer(n, n);
      Mat3<double> by_position = -force.by_penetration * nn;
      if (!obstacle_.plane) {
        const Vec3<double> t = ToSmall(placed.Around(nearest));
        by_position += (force.value / nearest.to_axis) * Outer(t, t);
      }
      sink->AddForce(site.element, site.xi, force.value * n, by_position, -force.by_rate * nn);
      dissipation += (force.value - law_.Evaluate(depth, 0).value) * closing;
    });
    sink->AddDissipation(dissipation);
  }

  double Energy(const rod::Centreline& rod) const override {
    const Placed placed(obstacle_, rod.clamp_a());
    double energy = 0;
    ForEachNear(rod, placed, [&](const ContactSite&, const Vector3d& p) {
      energy += law_.Energy(0.5 * diameter_ - placed.To(p).distance);
    });
    return energy;
  }

 private:
  /// Calls `act` for the sites of elements that may touch.
  template <class Act>
  void ForEachNear(const rod::Centreline& rod, const Placed& placed, const Act& act) const {
    // What it stands in the way of is often the tip of a free end.
    const ContactSites sites(length_, diameter_, rod.elements(), ContactSites::End::kTip);
    const double reach = 0.5 * (diameter_ + law_.smoothing);
    Vector3d left = ToEigen(rod.position(0));
    for (int e = 0; e < rod.elements(); ++e) {
      const Vector3d right = ToEigen(rod.position(e + 1));
      const double half = 0.5 * (right - left).norm();
      if (placed.To(0.5 * (left + right)).distance <= reach + half)
        sites.ForEach(
            e, [&](const ContactSite& site) { act(site, (1 - site.xi) * left + site.xi * right); });
      left = right;
    }
  }

  Obstacle obstacle_;
  ContactLaw law_;
  double length_, diameter_;  // [m]
};

Obstacle ObstacleOf(const CableExtension& extension) {
  const auto& numbers = extension.parts.front();
  if (numbers.count("plane.offset")) {
    const Vector3d normal = Direction(numbers.at("plane.azimuth"), numbers.at("plane.elevation"));
    return {true, normal, numbers.at("plane.offset") * normal, 0};
  }
  const Vector3d axis = Direction(numbers.at("peg.azimuth"), numbers.at("peg.elevation"));
  const Vector3d point(numbers.at("peg.x"), numbers.at("peg.y"), numbers.at("peg.z"));
  return {false, axis, point, numbers.at("peg.radius")};
}

ContactLaw LawOfContact(const CableExtension& extension, const CableModel& cable) {
  const auto& numbers = extension.parts.front();
  ContactLaw law = cable.contact;
  if (const auto own = numbers.find("stiffness"); own != numbers.end()) law.stiffness = own->second;
  return law;
}

std::shared_ptr<const rod::Load> MakeLoad(const CableExtension& extension,
                                          const CableModel& cable) {
  const ContactLaw law = LawOfContact(extension, cable);
  if (law.stiffness == 0) return nullptr;
  return std::make_shared<ObstacleContact>(ObstacleOf(extension), law, cable);
}

double Depth(const CableExtension& extension, const CableModel& cable, const Vector3d& p_A) {
  if (LawOfContact(extension, cable).stiffness == 0)
    return -std::numeric_limits<double>::infinity();
  const Obstacle obstacle = ObstacleOf(extension);
  return 0.5 * cable.diameter - Placed(obstacle, Motion()).To(p_A).distance;
}

bool Gives(const ExtensionKey& key, const std::string& group) {
  const auto& marks = key.marks.front();
  return std::any_of(marks.begin(), marks.end(),
                     [&](const auto& entry) { return entry.first.rfind(group + ".", 0) == 0; });
}

void Check(const ExtensionKey& key, const CableKeys&, Problems* problems) {
  if (Gives(key, "plane") && Gives(key, "peg"))
    problems->Add(key.mark, "got a plane and a peg, expected one of them");
}

}  // namespace

Cause ContactCause() {
  using Need = ExtensionField::Need;
  Cause cause;
  ExtensionLaw& law = cause.law.emplace();
  law.name = "contact";
  law.shape =
      "an obstacle {plane: {azimuth: ..., elevation: ..., offset: ...}} or {peg: {x: ..., "
      "y: ..., z: ..., azimuth: ..., elevation: ..., radius: ...}}";
  const NumberSpec place = NumberSpec::AtLeast(-20, "m").AtMost(20).Hint("is it in mm?");
  const NumberSpec angle = NumberSpec::AtLeast(-7, "rad").AtMost(7).Hint("is it in degrees?");
  law.fields = {{"plane.azimuth", "rad", angle, Need::kInGroup},
                {"plane.elevation", "rad", angle, Need::kInGroup},
                {"plane.offset", "m", place, Need::kInGroup},
                {"peg.x", "m", place, Need::kInGroup},
                {"peg.y", "m", place, Need::kInGroup},
                {"peg.z", "m", place, Need::kInGroup},
                {"peg.azimuth", "rad", angle, Need::kInGroup},
                {"peg.elevation", "rad", angle, Need::kInGroup},
                {"peg.radius", "m", NumberSpec::AtLeast(0, "m").AtMost(20).Hint("is it in mm?"),
                 Need::kInGroup},
                {"stiffness", "N/m", NumberSpec::AtLeast(0, "N/m").AtMost(1e9), Need::kOptional}};
  law.check = Check;
  law.load = MakeLoad;
  law.depth = Depth;
  cause.name = law.name;
  cause.words = "an obstacle that the model does not have";
  return cause;
}

}  // namespace cosserat_cable
