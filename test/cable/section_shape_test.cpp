// Flat sections: what follows from width and height, and what is said of wrong ones.
#include <gtest/gtest.h>

#include <cmath>

#include "cable_text.h"
#include "cosserat_cable/cable/cable_keys.h"
#include "cosserat_cable/cable/cable_rod.h"
#include "cosserat_cable/cable/contact_stiffness.h"

namespace cosserat_cable {
namespace {

// A steel strip, 30 mm along a1 and 3 mm along a2: E = 2.1e11 Pa, rho = 7850 kg/m^3.
constexpr double kE = 2.1e11, kWidth = 0.03, kHeight = 0.003;
const char* const kStrip =
    "format: 1\ncable:\n  length: 1\n  width: 0.03\n  height: 0.003\n  mass_per_length: 0.7065\n"
    "  EI1: 14.175\n  EI2: 1417.5\n  GJ: 20\n  eta_EI: 1.0e-3\n";
constexpr double kRelative = 1e-12;

TEST(FlatSection, HasTheInertiaAndTheStiffnessOfARectangle) {
  const CableModel strip = LoadOne(kStrip);
  EXPECT_EQ(strip.width, kWidth);
  EXPECT_EQ(strip.height, kHeight);
  EXPECT_EQ(strip.diameter, kWidth) << "what it touches with";
  const double rho = 7850;
  const double I1 = kWidth * std::pow(kHeight, 3) / 12, I2 = kHeight * std::pow(kWidth, 3) / 12;
  EXPECT_NEAR(strip.rhoI1(), rho * I1, kRelative);
  EXPECT_NEAR(strip.rhoI2(), rho * I2, kRelative);
  EXPECT_NEAR(strip.rhoJ(), rho * (I1 + I2), kRelative);
  // EA = E A; by either direction.
  const double EA = kE * kWidth * kHeight;
  EXPECT_NEAR(strip.EA, EA, kRelative * EA);
  EXPECT_NEAR(strip.eta_GJ, 4 / M_PI * std::sqrt(rho * (I1 + I2) * 20), kRelative);
  // Shear along a1 goes with bending about a2.
  EXPECT_NEAR(strip.eta_GA1, 2 * std::sqrt(rho * I2 * EA / 3), kRelative * strip.eta_GA1);
  EXPECT_NEAR(strip.eta_GA2, 2 * std::sqrt(rho * I1 * EA / 3), kRelative * strip.eta_GA2);
  const rod::RodModel rod = MakeRodModel(strip, Eigen::Vector3d::Zero());
  EXPECT_EQ(rod.section.rhoJ, Eigen::Vector3d(strip.rhoI1(), strip.rhoI2(), strip.rhoJ()));
}

TEST(FlatSection, IsWrittenAndReadBack) {
  const Loaded loaded = Load(kStrip);
  const std::string text = WriteCableFile(loaded.file);
  EXPECT_EQ(text.find("diameter"), std::string::npos);
  EXPECT_EQ(WriteCableFile(Load(text).file), text);
  EXPECT_EQ(LoadOne(text).rhoI2(), LoadOne(kStrip).rhoI2());
}

std::string SaidOfStrip(const std::string& what, const std::string& by) {
  return Load(Replaced(kStrip, what, by)).said;
}

TEST(FlatSection, MistakesAreNamed) {
  EXPECT_EQ(SaidOfStrip("  height: 0.003\n", ""),
            "f:2: cable.height: missing, expected a number in (0, 0.2] [m]\n"
            "f:4: cable.width: got this alone, expected width and height, or diameter\n");
  EXPECT_EQ(SaidOfStrip("  height: 0.003\n", "  height: 0.003\n  diameter: 0.01\n"),
            "f:4: cable.width: got this beside diameter, expected either diameter, or width and "
            "height\n");
  EXPECT_EQ(SaidOfStrip("width: 0.03", "width: 30"),
            "f:4: cable.width: got 30, expected a number in (0, 0.2] [m]: is it in mm?\n");
  EXPECT_EQ(SaidOfStrip("length: 1", "length: 0.05"),
            "f:4: cable.width: got 0.03, expected at most 0.025 [m], half the length\n");
  // 5e12 Pa w h^3/12 = 337.5 N m^2 about a1, 33750 N m^2 about a2.
  EXPECT_EQ(SaidOfStrip("EI1: 14.175", "EI1: 400"),
            "f:7: cable.EI1: got 400, expected at most 337 [N m^2], four times a bar of diamond: "
            "is it in N mm^2?\n");
  EXPECT_EQ(SaidOfStrip("EI2: 1417.5", "EI2: 40000"),
            "f:8: cable.EI2: got 40000, expected at most 33700 [N m^2], four times a bar of "
            "diamond: is it in N mm^2?\n");
}

TEST(FlatSection, OfARoundOnesBoundIsAskedFor) {
  EXPECT_EQ(SaidOfStrip("  width: 0.03\n  height: 0.003\n", "  diameter: 0.003\n"),
            "f:7: cable.EI2: got 1417.5, expected at most 19.9 [N m^2], four times a bar of "
            "diamond: is it in N mm^2? Is the section flat (width and height)?\n"
            "f:8: cable.GJ: got 20, expected at most 19.9 [N m^2], four times a bar of diamond: "
            "is it in N mm^2?\n");
}

TEST(FlatSection, OfATypeGivesWayToADiameterOfItsOwn) {
  CableKeys own, type;
  own.diameter = {0.01, {"f", 3, "diameter"}};
  type.width = {0.03, {"f", 1, "width"}};
  type.height = {0.003, {"f", 2, "height"}};
  own.FillFrom(type);
  EXPECT_FALSE(own.width.given());
  EXPECT_EQ(ShapeOf(own)->diameter, 0.01);
  CableKeys none;
  none.FillFrom(type);
  EXPECT_TRUE(ShapeOf(none)->flat());
}

TEST(RecordsOwn, AreRefusedInACableFile) {
  EXPECT_EQ(Load(std::string(kSpecimen) + "  faults: {clock: {scale: 0.1}}\n").said,
            "f:9: cable.faults: got faults of a record, expected them in a measurement set "
            "(measurement.yaml): beside its `cable`, or of one experiment\n");
  EXPECT_EQ(Load(std::string(kSpecimen) + "faults: {}\n").said,
            "f:9: faults: got faults of a record, expected them in a measurement set "
            "(measurement.yaml): beside its `cable`, or of one experiment\n");
  EXPECT_EQ(Load(std::string(kSpecimen) + "  uncertain: [faults.clock.scale]\n").said,
            "f:9: cable.uncertain[0]: got 'faults.clock.scale', a fault of a record, expected it "
            "in the `uncertain` of a measurement set\n");
  const std::string type =
      Replaced(Vehicle(""), "eta_EI: 2.0e-4", "eta_EI: 2.0e-4, extensions: {drift: {EI: 0.1}}");
  const std::string said = Load(type + "  - name: one\n    type: hose\n" + kClamps).said;
  EXPECT_NE(said.find("got drift, a change over the time of a record, of a vehicle's cable, "
                      "expected it in the `cable` of a measurement set (measurement.yaml)"),
            std::string::npos)
      << said;
  EXPECT_EQ(Load(std::string(kSpecimen) + "  extensions: {drift: {EI: 0.1}}\n").said, "");
  EXPECT_EQ(Load(std::string(kSpecimen) + "  extensions: {drift: {GJ: -1}}\n").said,
            "f:9: cable.extensions.drift.GJ: got -1, expected a number in (-1, 100]\n");
}

}  // namespace
}  // namespace cosserat_cable
