#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "cable/cable_text.h"

namespace cosserat_cable {
namespace {

TEST(CableFile, FillsInWhatWasNotMeasured) {
  const CableModel cable = LoadOne(kSpecimen);
  EXPECT_EQ(cable.name, "cable");
  EXPECT_EQ(cable.length, 0.2);
  EXPECT_EQ(cable.diameter, 0.008);
  EXPECT_EQ(cable.mass_per_length, 0.09);
  EXPECT_EQ(cable.EI1, 0.012);
  EXPECT_EQ(cable.EI2, 0.012);
  EXPECT_EQ(cable.GJ, 0.009);
  EXPECT_EQ(cable.eta_EI1, 2e-4);
  EXPECT_EQ(cable.eta_EI2, 2e-4);
  EXPECT_NEAR(cable.EA, 3000, 3000 * kSixDigits);  // 16 * 0.012/64e-6
  EXPECT_NEAR(cable.GA1, 1000, 1000 * kSixDigits);
  EXPECT_EQ(cable.GA1, cable.GA2);
  // rhoI = 0.09 * 64e-6/16 = 3.6e-7 kg m, rhoJ = 7.2e-7 kg m, 4 L/pi = 0.254647909 m
  EXPECT_NEAR(cable.rhoI(), 3.6e-7, 3.6e-7 * kSixDigits);
  EXPECT_NEAR(cable.rhoJ(), 7.2e-7, 7.2e-7 * kSixDigits);
  // 0.254647909 * sqrt(0.09 * 3000 = 270) = 0.254647909 * 16.4316767
  EXPECT_NEAR(cable.eta_EA, 4.18429212, 4.18429212 * kSixDigits);
  // 0.254647909 * sqrt(7.2e-7 * 0.009 = 6.48e-9) = 0.254647909 * 8.04984472e-5
  EXPECT_NEAR(cable.eta_GJ, 2.04987613e-5, 2.04987613e-5 * kSixDigits);
  // 2 * sqrt(3.6e-7 * 1000) = 2 * 0.0189736660
  EXPECT_NEAR(cable.eta_GA1, 0.0379473319, 0.0379473319 * kSixDigits);
  EXPECT_EQ(cable.eta_GA1, cable.eta_GA2);
  EXPECT_EQ(cable.apex_s, 0.1);
  EXPECT_EQ(cable.elements, 40);
  EXPECT_TRUE(cable.masses.empty());
  EXPECT_TRUE(cable.avoid.empty());
  EXPECT_TRUE(cable.uncertain.empty());
  // 96 * 0.012/0.04 + 98.1 * 0.09 * 0.2 = 30.57 N on 5 % of 4 mm, rounded up to two digits
  EXPECT_NEAR(cable.contact.stiffness, 1.6e5, 1.6e5 * kSixDigits);
}

TEST(CableFile, TakesAxialStiffnessFromTheSofterDirection) {
  const CableModel cable = LoadOne(Replaced(kSpecimen, "EI: 0.012", "EI1: 0.012\n  EI2: 0.008"));
  EXPECT_EQ(cable.EI1, 0.012);
  EXPECT_EQ(cable.EI2, 0.008);
  EXPECT_NEAR(cable.EA, 2000, 2000 * kSixDigits);  // 16 * 0.008/64e-6
  EXPECT_NEAR(cable.GA1, 2000 / 3.0, 2000 * kSixDigits);
}

TEST(CableFile, TakesEveryKeyThatIsGiven) {
  const CableModel cable = LoadOne(
      "format: 1\n"
      "cable:\n"
      "  name: wire\n"
      "  length: 0.2\n"
      "  diameter: 0.008\n"
      "  mass_per_length: 0.09\n"
      "  EI1: 0.012\n"
      "  EI2: 0.013\n"
      "  GJ: 0.009\n"
      "  EA: 2500\n"
      "  GA1: 1000\n"
      "  GA2: 1600\n"
      "  eta_EI1: 1e-4\n"
      "  eta_EI2: 2e-4\n"
      "  eta_GJ: critical\n"
      "  eta_EA: 3\n"
      "  eta_GA1: critical\n"
      "  eta_GA2: 0\n"
      "  masses: [{s: 0.1, mass: 0.002}, {s: 0.2, mass: 0.001}]\n"
      "  uncertain: [EI, eta_GJ, disc.inertia]\n"
      "  apex: {s: 0.05}\n"
      "  elements: 20\n"
      "  contact: {stiffness: 1e5, smoothing: 0, damping: 0}\n"
      "  extensions: {}\n");
  EXPECT_EQ(cable.name, "wire");
  EXPECT_EQ(cable.EI2, 0.013);
  EXPECT_EQ(cable.EA, 2500);
  EXPECT_EQ(cable.GA1, 1000);
  EXPECT_EQ(cable.GA2, 1600);
  EXPECT_EQ(cable.eta_EI1, 1e-4);
  EXPECT_EQ(cable.eta_EI2, 2e-4);
  EXPECT_NEAR(cable.eta_GJ, 2.04987613e-5, 2.04987613e-5 * kSixDigits);
  EXPECT_EQ(cable.eta_EA, 3);
  EXPECT_NEAR(cable.eta_GA1, 0.0379473319, 0.0379473319 * kSixDigits);
  EXPECT_EQ(cable.eta_GA2, 0);
  ASSERT_EQ(cable.masses.size(), 2u);
  EXPECT_EQ(cable.masses[1].s, 0.2);
  EXPECT_EQ(cable.masses[1].mass, 0.001);
  EXPECT_EQ(cable.uncertain, (std::vector<std::string>{"EI", "eta_GJ", "disc.inertia"}));
  EXPECT_EQ(cable.apex_s, 0.05);
  EXPECT_EQ(cable.elements, 20);
  EXPECT_EQ(cable.contact.stiffness, 1e5);
  EXPECT_EQ(cable.contact.smoothing, 0);
  EXPECT_EQ(cable.contact.damping, 0);
}

TEST(CableFile, AcceptsCablesFromBareWiresToSubmarineOnes) {
  EXPECT_EQ(Load("format: 1\n"
                 "cable: {length: 0.05, diameter: 0.0003, mass_per_length: 6.0e-4, EI: 4.0e-5, GJ: "
                 "3.0e-5, eta_EI: 0}\n")
                .said,
            "");
  EXPECT_EQ(Load("format: 1\n"
                 "cable: {length: 15, diameter: 0.16, mass_per_length: 45, EI: 5.0e+4, GJ: 4.0e+4, "
                 "eta_EI: 500}\n")
                .said,
            "");
}

// ---- Types, names, clamps -----------------------------------------------------------------------

TEST(CableFile, TakesFromATypeWhatACableDoesNotSay) {
  const Loaded loaded = Load(Vehicle(std::string("  - name: one\n    type: hose\n") + kClamps +
                                     "  - name: two\n    type: hose\n    EI1: 0.01\n    EI2: 0.02\n"
                                     "    length: 0.4\n    reference: world\n    avoid: [arm]\n" +
                                     kClamps));
  ASSERT_EQ(loaded.said, "");
  ASSERT_EQ(loaded.file.cables.size(), 2u);
  EXPECT_FALSE(loaded.file.specimen);
  const CableModel& one = loaded.file.cables[0];
  const CableModel& two = loaded.file.cables[1];
  EXPECT_EQ(one.EI1, 0.012);
  EXPECT_EQ(one.reference, "body");
  EXPECT_EQ(one.a.link, "body");
  EXPECT_EQ(one.b.link, "wheel");
  EXPECT_EQ(one.b.X_LC.p, Eigen::Vector3d(0, 0, 0.1));
  EXPECT_EQ(two.EI1, 0.01);
  EXPECT_EQ(two.EI2, 0.02);
  EXPECT_EQ(two.length, 0.4);
  EXPECT_EQ(two.apex_s, 0.2);
  EXPECT_EQ(two.mass_per_length, 0.09);
  EXPECT_EQ(two.reference, "world");
  EXPECT_EQ(two.avoid, std::vector<std::string>{"arm"});
  // The default depends on the cable's own length, not on its type's.
  EXPECT_NEAR(two.eta_EA / two.length / std::sqrt(two.EA),
              one.eta_EA / one.length / std::sqrt(one.EA), kSixDigits);
}

TEST(CableFile, TakesVisualGeometryByLinkOrByCable) {
  using Links = std::set<std::string>;
  const auto visual = [](const std::string& lines) {
    return Load(Vehicle(std::string("  - name: one\n    type: hose\n") + kClamps + lines))
        .file.cables.at(0)
        .avoid_visual;
  };
  const std::string some = "    avoid: [arm, {link: rim, use_visual: true}, {link: hub}]\n";
  EXPECT_EQ(visual(some), Links({"rim"}));
  EXPECT_EQ(visual(some + "    use_visual: false\n"), Links({"rim"}));
  EXPECT_EQ(visual(some + "    use_visual: true\n"), Links({"arm", "rim", "hub"}));
  EXPECT_EQ(visual("    use_visual: true\n    avoid: [arm, {link: rim, use_visual: false}]\n"),
            Links({"arm"}));
}

TEST(CableFile, ContactOfATypeLeavesTheStiffnessToTheCable) {
  const std::string text =
      Replaced(Vehicle(std::string("  - name: one\n    type: hose\n") + kClamps), "eta_EI: 2.0e-4",
               "eta_EI: 2.0e-4, contact: {damping: 0}");
  const CableModel cable = Load(text).file.cables.at(0);
  EXPECT_EQ(cable.contact.damping, 0);
  EXPECT_NEAR(cable.contact.stiffness, 1.6e5, 1.6e5 * kSixDigits);  // as in FillsIn...
}

TEST(CableFile, ReportsTypesThatAreNotThere) {
  EXPECT_EQ(Load(Vehicle(std::string("  - name: one\n    type: hoes\n") + kClamps)).said,
            "f:6: cables[0].type: got 'hoes', expected one of hose: did you mean 'hose'?\n");
  EXPECT_EQ(SaidWith("  type: hose\n"),
            "f:9: cable.type: got 'hose', expected none: the file has no `types`\n");
}

TEST(CableFile, ReportsMistakesInTypesOnceAndAlsoWhereNoCableUsesThem) {
  const std::string text = Vehicle(std::string("  - name: one\n    type: hose\n") + kClamps +
                                   "  - name: two\n    type: hose\n" + kClamps);
  EXPECT_EQ(Load(Replaced(text, "EI: 0.012", "EI: -1")).said,
            "f:3: types.hose.EI: got -1, expected a number in (0, 100000] [N m^2]\n");
  EXPECT_EQ(Load(Replaced(text, "eta_EI: 2.0e-4", "eta_EI: null")).said,
            "f:3: types.hose.eta_EI: got nothing (unknown), expected a number: a simulation needs "
            "one\n");
  EXPECT_EQ(Load(Replaced(text, "types:\n", "types:\n  unused: {lenght: 1}\n")).said,
            "f:3: types.unused.lenght: got an unknown key, did you mean 'length'?\n");
}

TEST(CableFile, ReportsNamesThatClashOrAreNone) {
  EXPECT_EQ(
      Load(Vehicle(std::string("  - name: one\n    type: hose\n") + kClamps +
                   "  - name: one\n    type: hose\n" + kClamps))
          .said,
      "f:9: cables[1].name: got 'one', expected a name of its own: the cable on line 5 has it\n");
  EXPECT_EQ(Load(Vehicle(std::string("  - name: brake/hose\n    type: hose\n") + kClamps)).said,
            "f:5: cables[0].name: got 'brake/hose', expected a name of letters, digits and "
            "underscores that starts with a letter\n");
  EXPECT_EQ(Load(Vehicle(std::string("  - type: hose\n") + kClamps)).said,
            "f:5: cables[0].name: missing, expected a name of letters, digits and underscores that "
            "starts with a letter\n");
}

TEST(CableFile, ReportsClampsThatAreWrong) {
  EXPECT_EQ(Load(Vehicle("  - name: one\n    type: hose\n")).said,
            "f:5: cables[0].a: missing, expected a clamp {link: ..., pose: [...]}\n"
            "f:5: cables[0].b: missing, expected a clamp {link: ..., pose: [...]}\n");
  EXPECT_EQ(
      Load(Vehicle("  - name: one\n    type: hose\n"
                   "    a: {link: body, pose: [0, 0, 0, 0, 0, 0, 0]}\n"
                   "    b: {lnk: wheel}\n"))
          .said,
      "f:7: cables[0].a.pose: got a quaternion of length 0, expected unit length within 0.001\n"
      "f:8: cables[0].b.link: missing, expected the name of a link\n"
      "f:8: cables[0].b.pose: missing, expected a pose [x, y, z, qx, qy, qz, qw] in metres\n"
      "f:8: cables[0].b.lnk: got an unknown key, did you mean 'link'?\n");
  EXPECT_EQ(SaidWith("  a: {link: body, pose: [0, 0, 0, 0, 0, 0, 1]}\n"),
            "f:2: cable.b: missing, expected a clamp {link: ..., pose: [...]}\n");
}

TEST(CableFile, ReportsClampsOnOneLinkThatAreTooFarApart) {
  const std::string far =
      "    a: {link: body, pose: [0, 0, 0, 0, 0, 0, 1]}\n"
      "    b: {link: body, pose: [0, 0, 0.25, 0, 0, 0, 1]}\n";
  EXPECT_EQ(
      Load(Vehicle("  - name: one\n    type: hose\n" + far)).said,
      "f:5: cables[0]: got clamps 0.25 m apart, expected at most the cable's length, 0.2 m\n");
  EXPECT_EQ(Load(Vehicle("  - name: one\n    type: hose\n" + Replaced(far, "0.25", "0.2"))).said,
            "");
}

// ---- Mistakes in one key ------------------------------------------------------------------------

TEST(CableFile, ReportsSlipsOfUnits) {
  EXPECT_EQ(Said("length: 0.2", "length: 200"),
            "f:3: cable.length: got 200, expected a number in (0, 20] [m]: is it in mm?\n");
  EXPECT_EQ(Said("diameter: 0.008", "diameter: 8"),
            "f:4: cable.diameter: got 8, expected a number in (0, 0.2] [m]: is it in mm?\n");
  EXPECT_EQ(
      Said("mass_per_length: 0.09", "mass_per_length: 90"),
      "f:5: cable.mass_per_length: got 90, expected a number in (0, 50] [kg/m]: is it in g/m?\n");
  EXPECT_EQ(
      Said("mass_per_length: 0.09", "mass_per_length: 30"),
      "f:5: cable.mass_per_length: got 30, expected at most 10.1 [kg/m], ten times a bar of the "
      "densest metal: is it in g/m?\n");
  EXPECT_EQ(
      Said("EI: 0.012", "EI: 2.0e+5"),
      "f:6: cable.EI: got 2.0e+5, expected a number in (0, 100000] [N m^2]: is it in N mm^2?\n");
  EXPECT_EQ(Said("EI: 0.012", "EI: 12000"),
            "f:6: cable.EI: got 12000, expected at most 1010 [N m^2], four times a bar of diamond: "
            "is it in N mm^2?\n");
  EXPECT_EQ(Said("GJ: 0.009", "GJ: 9000"),
            "f:7: cable.GJ: got 9000, expected at most 1010 [N m^2], four times a bar of diamond: "
            "is it in N mm^2?\n");
}

TEST(CableFile, ReportsNumbersThatAreNoneOrOutOfRange) {
  EXPECT_EQ(Said("length: 0.2", "length: 0"),
            "f:3: cable.length: got 0, expected a number in (0, 20] [m]\n");
  EXPECT_EQ(Said("EI: 0.012", "EI: nan"),
            "f:6: cable.EI: got nan, expected a number in (0, 100000] [N m^2]\n");
  EXPECT_EQ(Said("EI: 0.012", "EI: soft"),
            "f:6: cable.EI: got 'soft', expected a number in (0, 100000] [N m^2]\n");
  EXPECT_EQ(Said("eta_EI: 2.0e-4", "eta_EI: -1"),
            "f:8: cable.eta_EI: got -1, expected a number >= 0 [N m^2 s]\n");
  EXPECT_EQ(SaidWith("  eta_EA: much\n"),
            "f:9: cable.eta_EA: got 'much', expected a number >= 0 [N s] or 'critical'\n");
  EXPECT_EQ(SaidWith("  EA: 0\n"), "f:9: cable.EA: got 0, expected a number in (0, 1e+10] [N]\n");
  EXPECT_EQ(SaidWith("  elements: 3\n"),
            "f:9: cable.elements: got 3, expected a whole number in [4, 1000]\n");
  EXPECT_EQ(SaidWith("  elements: 12.5\n"),
            "f:9: cable.elements: got 12.5, expected a whole number in [4, 1000]\n");
  EXPECT_EQ(SaidWith("  contact: {stiffness: -1, stifness: 2}\n"),
            "f:9: cable.contact.stiffness: got -1, expected a number in (0, 1e+09] [N/m]\n"
            "f:9: cable.contact.stifness: got an unknown key, did you mean 'stiffness'?\n");
}

TEST(CableFile, ReportsWhatLiesBeyondTheCable) {
  EXPECT_EQ(Said("diameter: 0.008", "diameter: 0.15"),
            "f:4: cable.diameter: got 0.15, expected at most 0.1 [m], half the length\n");
  EXPECT_EQ(SaidWith("  apex: {s: 0.21}\n"),
            "f:9: cable.apex.s: got 0.21, expected at most 0.2 [m], the length\n");
  EXPECT_EQ(SaidWith("  masses:\n    - {s: 0.1, mass: 0.1}\n    - {s: 0.3, mass: 0.1}\n"),
            "f:11: cable.masses[1].s: got 0.3, expected at most 0.2 [m], the length\n");
  EXPECT_EQ(
      SaidWith("  masses: [{s: 100, mass: 200}]\n"),
      "f:9: cable.masses[0].s: got 100, expected a number in [0, 20] [m]: is it in mm?\n"
      "f:9: cable.masses[0].mass: got 200, expected a number in (0, 100] [kg]: is it in g?\n");
  EXPECT_EQ(SaidWith("  masses: 3\n"),
            "f:9: cable.masses: got 3, expected a list of masses {s: ..., mass: ...}\n");
}

TEST(CableFile, ReportsUnknownDampingAndCriticalBending) {
  EXPECT_EQ(
      Said("eta_EI: 2.0e-4", "eta_EI: null"),
      "f:8: cable.eta_EI: got nothing (unknown), expected a number: a simulation needs one\n");
  EXPECT_EQ(
      SaidWith("  eta_GJ: null\n"),
      "f:9: cable.eta_GJ: got nothing (unknown), expected a number: a simulation needs one\n");
  EXPECT_EQ(
      Said("eta_EI: 2.0e-4", "eta_EI: critical"),
      "f:8: cable.eta_EI: got 'critical', expected a number >= 0 [N m^2 s]: eq. (10) gives no "
      "critical damping in bending\n");
}

TEST(CableFile, ReportsPairsThatAreHalfOrDouble) {
  EXPECT_EQ(SaidWith("  EI1: 0.01\n"),
            "f:9: cable.EI1: got this beside EI, expected either EI, or EI1 and EI2\n");
  EXPECT_EQ(Said("EI: 0.012", "EI2: 0.012"),
            "f:6: cable.EI2: got this alone, expected EI1 and EI2, or EI\n");
  EXPECT_EQ(SaidWith("  eta_GA1: 0.01\n"),
            "f:9: cable.eta_GA1: got this alone, expected eta_GA1 and eta_GA2, or eta_GA\n");
}

TEST(CableFile, ReportsUncertainAndAvoidThatNameNothingKnown) {
  EXPECT_EQ(SaidWith("  uncertain: [EI, name]\n")
                .rfind("f:9: cable.uncertain[1]: got 'name', expected one of length, diameter, "
                       "width, height, ",
                       0),
            0u);
  EXPECT_EQ(SaidWith("  uncertain: EI\n"),
            "f:9: cable.uncertain: got 'EI', expected a list of the names of numeric keys\n");
  EXPECT_EQ(SaidWith("  avoid: [arm, wheel, arm]\n"),
            "f:9: cable.avoid[2]: got 'arm' twice, expected it once\n");
  EXPECT_EQ(SaidWith("  avoid: [arm, {link: arm, use_visual: true}]\n"),
            "f:9: cable.avoid[1]: got 'arm' twice, expected it once\n");
  EXPECT_EQ(SaidWith("  avoid: [{link: arm, use_visaul: true}]\n"),
            "f:9: cable.avoid[0].use_visaul: got an unknown key, did you mean 'use_visual'?\n");
  EXPECT_EQ(SaidWith("  use_visual: 1\n"),
            "f:9: cable.use_visual: got 1, expected true or false\n");
  EXPECT_EQ(SaidWith("  avoid: arm\n"), "f:9: cable.avoid: got 'arm', expected a list of links\n");
}

TEST(CableFile, ReportsWhatShouldBeMaps) {
  EXPECT_EQ(SaidWith("  apex: 0.1\n"), "f:9: cable.apex: got 0.1, expected a point {s: ...}\n");
  EXPECT_EQ(SaidWith("  masses: [0.1]\n"),
            "f:9: cable.masses[0]: got 0.1, expected a mass {s: ..., mass: ...}\n");
  EXPECT_EQ(
      SaidWith("  contact: hard\n"),
      "f:9: cable.contact: got 'hard', expected a law {stiffness: ..., smoothing: ..., damping: "
      "...}\n");
  EXPECT_EQ(SaidWith("types: [hose]\n"),
            "f:9: types: got a list of 1, expected a map of types by name\n");
  EXPECT_EQ(SaidWith("types: {hose: 3}\n"),
            "f:9: types.hose: got 3, expected a map of a cable's keys\n");
}

TEST(CableFile, ReportsKeysThatAreUnknownTwiceThereOrMissing) {
  EXPECT_EQ(Said("mass_per_length", "mass_per_lenght"),
            "f:2: cable.mass_per_length: missing, expected a number in (0, 50] [kg/m]\n"
            "f:5: cable.mass_per_lenght: got an unknown key, did you mean 'mass_per_length'?\n");
  EXPECT_EQ(SaidWith("  length: 0.3\n"),
            "f:9: cable.length: got this key a second time, expected it once: it stands on line 3 "
            "already\n");
  EXPECT_EQ(
      Load("format: 1\ncable: {}\n").said,
      "f:2: cable.length: missing, expected a number in (0, 20] [m]\n"
      "f:2: cable.diameter: missing, expected a number in (0, 0.2] [m], or width and height\n"
      "f:2: cable.mass_per_length: missing, expected a number in (0, 50] [kg/m]\n"
      "f:2: cable.EI: missing, expected a number in (0, 100000] [N m^2], or EI1 and EI2\n"
      "f:2: cable.GJ: missing, expected a number in (0, 100000] [N m^2]\n"
      "f:2: cable.eta_EI: missing, expected a number >= 0 [N m^2 s], or eta_EI1 and eta_EI2\n");
}

// ---- Mistakes in the file -----------------------------------------------------------------------

TEST(CableFile, RequiresItsFormat) {
  const std::string expected = "expected 1, the version of the schema that is read here\n";
  EXPECT_EQ(Said("format: 1\n", "\n"), "f:2: format: missing, " + expected);
  EXPECT_EQ(Said("format: 1", "format: 2"), "f:1: format: got 2, " + expected);
}

TEST(CableFile, RequiresOneKindOfCables) {
  EXPECT_EQ(Load("format: 1\n").said,
            "f:1: cables: missing, expected `cables` (a list) or `cable` (one specimen)\n");
  EXPECT_EQ(Load("format: 1\ncables: []\n").said,
            "f:2: cables: got a list of 0, expected a list of at least one cable\n");
  EXPECT_EQ(Load("format: 1\ncables: {name: x}\n").said,
            "f:2: cables: got a map, expected a list of at least one cable\n");
  EXPECT_EQ(Load("format: 1\ncables: [hose]\n").said,
            "f:2: cables[0]: got 'hose', expected a map of a cable's keys\n");
  EXPECT_EQ(Load(std::string(kSpecimen) +
                 "cables:\n  - name: one\n    length: 0.2\n    diameter: 0.008\n"
                 "    mass_per_length: 0.09\n    EI: 0.012\n    GJ: 0.009\n"
                 "    eta_EI: 0\n" +
                 kClamps)
                .said,
            "f:9: cables: got this beside `cable`, expected either `cable` or `cables`\n");
  EXPECT_EQ(Load(std::string(kSpecimen) + "cabels: []\n").said,
            "f:9: cabels: got an unknown key, did you mean 'cables'?\n");
}

TEST(CableFile, ReportsFilesThatCannotBeRead) {
  Problems problems;
  LoadCableFile("/nowhere/cable.yaml", &problems);
  LoadCableFile("/tmp", &problems);
  EXPECT_EQ(problems.ToString(),
            "/nowhere/cable.yaml: cannot be read: No such file or directory\n"
            "/tmp: got a directory, expected a YAML file\n");
  EXPECT_EQ(Load("").said, "f:1: got an empty file, expected a YAML document\n");
  EXPECT_EQ(Load("- 1\n").said, "f:1: got a list of 1, expected a map of keys\n");
  EXPECT_EQ(Load("format: 1\ncable: {length: 0.2\n").said.rfind("f:", 0), 0u);
}

TEST(CableFile, ReportsEverythingAtOnceInTheOrderOfLines) {
  EXPECT_EQ(
      Load("format: 1\n"
           "cables:\n"
           "  - name: one\n"
           "    length: 200\n"
           "    diametre: 0.008\n"
           "    mass_per_length: .inf\n"
           "    a: {link: body, pose: [0, 0, 0, 0, 0, 0]}\n"
           "    EI: 0.012\n"
           "    GJ: [0.009]\n"
           "    eta_EI: 2e-4\n"
           "    b: {link: wheel, pose: [0, 0, 0, 0, 0, 0, 2]}\n"
           "    EI: 0.013\n"
           "  - name: one\n"
           "    elements: few\n"
           "colour: red\n")
          .said,
      "f:3: cables[0].diameter: missing, expected a number in (0, 0.2] [m], or width and height\n"
      "f:4: cables[0].length: got 200, expected a number in (0, 20] [m]: is it in mm?\n"
      "f:5: cables[0].diametre: got an unknown key, did you mean 'diameter'?\n"
      "f:6: cables[0].mass_per_length: got .inf, expected a number in (0, 50] [kg/m]\n"
      "f:7: cables[0].a.pose: got a list of 6, expected a pose [x, y, z, qx, qy, qz, qw] in "
      "metres\n"
      "f:9: cables[0].GJ: got a list of 1, expected a number in (0, 100000] [N m^2]\n"
      "f:11: cables[0].b.pose: got a quaternion of length 2, expected unit length within 0.001\n"
      "f:12: cables[0].EI: got this key a second time, expected it once: it stands on line 8 "
      "already\n"
      "f:13: cables[1].length: missing, expected a number in (0, 20] [m]\n"
      "f:13: cables[1].diameter: missing, expected a number in (0, 0.2] [m], or width and height\n"
      "f:13: cables[1].mass_per_length: missing, expected a number in (0, 50] [kg/m]\n"
      "f:13: cables[1].EI: missing, expected a number in (0, 100000] [N m^2], or EI1 and EI2\n"
      "f:13: cables[1].GJ: missing, expected a number in (0, 100000] [N m^2]\n"
      "f:13: cables[1].eta_EI: missing, expected a number >= 0 [N m^2 s], or eta_EI1 and "
      "eta_EI2\n"
      "f:13: cables[1].name: got 'one', expected a name of its own: the cable on line 3 has it\n"
      "f:13: cables[1].a: missing, expected a clamp {link: ..., pose: [...]}\n"
      "f:13: cables[1].b: missing, expected a clamp {link: ..., pose: [...]}\n"
      "f:14: cables[1].elements: got 'few', expected a whole number in [4, 1000]\n"
      "f:15: colour: got an unknown key, expected one of format, types, cable, cables\n");
}

// ---- Against the vehicle ------------------------------------------------------------------------

TEST(CheckAgainstVehicle, NamesTheLineAndTheNearestLink) {
  const TemporaryFile yaml(
      Vehicle("  - name: one\n"
              "    type: hose\n"
              "    a: {link: /body, pose: [0, 0, 0, 0, 0, 0, 1]}\n"
              "    b: {link: fl_whel, pose: [0, 0, 0, 0, 0, 0, 1]}\n"
              "    avoid: [fl_wheel,\n"
              "            chassis]\n"
              "  - name: two\n"
              "    reference: wrld\n"
              "    type: hose\n" +
              std::string(kClamps)));
  Problems problems;
  const CableFile file = LoadCableFile(yaml.path(), &problems);
  ASSERT_TRUE(problems.empty()) << problems.ToString();
  CheckAgainstVehicle(file, {"world", "body", "wheel", "fl_wheel"}, &problems);
  const std::string f = yaml.path();
  EXPECT_EQ(
      problems.ToString(),
      f +
          ":7: cables[0].a.link: got '/body', expected a link of the vehicle: did you mean "
          "'body'?\n" +
          f +
          ":8: cables[0].b.link: got 'fl_whel', expected a link of the vehicle: did you mean "
          "'fl_wheel'?\n" +
          f + ":10: cables[0].avoid[1]: got 'chassis', expected a link of the vehicle\n" + f +
          ":12: cables[1].reference: got 'wrld', expected a link of the vehicle: did you mean "
          "'world'?\n");
}

TEST(CheckAgainstVehicle, RefusesASpecimenWithoutClamps) {
  const Loaded loaded = Load(kSpecimen);
  Problems problems;
  CheckAgainstVehicle(loaded.file, {"body"}, &problems);
  ASSERT_EQ(problems.all().size(), 1u);
  EXPECT_EQ(problems.all()[0].line, 2);
  EXPECT_EQ(problems.all()[0].key, "cable");
}

// ---- Writing ------------------------------------------------------------------------------------

}  // namespace
}  // namespace cosserat_cable
