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

TEST(OutsideKeys, ToldThatAnUncertainNumberHasNoExtension) {
  EXPECT_EQ(SaidWith("  uncertain: [extensions.clamp_compliance.b.bending]\n"),
            "f:9: cable.uncertain[0]: got 'extensions.clamp_compliance.b.bending' of an extension "
            "that the cable does not have, expected it under `extensions`: its numbers are where "
            "the search begins\n");
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
