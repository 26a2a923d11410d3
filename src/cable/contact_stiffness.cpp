#include "cosserat_cable/cable/contact_stiffness.h"

#include <algorithm>
#include <cmath>

namespace cosserat_cable {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kWeights = 10, kGravity = 9.81;  // shocks; [m/s^2]
constexpr double kPushed = 0.1, kMostStrain = 0.01;
// The depth follows from a force that grows as the cable is lifted out: some more is needed.
constexpr double kMargin = 1.2;
constexpr double kStiffest = 1e9;  // [N/m], the most that a file may give

double RoundUpToTwoDigits(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1);
  // A value that has two digits already may be above them by rounding.
  return std::ceil(value / unit - 1e-9) * unit;
}

double TautForce(const CableModel& cable) {
  if (cable.a.link.empty() || cable.a.link != cable.b.link) return 0;
  const double chord = (cable.b.X_LC.p - cable.a.X_LC.p).norm();
  const double push = kPushed * cable.length;
  const double length = std::hypot(chord, 2 * push);
  const double strain = std::clamp(length / cable.length - 1, 0.0, kMostStrain);
  return 4 * cable.EA * strain * push / length;
}

}  // namespace

double DefaultContactStiffness(const CableModel& cable) {
  const double radius = 0.5 * cable.diameter, EI = std::max(cable.EI1, cable.EI2);
  const double bending = 96 * EI / (cable.length * cable.length);
  const double weight = kWeights * kGravity * cable.mass_per_length * cable.length;
  const double force = bending + weight + TautForce(cable);
  const double modulus = cable.flat() ? 12 / (cable.width * cable.height) *
                                            std::max(cable.EI1 / std::pow(cable.height, 2),
                                                     cable.EI2 / std::pow(cable.width, 2))
                                      : 64 * EI / (kPi * std::pow(cable.diameter, 4));
  const double needed = std::min(force / (kDeepestShareOfRadius * radius), modulus * radius);
  const double floor = ContactLaw().stiffness;
  return needed <= floor ? floor : std::min(kStiffest, RoundUpToTwoDigits(needed));
}

double SufficientContactStiffness(const CableModel& cable, double penetration) {
  const double ratio = penetration / (kDeepestShareOfRadius * 0.5 * cable.diameter);
  if (!(ratio > 1)) return 0;
  double needed = RoundUpToTwoDigits(kMargin * ratio * ratio * cable.contact.stiffness);
  if (penetration > 0.5 * cable.diameter) needed = std::max(needed, DefaultContactStiffness(cable));
  return std::min(kStiffest, needed);
}

}  // namespace cosserat_cable
