// extensions.contact: a plane or a peg in clamp a's frame, moving with it, by a penalty at 120
// stations along the rod. `stiffness` is per contact point as the library has one per element: 40
// of them a length. The force sets in as a parabola over 0.1 mm and grows by 0.5 s/m times the
// speed of closing, like the library's law. Without peg.radius it is a plane.

#include <algorithm>
#include <cmath>

#include "kinds.h"

namespace cosserat_cable::generator {
namespace {

using Eigen::Vector3d;

constexpr double kPointsPerLength = 40.0;
constexpr double kOnset = 1e-4;   // [m]
constexpr double kDamping = 0.5;  // [s/m]

Vector3d direction(double azimuth, double elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

class Contact : public Effect {
 public:
  Contact(const EffectValues& v, const CableData& cable)
      : peg_(valueOf(v, "peg.radius") > 0.0),
        absent_(valueOf(v, "stiffness") <= 0.0),
        axis_(peg_ ? direction(valueOf(v, "peg.azimuth"), valueOf(v, "peg.elevation"))
                   : direction(valueOf(v, "plane.azimuth"), valueOf(v, "plane.elevation"))),
        centre_(valueOf(v, "peg.x"), valueOf(v, "peg.y"), valueOf(v, "peg.z")),
        depth_(peg_ ? valueOf(v, "peg.radius") : valueOf(v, "plane.offset")),
        radius_(0.5 * cable.diameter),
        stiffness_(valueOf(v, "stiffness") * kPointsPerLength / cable.length) {}

  bool abrupt() const override { return !absent_; }
  int stations() const override { return absent_ ? 0 : 120; }

  void addForces(const StationState& at, Points* force) const override {
    const FrameMotion& a = at.clamp;
    for (int i = 0; i < force->cols(); ++i) {
      const Vector3d lever = at.position.col(i) - a.p;
      const Vector3d x = a.R.transpose() * lever;
      const Vector3d v = a.R.transpose() * (Vector3d(at.velocity.col(i)) - a.v - a.w.cross(lever));
      Vector3d out = axis_;
      double distance = axis_.dot(x);
      if (peg_) {
        const Vector3d from = x - centre_;
        out = from - axis_.dot(from) * axis_;
        distance = out.norm();
        if (distance == 0.0) continue;
        out /= distance;
      }
      const double in = depth_ + radius_ - distance;
      if (in <= 0.0) continue;
      const double pressed = in < kOnset ? 0.5 * in * in / kOnset : in - 0.5 * kOnset;
      const double closing = std::max(-1.0 / kDamping, -out.dot(v));
      force->col(i) += stiffness_ * pressed * (1.0 + kDamping * closing) * (a.R * out);
    }
  }

 private:
  bool peg_, absent_;
  Vector3d axis_, centre_;
  double depth_, radius_, stiffness_;
};

EffectValues defaults(const EffectScale& scale, double size) {
  const CableData& c = scale.cable;
  // As the library's default: sinks 5 % of the radius under what it can plausibly press with.
  const double press = 96.0 * c.EI / (c.length * c.length) + 98.1 * c.rhoA * c.length;
  const double stiffness = std::max(2e4, press / (0.025 * c.diameter));
  return {{"plane.azimuth", scale.azimuth},
          {"plane.elevation", 0.0},
          {"plane.offset", -scale.obstacle},
          {"peg.x", 0.0},
          {"peg.y", 0.0},
          {"peg.z", 0.0},
          {"peg.azimuth", 0.0},
          {"peg.elevation", 0.0},
          {"peg.radius", 0.0},
          {"stiffness", size == 0.0 ? 0.0 : stiffness}};
}

std::unique_ptr<Effect> make(const EffectValues& values, const EffectSite& site) {
  return std::make_unique<Contact>(values, site.cable);
}

}  // namespace

const EffectKind kContact = {"contact", "extensions.contact", defaults, make};

}  // namespace cosserat_cable::generator
