// Every mistake in a set is named with its file, line and key.
#include <gtest/gtest.h>

#include <algorithm>

#include "measurement/set_folder.h"

namespace cosserat_cable {
namespace {

// What is said where one piece of measurement.yaml is another.
std::string Said(const std::string& what, const std::string& by) {
  SetFolder folder;
  WriteAll(&folder, Replaced(AllSets(), what, by));
  return folder.Said();
}

// What is said where a file holds something else.
std::string SaidOf(const std::string& file, const std::string& text) {
  SetFolder folder;
  WriteAll(&folder, AllSets());
  folder.Write(file, text);
  return folder.Said();
}

const std::string kYaml = "measurement.yaml:";

TEST(SetMistakes, NoSet) {
  SetFolder folder;
  EXPECT_EQ(folder.Said(), "measurement.yaml: cannot be read: No such file or directory\n");
  folder.Write("measurement.yaml", "");
  EXPECT_EQ(folder.Said(), kYaml + "1: got an empty file, expected a YAML document\n");
  folder.Write("measurement.yaml", "[1, 2]\n");
  EXPECT_EQ(folder.Said(), kYaml + "1: got a list of 2, expected a map of keys\n");
  folder.Write("measurement.yaml", "format: 2\n");
  EXPECT_EQ(folder.Said(),
            kYaml + "1: format: got 2, expected 1, the version of the format that is read here\n" +
                kYaml + "1: cable: missing, expected a map of a cable's keys\n" +  //
                kYaml + "1: experiments: missing, expected a list of at least one experiment\n");
}

TEST(SetMistakes, Cable) {
  EXPECT_EQ(Said("  length: 0.200\n", "  length: 200\n"),
            kYaml + "3: cable.length: got 200, expected a number in (0, 20] [m]: is it in mm?\n");
  EXPECT_EQ(Said("  eta_GJ: null\n", ""),
            kYaml +
                "2: cable.eta_GJ: missing, expected a number >= 0 [N m^2 s], 'critical', or "
                "null where it is unknown\n");
  EXPECT_EQ(Said("  eta_EI: 2.0e-4\n", ""),
            kYaml +
                "2: cable.eta_EI: missing, expected a number >= 0 [N m^2 s], or eta_EI1 and "
                "eta_EI2\n");
  EXPECT_EQ(Said("  GJ: 0.0090\n", "  Gj: 0.0090\n"),
            kYaml + "2: cable.GJ: missing, expected a number in (0, 100000] [N m^2]\n" +  //
                kYaml + "7: cable.Gj: got an unknown key, did you mean 'GJ'?\n");
  EXPECT_EQ(
      Said("  GJ: 0.0090\n", "  GJ: 0.0090\n  uncertain: [EI, eta_EJ]\n"),
      kYaml +
          "8: cable.uncertain[1]: got 'eta_EJ', expected one of length, diameter, width, height, "
          "mass_per_length, EI, EI1, EI2, GJ, EA, GA, GA1, GA2, eta_EI, eta_EI1, "
          "eta_EI2, eta_GJ, eta_EA, eta_GA, eta_GA1, eta_GA2, disc.inertia: did you mean "
          "'eta_EI'?\n");
  EXPECT_EQ(Said("  GJ: 0.0090\n", "  GJ: 0.0090\n  avoid: [wheel]\n"),
            kYaml + "8: cable.avoid: got this in a measurement set, which has no links\n");
  EXPECT_EQ(Said("specimen: {length: 0.250}", "specimen: {length: 0.250, uncertain: [EI]}"),
            kYaml +
                "13: experiments[0].specimen.uncertain: got this of one specimen, expected it "
                "of the set's `cable`: what is adjusted is common to all experiments\n");
  EXPECT_EQ(Said("specimen: {length: 0.250}",
                 "specimen: {length: 0.250, masses: [{s: 0.3, mass: 0.001}]}"),
            kYaml +
                "13: experiments[0].specimen.masses[0].s: got 0.3, expected at most 0.25 [m], "
                "the length\n");
}

TEST(SetMistakes, ALawOfAClampThatNoExperimentHas) {
  SetFolder folder;
  const std::string cable =
      Replaced(kHead, "  EI: 0.0120\n",
               "  EI: 0.0120\n"
               "  extensions:\n"
               "    clamp_friction: {a: {stuck: 1, slip_moment: 1, spring: 1},\n"
               "                     b: {stuck: 1, slip_moment: 1, spring: 1}}\n");
  WriteAll(&folder, cable + kRingdown + kTorsion + kSwinging);
  EXPECT_EQ(folder.Said(), kYaml +
                               "9: cable.extensions.clamp_friction.b.slip_moment: got "
                               "clamp_friction of clamp b, which no experiment has: end b is free "
                               "or carries a disc; expected none, or an experiment with a clamp "
                               "at b\n");
  WriteAll(&folder, cable + kRingdown + kArch);
  EXPECT_EQ(folder.Said(), "");
}

TEST(SetMistakes, TheBearingOfADiscThatNoExperimentHas) {
  SetFolder folder;
  const std::string cable =
      Replaced(kHead, "  EI: 0.0120\n",
               "  EI: 0.0120\n"
               "  extensions:\n"
               "    clamp_friction: {b_torsion: {stuck: 1, slip_moment: 1, spring: 0}}\n");
  WriteAll(&folder, cable + kRingdown);
  EXPECT_EQ(folder.Said(), kYaml +
                               "8: cable.extensions.clamp_friction.b_torsion.slip_moment: got "
                               "clamp_friction of clamp b, which no experiment has: end b is free "
                               "or carries a disc; expected none, or an experiment with a clamp "
                               "at b\n");
  WriteAll(&folder, cable + kRingdown + kTorsion);
  EXPECT_EQ(folder.Said(), "");
}

TEST(SetMistakes, Experiments) {
  EXPECT_EQ(Said("experiments:\n", "experiments: []\nexperimenst:\n"),
            kYaml +
                "10: experiments: got a list of 0, expected a list of at least one "
                "experiment\n" +
                kYaml + "11: experimenst: got an unknown key, did you mean 'experiments'?\n");
  EXPECT_EQ(Said("name: pendulum", "name: ringdown_small"),
            kYaml +
                "21: experiments[1].name: got 'ringdown_small', expected a name of its own: "
                "the experiment on line 11 has it\n");
  EXPECT_EQ(Said("name: pendulum", "name: ../pendulum"),
            kYaml +
                "21: experiments[1].name: got '../pendulum', expected a name that can be a "
                "file's, without slashes\n");
  EXPECT_EQ(Said("    start: {twisted: 1.2}\n", ""),
            kYaml +
                "21: experiments[1].start: missing, expected one of {rest: true}, {held: {s: "
                "..., position: [...]}}, {twisted: ...} and {unknown: true}\n");
  EXPECT_EQ(Said("gravity: [0, -9.81, 0]", "gravity: [0, -.inf, 0]"),
            kYaml +
                "30: experiments[2].gravity[1]: got -.inf, expected a finite number "
                "[m/s^2]\n");
}

TEST(SetMistakes, Ends) {
  const std::string b = kYaml + "15: experiments[0].b";
  const std::string forms = "`free`, {pose: [...]}, {motion: FILE} or {disc: {...}}";
  EXPECT_EQ(Said("b: free", "b: fre"), b + ": got 'fre', expected " + forms + "\n");
  EXPECT_EQ(Said("b: free", "b: {}"),
            b + ": got neither a pose nor a motion, expected " + forms + "\n");
  EXPECT_EQ(Said("b: free", "b: {pose: [0, 0, 0.2, 0, 0, 0, 0.9]}"),
            b + ".pose: got a quaternion of length 0.9, expected unit length within 0.001\n");
  EXPECT_EQ(Said("b: free", "b: {pose: [0, 0, 0.2, 0, 0, 1]}"),
            b + ".pose: got a list of 6, expected a pose [x, y, z, qx, qy, qz, qw] in metres\n");
  EXPECT_EQ(Said("b: free", "b: {pose: [0, 0, 0.2, 0, 0, 0, 1], motion: shaker.csv}"),
            b + ".motion: got this beside `pose`, expected one of them\n");
  EXPECT_EQ(Said("b: free", "b: {pose: [0, 0, 0.2, 0, 0, 0, 1], free: [tz, rw, tz]}"),
            b + ".free[1]: got 'rw', expected one of tx, ty, tz, rx, ry, rz: did you mean 'rx'?\n" +
                b + ".free[2]: got 'tz' twice, expected it once\n");
  EXPECT_EQ(Said("b: free", "b: {pose: [0, 0, 0.2, 0, 0, 0, 1], roll: 0.1}"),
            b + ".roll: got 0.1, expected one of unknown\n");
  EXPECT_EQ(Said("b: free", "b: {disc: {inertia: 0, mass: -1}, free: [tx]}"),
            b + ".disc.inertia: got 0, expected a number in (0, 1000] [kg m^2]\n" +  //
                b + ".disc.mass: got -1, expected a number in [0, 1000] [kg]\n" + b +
                ".free: got this beside a disc, which moves freely, expected it of a clamp\n");
  EXPECT_EQ(Said("a: {pose: [0, 0, 0, 0, 0, 0, 1]}", "a: free"),
            kYaml + "14: experiments[0].a: got 'free', expected {pose: [...]} or {motion: FILE}\n");
}

TEST(SetMistakes, Starts) {
  const std::string start = kYaml + "16: experiments[0].start";
  const std::string held = "{held: {s: 0.250, position: [0.01, 0, 0.249]}}";
  EXPECT_EQ(Said(held, "{held: {s: 0.3, position: [0.01, 0]}}"),
            start + ".held.s: got 0.3, expected at most 0.25 [m], the cable's length\n" +  //
                start + ".held.position: got a list of 2, expected a list of 3 numbers\n");
  EXPECT_EQ(Said(held, "{rest: true, unknown: true}"),
            start +
                ": got 2 kinds of start, expected one of {rest: true}, {held: {s: ..., "
                "position: [...]}}, {twisted: ...} and {unknown: true}\n");
  EXPECT_EQ(Said(held, "{rest: false}"), start +
                                             ".rest: got 'false', expected true, or another "
                                             "start\n");
  EXPECT_EQ(Said(held, "{unknown: true, near: {s: 0.1, position: [0, 0, 0]}}"),
            start +
                ".near: got this without `rest`, expected it to pick one of several "
                "equilibria\n");
  EXPECT_EQ(Said("{disc: {inertia: 1.2e-4, mass: 0.15, guided: true}}",
                 "{pose: [0, 0, 1.2, 0, 0, 0, 1]}"),
            kYaml +
                "24: experiments[1].start.twisted: got this where end b is held about the axis, "
                "expected a disc or an end b that may turn\n");
}

TEST(SetMistakes, Channels) {
  const std::string channel = kYaml + "19: experiments[0].channels[0]";
  const std::string good = "{column: tip_x, s: 0.250, quantity: position, axis: x, sigma: 5.0e-5}";
  EXPECT_EQ(Said(good, "{column: tip_x, s: 0.251, quantity: positon, axis: w, sigma: 0}"),
            channel +
                ".quantity: got 'positon', expected one of position, velocity, acceleration, "
                "angle, rate, force, moment: did you mean 'position'?\n" +
                channel + ".sigma: got 0, expected a positive number [the channel's unit]\n");
  EXPECT_EQ(Said(good, "{column: tip_x, s: 0.251, quantity: position, axis: w, offset: 1}"),
            channel + ".offset: got 1, expected one of unknown\n" +  //
                channel + ".s: got 0.251, expected at most 0.25 [m], the cable's length\n" +
                channel + ".axis: got 'w', expected one of x, y, z\n");
  EXPECT_EQ(Said(good, "{column: tip_x, quantity: position}"),
            channel + ".s: missing, expected a finite number [m]\n" +  //
                channel + ".axis: missing, expected one of x, y, z\n");
  EXPECT_EQ(Said(good, "{column: tip_x, s: 0.1, quantity: force, axis: x}"),
            channel + ".s: got this of a force, which has none\n" +  //
                channel + ".clamp: missing, expected one of a, b\n");
  EXPECT_EQ(Said(good, "{column: tip_x, clamp: b, quantity: force, axis: x}"),
            channel + ".clamp: got 'b', expected an end that a clamp holds\n");
  EXPECT_EQ(Said(good, "{column: tip_x, s: 0.1, quantity: angle, axis: z, frame: a}"),
            channel + ".axis: got this of an angle, which has none\n" +  //
                channel + ".frame: got this of an angle, which has none\n");
  EXPECT_EQ(Said("{column: tip_z, ", "{column: tip_x, "),
            kYaml +
                "20: experiments[0].channels[1].column: got 'tip_x', expected a column of its "
                "own: the channel on line 19 has it\n" +
                "ringdown_small.csv:1: tip_z: got a column that no channel names, expected one\n");
  EXPECT_EQ(Said("{column: tip_x, ", "{column: t, "),
            "ringdown_small.csv:1: tip_x: got a column that no channel names, expected one\n" +
                kYaml +
                "19: experiments[0].channels[0].column: got 't', expected a column of "
                "values: this one holds the times\n");
}

TEST(SetMistakes, Files) {
  EXPECT_EQ(Said("record: ringdown_small.csv", "record: ../ringdown_small.csv"),
            kYaml +
                "17: experiments[0].record: got '../ringdown_small.csv', expected a file in "
                "the set's own folder\n");
  EXPECT_EQ(Said("record: ringdown_small.csv", "record: ringdown.csv"),
            kYaml +
                "17: experiments[0].record: got 'ringdown.csv', which cannot be read: No such "
                "file or directory: ringdown.csv\n");
  EXPECT_EQ(Said("record: ringdown_small.csv", "record: torsion"),
            kYaml + "17: experiments[0].record: got 'torsion', a directory, expected a CSV file\n");
}

TEST(SetMistakes, FilesOfTwoClocks) {
  // The arch's record has stamps since 1970, its shaker and its load begin at zero.
  const std::string epoch = "t,apex,torque\n1700000000.1,1.5,0.01\n1700000000.2,-0.1,0.02\n";
  const std::string said = SaidOf("arch.csv", epoch);
  for (const char* words :
       {"a.motion: got 'shaker.csv' with times from 0 to 1 s, expected them within the record's "
        "'arch.csv', from 1700000000 to 1700000000 s",
        "b.motion: got 'shaker.csv'", "load: got 'pull.csv' with times from 0 to 1 s",
        "two clocks, take 1700000000 s off the record's times"}) {
    EXPECT_NE(said.find(words), std::string::npos) << words << "\n" << said;
  }
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 3) << said;
  // Touching at one time is within.
  EXPECT_EQ(SaidOf("arch.csv", "t,apex,torque\n1,1.5,0.01\n2,-0.1,0.02\n"), "");
  // One time only holds always.
  EXPECT_EQ(SaidOf("pull.csv", "t,s,fx,fy,fz\n7,0.05,0,0,1\n"), "");
}

TEST(SetMistakes, TimesThatNoTestLasts) {
  const std::string said =
      SaidOf("ringdown_small.csv", "t,tip_x,tip_z\n0,0.01,0.249\n1000000,0.007,0.2495\n");
  EXPECT_NE(said.find("record: got times up to 1000000 s after a start at 0 s, expected at most "
                      "50000 s"),
            std::string::npos)
      << said;
  // From the first time of a motion to the record's last, however short both are.
  const std::string motion = SaidOf("shaker.csv",
                                    "t,x,y,z,qx,qy,qz,qw\n-9e9,0,0,0,0,0,0,1\n"
                                    "0.15,0,0,0,0,0,0,1\n");
  EXPECT_NE(motion.find("a.motion: got 'shaker.csv' with times from -9000000000 to 0.15 s"),
            std::string::npos)
      << motion;
}

TEST(SetMistakes, Records) {
  const std::string file = "ringdown_small.csv";
  const std::string header = "t,tip_x,tip_z\n";
  EXPECT_EQ(SaidOf(file, ""), file + ":1: got an empty file, expected a header line\n");
  EXPECT_EQ(SaidOf(file, header), file + ":1: got a header line only, expected rows\n");
  EXPECT_EQ(SaidOf(file, "0,1,2\n1,1,2\n"),
            file + ":1: got numbers, expected a header line of column names\n");
  EXPECT_EQ(SaidOf(file, "t;tip_x;tip_z\n0;1;2\n"),
            file + ":1: got columns separated by semicolons or tabs, expected commas\n");
  EXPECT_EQ(SaidOf(file, header + "0,nan,1\n1,,0,1m\n2,,1m\n\n3,1e999,1\n"),
            file + ":2: tip_x: got 'nan', expected a finite number\n" + file +
                ":3: got 4 cells, expected 3 as in the header\n" + file +
                ":4: tip_x: got nothing, expected a finite number\n" + file +
                ":4: tip_z: got '1m', expected a finite number\n" + file +
                ":5: got an empty line, expected a row of numbers\n" + file +
                ":6: tip_x: got '1e999', expected a finite number\n");
  EXPECT_EQ(SaidOf(file, header + "0,1,1\n1,1,1\n1,1,1\n0.5,1,1\n"),
            file + ":4: t: got 1 after 1, expected times that increase\n" + file +
                ":5: t: got 0.5 after 1, expected times that increase\n");
  EXPECT_EQ(SaidOf(file, "t,tipx,tip_z,tip_z,more\n0,1,1,1,1\n"),
            file + ":1: tip_z: got two columns of this name, expected one\n" + file +
                ":1: tipx: got a column that no channel names, expected one\n" + file +
                ":1: more: got a column that no channel names, expected one\n" + kYaml +
                "19: experiments[0].channels[0].column: got 'tip_x', expected a column of "
                "ringdown_small.csv: did you mean 'tipx'?\n");
  EXPECT_EQ(SaidOf(file, "time,tip_x,tip_z\n0,1,1\n"),
            file +
                ":1: time: got this as the first column, expected `t` [s], or `step` of a "
                "quasi-static test\n" +
                file + ":1: time: got a column that no channel names, expected one\n");
}

TEST(SetMistakes, ManyWrongRowsAreCounted) {
  std::string text = "t,tip_x,tip_z\n";
  for (int i = 0; i < 1000; ++i) text += std::to_string(i) + ",x,0\n";
  const std::string said = SaidOf("ringdown_small.csv", text);
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 21);
  EXPECT_NE(said.find("ringdown_small.csv:1001: 980 more of this kind, up to this line\n"),
            std::string::npos)
      << said;
}

TEST(SetMistakes, QuasiStatic) {
  EXPECT_EQ(SaidOf("steps.csv", "step,force\n0,1\n2,1\n2.5,1\n"),
            "steps.csv:3: step: got 2, expected 1: steps are 0, 1, 2, ...\n"
            "steps.csv:4: step: got 2.5, expected 3: steps are 0, 1, 2, ...\n");
  EXPECT_EQ(SaidOf("steps.csv", "t,force\n0,1\n2,1\n"),
            kYaml +
                "41: experiments[3].b.motion: got 'support.csv' with another first column than "
                "the record 'steps.csv', expected `t`\n");
  EXPECT_EQ(SaidOf("pull.csv", "step,s,fx,fy,fz\n0,0.1,0,0,1\n0,0.2,0,0,1\n1,0.1,0,0,1\n"),
            kYaml +
                "34: experiments[2].load: got 'pull.csv' with another first column than the "
                "record 'arch.csv', expected `t`\n");
  EXPECT_EQ(SaidOf("swinging.csv", "step,v\n0,1\n1,1\n"),
            kYaml +
                "50: experiments[4].start: got another start than rest of a quasi-static "
                "record (its first column is `step`), expected {rest: true}\n" +
                kYaml +
                "53: experiments[4].channels[0].quantity: got 'velocity' in a quasi-static "
                "record, where nothing moves\n");
}

TEST(SetMistakes, Motions) {
  EXPECT_EQ(SaidOf("support.csv", "step,x,y,z,qx,qy,qz,q_w\n0,0,0,0,0,0,0,1\n"),
            "support.csv:1: qw: no such column, expected one in a motion file: is it meant by "
            "'q_w'?\n"
            "support.csv:1: q_w: got a column of this name, expected none in a motion file\n");
  EXPECT_EQ(SaidOf("support.csv", "step,x,y,z,qx,qy,qz,qw\n0,0,0,0,0,0,0,1\n1,0,0,0,1,0,0,1\n"),
            "support.csv:3: qx, qy, qz, qw: got a quaternion of length 1.41, expected unit length "
            "within 0.001\n");
}

TEST(SetMistakes, Loads) {
  EXPECT_EQ(Said("[{s: 0.1, force: [0, 0, -0.5]}]", "[{s: 0.3, force: [0, 0]}]"),
            kYaml +
                "43: experiments[3].load[0].s: got 0.3, expected at most 0.2 [m], the cable's "
                "length\n" +
                kYaml +
                "43: experiments[3].load[0].force: got a list of 2, expected a list of 3 "
                "numbers\n");
  EXPECT_EQ(Said("[{s: 0.1, force: [0, 0, -0.5]}]", "{s: 0.1, force: [0, 0, 0]}"),
            kYaml +
                "43: experiments[3].load: got a map, expected a list of loads, or the name of "
                "a CSV file\n");
  EXPECT_EQ(
      SaidOf("pull.csv", "t,s,fx,fy,fz\n0,0.1,0,0,1\n0,0.1,0,0,1\n1,0.3,0,0,1\n0.5,0,0,0,0\n"),
      "pull.csv:3: t: got a second force at this time and s, expected one\n"
      "pull.csv:4: s: got 0.3, expected at most 0.2 [m], the cable's length\n"
      "pull.csv:5: t: got 0.5 after 1, expected times that do not decrease\n");
}

TEST(SetMistakes, AreAllNamedAtOnce) {
  SetFolder folder;
  WriteAll(&folder, Replaced(Replaced(AllSets(), "EI: 0.0120", "EI: -1"), "b: free", "b: loose"));
  folder.Write("steps.csv", "step,force\n0,x\n").Write("shaker.csv", "");
  EXPECT_EQ(folder.Said(),
            kYaml + "6: cable.EI: got -1, expected a number in (0, 100000] [N m^2]\n" +  //
                kYaml +
                "15: experiments[0].b: got 'loose', expected `free`, {pose: [...]}, "
                "{motion: FILE} or {disc: {...}}\n"
                "shaker.csv:1: got an empty file, expected a header line\n"
                "steps.csv:2: force: got 'x', expected a finite number\n");
}

}  // namespace
}  // namespace cosserat_cable
