// Published equilibria, through the public interface.
#include <gtest/gtest.h>

#include "cosserat_cable/rod/point_loads.h"
#include "rod/published_rods.h"
#include "tools/validation.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::Vector3d;

TEST(PublishedStatics, EndMomentRollUp) {
  constexpr double kWithin = 1e-8;  // of the length: constant curvature is exact in this element
  constexpr int kElements = 40;
  for (int turns : {1, 2}) {
    RodModel model = InextensibleRod(0.02, kElements);
    model.b = EndModel::Free();
    Rod rod(model);
    rod.SetConfiguration(StraightShape(Pose{}, 1.0, kElements));
    PointLoads load(1.0, {{1.0}});
    load.loads[0].follower = true;
    // In steps of a twentieth of a turn: a moment has no potential to descend.
    for (int k = 1; k <= 20 * turns; ++k) {
      load.loads[0].moment = {0, 2 * M_PI * 0.02 * k / 20, 0};
      ASSERT_TRUE(rod.Equilibrate(&load).converged) << turns << ' ' << k;
    }
    Validate({"Statics",
              "roll-up by an end moment of " + std::to_string(2 * turns) +
                  " pi EI/L: distance of the ends / L",
              "closed circle", 0, (rod.pose(kElements).p - rod.pose(0).p).norm(), kWithin,
              kElements});
  }
}

TEST(PublishedStatics, ElasticaCantilever) {
  constexpr double kWithin = 1e-4;  // of the length; the table's last digit is 1e-5
  constexpr int kElements = 80;
  const double load[] = {1, 2, 5, 10};
  const double w[] = {0.30172, 0.49346, 0.71379, 0.81061};
  const double u[] = {0.05643, 0.16064, 0.38763, 0.55500};
  RodModel model = InextensibleRod(0.02, kElements);
  model.b = EndModel::Free();
  for (int k = 0; k < 4; ++k) {
    Rod rod(model);
    rod.SetConfiguration(StraightShape(Pose{}, 1.0, kElements));
    const PointLoads force(1.0, {{1.0, {0.02 * load[k], 0, 0}}});
    ASSERT_TRUE(rod.Equilibrate(&force).converged);
    const std::string name = "elastica, P L^2/EI = " + Shown(load[k]);
    const char* source = "Mattiasson 1981";
    const Vector3d tip = rod.pose(kElements).p;
    Validate({"Statics", name + ": w/L", source, w[k], tip.x(), kWithin, kElements});
    Validate({"Statics", name + ": u/L", source, u[k], 1 - tip.z(), kWithin, kElements});
  }
}

TEST(PublishedStatics, BendOfFortyFiveDegrees) {
  constexpr double kWithin = 1e-3;  // of the position
  const Vector3d target(15.685, 47.150, 53.475);
  constexpr int kElements = 64;
  Rod rod = FortyFiveDegreeBend(kElements);
  const double length = rod.model().length;
  const PointLoads force(length, {{length, {0, 0, 600}}});
  ASSERT_TRUE(rod.Equilibrate(&force).converged);
  const Vector3d tip = rod.pose(kElements).p;
  for (int k = 0; k < 3; ++k)
    Validate({"Statics", std::string("45 degree bend, tip load 600: tip ") + "xyz"[k],
              "Bathe and Bolourchi 1979, converged", target[k], tip[k], kWithin * target.norm(),
              kElements});
}

TEST(PublishedStatics, PrincetonBeam) {
  // Dowell and Traybar 1975: an aluminium strip under a tip weight, here across its flat side.
  constexpr double kWithin = 1e-3;  // relative
  constexpr int kElements = 80;
  constexpr double kL = 0.508, kWide = 12.3777e-3, kThick = 3.2024e-3, kE = 71.7e9, kNu = 0.31;
  constexpr double kG = kE / (2 * (1 + kNu));
  RodModel model;
  model.length = kL;
  model.elements = kElements;
  const double A = kWide * kThick;
  model.section.C_F = {5.0 / 6 * kG * A, 5.0 / 6 * kG * A, kE * A};
  // a1 along the thickness: bending about a2 is the soft one.
  model.section.C_M = {kE * kThick * std::pow(kWide, 3) / 12, kE * kWide * std::pow(kThick, 3) / 12,
                       kG * 0.281 * kWide * std::pow(kThick, 3)};
  model.section.V_F.setZero();
  model.section.V_M.setZero();
  model.section.rhoA = 1;
  model.section.rhoJ.setOnes();
  model.gravity.setZero();
  model.b = EndModel::Free();
  const double load[] = {13.345, 8.896}, target[] = {0.20068, 0.14625};
  for (int k = 0; k < 2; ++k) {
    Rod rod(model);
    rod.SetConfiguration(StraightShape(Pose{}, kL, kElements));
    const PointLoads force(kL, {{kL, {load[k], 0, 0}}});
    ASSERT_TRUE(rod.Equilibrate(&force).converged);
    Validate({"Statics", "Princeton beam, flat, " + Shown(load[k]) + " N: tip deflection [m]",
              "Dowell and Traybar 1975, geometrically exact solution", target[k],
              rod.pose(kElements).p.x(), kWithin * target[k], kElements});
  }
}

TEST(PublishedStatics, CollinearClampedArch) {
  constexpr double kWithin = 2e-3;  // relative
  constexpr int kElements = 80;
  const double shortening[] = {0.05, 0.1, 0.2, 0.3, 0.5};
  const double rise[] = {0.1401, 0.1949, 0.2663, 0.3143, 0.3733};
  const double force[] = {40.49, 41.57, 43.92, 46.61, 53.27};
  for (int k = 0; k < 5; ++k) {
    Rod rod(InextensibleRod(0.02, kElements));
    Pose b;
    b.p.z() = 1 - shortening[k];
    rod.SetConfiguration(BowedShape(Pose{}, b, 1.0, kElements, Vector3d::Zero()));
    ASSERT_TRUE(rod.Equilibrate().converged);
    const std::string name = "clamped arch, end shortening " + Shown(shortening[k]) + " L";
    const Vector3d middle = rod.pose(kElements / 2).p;
    Validate({"Statics", name + ": rise/L", "inextensible elastica", rise[k],
              std::hypot(middle.x(), middle.y()), kWithin * rise[k], kElements});
    Validate({"Statics", name + ": P L^2/EI", "inextensible elastica", force[k],
              rod.reaction_a().force.z() / 0.02, kWithin * force[k], kElements});
  }
}

}  // namespace
}  // namespace cosserat_cable::rod
