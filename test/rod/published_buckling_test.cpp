// Straight rods under twisting moment and axial force: where they buckle.
//
// What a twisting moment M does when its end tilts decides. Held to the axis of the laboratory (and
// just so where it follows the tilted section) it gives the textbook's (M/2EI)^2 + P/EI = (pi/L)^2
// (Greenhill 1883; P: compression). An end that is hinged and held, and turned, about its third
// rotation component follows half of the tilt: then the bending moment left to the hinge to take is
// half of M times the tilt, and the rod buckles earlier.
#include <gtest/gtest.h>

#include "cosserat_cable/rod/modes.h"
#include "cosserat_cable/rod/point_loads.h"
#include "rod/rod_cases.h"
#include "tools/validation.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::Vector3d;

constexpr int kElements = 80;
constexpr double kGJ = 0.75;
constexpr double kEuler = M_PI * M_PI;
constexpr double kWithin = 0.01;  // relative

/// EI = rhoA = L = 1: moments are in units of EI/L, forces of EI/L^2.
RodModel Model() {
  RodModel model = RoundCable(1, 0.004, 1, 1, kGJ, 0, 0, kElements);
  model.section.V_F.setZero();
  model.gravity.setZero();
  return model;
}

/// Along z under compression P, twisted by M.
std::vector<Pose> Twisted(const RodModel& model, double M, double P) {
  std::vector<Pose> nodes;
  for (int i = 0; i <= kElements; ++i) {
    const double s = i / static_cast<double>(kElements);
    nodes.push_back({Vector3d(0, 0, s * (1 - P / model.section.C_F.z())),
                     Eigen::Quaterniond(Eigen::AngleAxisd(M / kGJ * s, Vector3d::UnitZ()))});
  }
  return nodes;
}

/// Where a straight line through two points is zero.
double Zero(double x1, double y1, double x2, double y2) { return x1 - y1 * (x2 - x1) / (y2 - y1); }

/// The moment at which the square of the lowest frequency of a rod with such ends becomes zero:
/// from two moments a little below the `expected` one. That w^2 is not quite linear costs 1e-3.
double BucklingMoment(const EndModel& end, double P, double expected) {
  RodModel model = Model();
  model.a = model.b = end;
  const auto w_squared = [&](double M) {
    Rod rod(model);
    rod.SetConfiguration(Twisted(model, M, P));
    const double w = FindModes(rod, 1)[0].w;
    EXPECT_GT(w, 0) << "buckled at " << M;
    return w * w;
  };
  const double low = 0.96 * expected, high = 0.98 * expected;
  return Zero(low, w_squared(low), high, w_squared(high));
}

TEST(PublishedBuckling, ClampedEnds) {
  // tan(M/2) = M/2.
  constexpr double kTarget = 8.98682;
  Validate({"Statics", "twist buckling, clamped ends: M L/EI", "Greenhill 1883, tan(M/2) = M/2",
            kTarget, BucklingMoment(EndModel::Clamped(), 0, kTarget), kWithin * kTarget,
            kElements});
}

TEST(PublishedBuckling, HingesThatHoldTheTwist) {
  // With the deflection w = x + iy, compression p, w'''' - i M w''' + p w'' = 0; at both ends w = 0
  // and w'' = i M/2 w'. Solved with w = A exp(i k1 s) + B exp(i k2 s) + C + D s, k = M/2 +- q,
  // from the middle:  p q sin q + M^2/2 (cos q - cos M/2) = 0,  q = sqrt(M^2/4 + p).
  EndModel hinge = EndModel::Pinned();
  hinge.rotation[2] = true;
  for (const double share : {0.75, 0.5, -1.0}) {
    const double p = share * kEuler;
    // The textbook's moment is above, this one of its fractions below.
    double low = std::max(1.2 * std::sqrt(kEuler - p), 2.001 * std::sqrt(std::max(0.0, -p)));
    double high = 2 * std::sqrt(kEuler - p);
    const auto stable = [p](double M) {
      const double q = std::sqrt(M * M / 4 + p);
      return p * q * std::sin(q) + M * M / 2 * (std::cos(q) - std::cos(M / 2)) > 0;
    };
    ASSERT_TRUE(stable(low) && !stable(high));
    while (high - low > 1e-9) {
      const double middle = 0.5 * (low + high);
      (stable(middle) ? low : high) = middle;
    }
    Validate({"Statics",
              "twist buckling, hinges that hold the twist, compression " + Shown(share) +
                  " pi^2 EI/L^2: M L/EI",
              "closed form for half-following moments", low, BucklingMoment(hinge, p, low),
              kWithin * low, kElements});
  }
}

/// -w^2 of the small motion of a pinned rod between moments that keep their direction in space; its
/// amplitude grows where this is positive.
double Growth(double M, double P) {
  constexpr double kDt = 5e-3, kAmplitude = 3e-3;
  RodModel model = Model();
  model.a = EndModel::Pinned();
  model.a.stiffness.z() = 1;  // else the rod may spin
  model.b = EndModel::Pinned();
  model.b.translation[2] = false;
  // From the buckled shape exp(i M s/2) sin(pi s), sections across it.
  std::vector<Pose> nodes = Twisted(model, M, P);
  for (int i = 0; i <= kElements; ++i) {
    const double s = i / static_cast<double>(kElements), c = std::cos(M * s / 2),
                 d = std::sin(M * s / 2), f = std::sin(M_PI * s), df = M_PI * std::cos(M_PI * s);
    nodes[i].p += kAmplitude * f * Vector3d(c, d, 0);
    const Vector3d slope = kAmplitude * (df * Vector3d(c, d, 0) + M / 2 * f * Vector3d(-d, c, 0));
    nodes[i].q = ShortestTurn(Vector3d::UnitZ(), Vector3d::UnitZ() + slope) * nodes[i].q;
  }
  const Pose a, b = {nodes.back().p, Eigen::Quaterniond::Identity()};
  Rod rod(model);
  rod.SetConfiguration(nodes);
  rod.SetClamps(a, b);
  const PointLoads loads(1, {{0, Vector3d::Zero(), {0, 0, -M}}, {1, {0, 0, -P}, {0, 0, M}}});
  // Least squares of the acceleration by the deflection of the middle.
  Vector3d before = Vector3d::Zero(), last = Vector3d::Zero();
  double products = 0, squares = 0;
  for (int k = 0; k <= 60; ++k) {
    const bool converged = k == 0 || rod.Step(kDt, a, b, &loads).converged;
    EXPECT_TRUE(converged) << k;
    Vector3d now = rod.pose(kElements / 2).p;
    now.z() = 0;
    if (k > 1) {
      products += last.dot(now - 2 * last + before) / (kDt * kDt);
      squares += last.squaredNorm();
    }
    before = last;
    last = now;
  }
  return products / squares;
}

TEST(PublishedBuckling, PinnedEndsUnderMomentsThatKeepTheirDirection) {
  for (const double share : {0.0, 0.5, -1.0}) {
    const double p = share * kEuler, target = 2 * std::sqrt(kEuler - p);
    // Growth is zero at the buckling moment: a straight line through both sides of it.
    const double low = 0.97 * target, high = 1.03 * target;
    const double at_low = Growth(low, p), at_high = Growth(high, p);
    EXPECT_LT(at_low, 0);
    EXPECT_GT(at_high, 0);
    Validate({"Statics",
              "twist buckling, pinned ends, compression " + Shown(share) + " pi^2 EI/L^2: M L/EI",
              "Greenhill 1883, (M/2EI)^2 + P/EI = (pi/L)^2", target,
              Zero(low, at_low, high, at_high), kWithin * target, kElements, 5e-3});
  }
}

}  // namespace
}  // namespace cosserat_cable::rod
