// Mistakes in the keys of causes at the clamps and around the cable.
#include "cable/cable_text.h"

namespace cosserat_cable {
namespace {

TEST(OutsideKeys, ReportWrongKeys) {
  EXPECT_EQ(SaidWith("  extensions:\n"
                     "    clamp_friction:\n"
                     "      a: {stuck: 1, spring: -1}\n"
                     "    clamp_play: {}\n"
                     "    air_drag: {cd: 1}\n"
                     "    external_damping: 3\n"
                     "    added_mass: {s: 0.3, mass: 1}\n"),
            "f:11: cable.extensions.clamp_friction.a.slip_moment: missing, expected a number in "
            "[0, 1e+06] [N m]\n"
            "f:11: cable.extensions.clamp_friction.a.spring: got -1, expected a number in [0, "
            "1e+09] [N m/rad]\n"
            "f:12: cable.extensions.clamp_play: got nothing that acts, expected at least one of a, "
            "b\n"
            "f:13: cable.extensions.air_drag.Cd: missing, expected a number in [0, 1000]\n"
            "f:13: cable.extensions.air_drag.cd: got an unknown key, did you mean 'Cd'?\n"
            "f:14: cable.extensions.external_damping: got 3, expected a rate {rate: ...}\n"
            "f:15: cable.extensions.added_mass.s: got 0.3, expected an arc length on the cable, at "
            "most 0.2 m\n");
}

TEST(OutsideKeys, ReportAWrongObstacle) {
  EXPECT_EQ(SaidWith("  extensions: {contact: {stiffness: 5}}\n"),
            "f:9: cable.extensions.contact: got nothing that acts, expected at least one of plane, "
            "peg\n");
  EXPECT_EQ(SaidWith("  extensions:\n"
                     "    contact: {plane: {azimuth: 1, elevation: 90, offset: -1}}\n"),
            "f:10: cable.extensions.contact.plane.elevation: got 90, expected a number in [-7, 7] "
            "[rad]: is it in degrees?\n");
  EXPECT_EQ(SaidWith("  extensions:\n"
                     "    contact:\n"
                     "      plane: {azimuth: 1, elevation: 0, offset: -0.1}\n"
                     "      peg: {x: 0, y: 0, z: 0, azimuth: 0, elevation: 0, radius: 0.1}\n"),
            "f:10: cable.extensions.contact: got a plane and a peg, expected one of them\n");
}

TEST(OutsideKeys, ToldWhereFaultsOfARecordBelong) {
  EXPECT_EQ(SaidWith("  extensions:\n"
                     "    clock: {delay: 0.1}\n"
                     "    faults: {sensor: []}\n"),
            "f:10: cable.extensions.clock: got a fault of a record among the cable's extensions, "
            "expected it in a measurement set (measurement.yaml): `faults: {clock: ...}` beside "
            "its `cable`, or in one experiment\n"
            "f:11: cable.extensions.faults: got faults of a record, expected them in a measurement "
            "set (measurement.yaml): beside its `cable`, or of one experiment\n");
}

TEST(OutsideKeys, ToldHowToWriteAnExtensionThatAnUncertainNumberNeeds) {
  const auto said = [](const std::string& names) {
    return SaidWith("  uncertain: [" + names + "]\n");
  };
  const std::string begin = "f:9: cable.uncertain[0]: got ",
                    why =
                        " of an extension that the cable does not have, expected it under "
                        "`extensions`: its numbers are where the search begins, such as "
                        "`extensions: {";
  for (const auto& [name, entry] :
       {std::pair<const char*, const char*>{"extensions.added_mass.mass", "added_mass: {s: "},
        {"extensions.contact.plane.offset", "contact: {plane: {azimuth: "},
        {"extensions.clamp_play.b.gap", "clamp_play: {b: {gap: "},
        {"extensions.section_friction.EI", "section_friction: {EI: "}}) {
    const std::string text = said(name);
    EXPECT_EQ(text.rfind(begin + "'" + name + "'" + why + entry, 0), 0u) << text;
    // What is shown can be read, as it stands.
    const std::size_t from = text.find("extensions: {");
    const std::size_t to = text.find("}`");
    ASSERT_NE(to, std::string::npos) << text;
    EXPECT_EQ(SaidWith("  uncertain: [" + std::string(name) + "]\n  " +
                       text.substr(from, to + 1 - from) + "\n"),
              "");
  }
}

TEST(OutsideKeys, AnUncertainExtensionThatIsNotThereBeginsWhereASizeWillDo) {
  for (const char* names :
       {"extensions.clamp_compliance.b.bending", "extensions.external_damping.rate",
        "extensions.air_drag.Cd", "extensions.rest_curvature.k1",
        "extensions.structural_damping.loss_factor", "extensions.bend_twist_coupling.c1",
        "extensions.anisotropy.difference", "'extensions.maxwell[0].EI'",
        "'extensions.maxwell[0].tau', 'extensions.maxwell[0].EI'",
        "extensions.section_friction.EI, extensions.section_friction.slip_curvature",
        "extensions.clamp_friction.a.stuck, extensions.clamp_friction.a.slip_moment, "
        "extensions.clamp_friction.a.spring"})
    EXPECT_EQ(SaidWith(std::string("  uncertain: [") + names + "]\n"), "") << names;
}

TEST(OutsideKeys, LetAClampTurnThatHasADashpot) {
  EXPECT_EQ(SaidWith("  extensions:\n"
                     "    clamp_damping: {a: {bending: 1e-4}, b: {bending: 1e-4}}\n"
                     "    clamp_friction: {a: {stuck: 1, slip_moment: 1, spring: 1}}\n"
                     "    clamp_play: {b: {gap: 0.1, stiffness: 1}}\n"),
            "");
}

}  // namespace
}  // namespace cosserat_cable
