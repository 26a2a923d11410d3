// rig_generator: measurement sets whose truth is known, from a simulation that shares nothing with
// the package's own.

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <stdexcept>
#include <string>

#include "blind/blind_set.h"
#include "effect_sets.h"
#include "effects/kinds.h"
#include "sample_sets.h"

namespace {

using namespace cosserat_cable::generator;

constexpr char kUsage[] =
    "usage: rig_generator RIG --output DIR [--seed N] [--snr DB] [--lengths N] [--repeats N]\n"
    "                        [--longest M] [--scatter X] [--start known|unknown]\n"
    "                        [--effect NAME]... [--effect-size X] [--effect-set KEY=VALUE]...\n"
    "                        [--suite NAME] [--strength X]\n"
    "Writes a measurement set with its truth (truth.json) into DIR.\n"
    "  RIG            random          a random cable: two ring-downs, torsion at 3 or 4 lengths\n"
    "                 ringdowns       one or two short ring-downs of a random cable\n"
    "                 wire            a soft wire, hanging, that swings a little\n"
    "                 torsion-series  torsion at several lengths\n"
    "                 torsion-single  torsion at one length\n"
    "                 six             six records of 3 s\n"
    "                 effects         a random cable: two ring-downs of different amplitude, "
    "plane\n"
    "                                 and length, torsion, a clamp that is shaken; in DIR/unseen\n"
    "                                 another one that is shaken otherwise\n"
    "                 drive           one record of a cable whose clamp is shaken\n"
    "                 arch            the same with the other end held, as an arch\n"
    "                 bend            slow bending by a force at the tip, to and fro, two planes\n"
    "                 blind           data for a diagnosis: the set in DIR/set, a record to "
    "predict in\n"
    "                                 DIR/unseen; DIR/truth.json tells what is at work\n"
    "  --suite NAME   of blind: one of those below\n"
    "  --strength X   of blind: rms of what recalibration leaves of an effect, in times the noise "
    "(5)\n"
    "  --seed N       of all that is random (1)\n"
    "  --snr DB       signal to noise, rms (40)\n"
    "  --lengths N    of torsion-series (5)\n"
    "  --repeats N    per length, of torsion-series and torsion-single (3)\n"
    "  --longest M    of torsion-series [m] (0.5)\n"
    "  --scatter X    of D_E, which is another one each time that the clamp is fastened: standard\n"
    "                 deviation from record to record, relative, of torsion-* (0)\n"
    "  --start S      of ringdowns: unknown where the sensor is switched on while the cable "
    "swings\n"
    "                 already (known)\n"
    "  --effect NAME  what the rod or the record has beyond the set's statement; may be repeated;\n"
    "                 none (default) or one of those below\n"
    "  --effect-size X  times the effects' default sizes (1); 0: the plain rod\n"
    "  --effect-set KEY=VALUE  one number of an effect, KEY as truth.json has it without\n"
    "                 extensions. or faults.: air_drag.Cd=2; may be repeated\n";

int wrong(const std::string& what) {
  std::fprintf(stderr, "rig_generator: %s\n%s", what.c_str(), kUsage);
  return 2;
}

/// Whole text as a number within bounds, or false.
bool parse(const std::string& text, double low, double high, double* value) {
  char* end = nullptr;
  *value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && *value >= low && *value <= high;
}

}  // namespace

int main(int argc, char** argv) {
  std::map<std::string, std::string> options{
      {"--seed", "1"},      {"--snr", "40"},        {"--lengths", "5"},   {"--repeats", "3"},
      {"--longest", "0.5"}, {"--scatter", "0"},     {"--start", "known"}, {"--output", ""},
      {"--effect", ""},     {"--effect-size", "1"}, {"--effect-set", ""}, {"--suite", "single"},
      {"--strength", "5"}};
  EffectPlan effects;
  if (argc > 1 && std::string(argv[1]) == "--help") {
    std::fputs(kUsage, stdout);
    std::printf("  effects:");
    for (const EffectKind* kind : effectKinds()) std::printf(" %s", kind->name);
    std::printf("\n  suites:");
    for (const std::string& suite : blindSuites()) std::printf(" %s", suite.c_str());
    std::printf("\n");
    return 0;
  }
  if (argc < 2) return wrong("no rig given");
  for (int i = 2; i < argc; i += 2) {
    if (options.count(argv[i]) == 0) return wrong(std::string("unknown option ") + argv[i]);
    if (i + 1 == argc) return wrong(std::string("no value for ") + argv[i]);
    options[argv[i]] = argv[i + 1];
    if (std::string(argv[i]) == "--effect") effects.names.push_back(argv[i + 1]);
    if (std::string(argv[i]) == "--effect-set") effects.assignments.push_back(argv[i + 1]);
  }
  double seed = 0.0, snr = 0.0, lengths = 0.0, repeats = 0.0;
  if (!parse(options["--seed"], 0.0, 1e9, &seed)) return wrong("--seed: expected 0 to 1e9");
  if (!parse(options["--snr"], -20.0, 200.0, &snr)) return wrong("--snr: expected -20 to 200 dB");
  if (!parse(options["--lengths"], 2.0, 50.0, &lengths))
    return wrong("--lengths: expected 2 to 50");
  if (!parse(options["--repeats"], 1.0, 50.0, &repeats))
    return wrong("--repeats: expected 1 to 50");
  TorsionPlan plan;
  if (!parse(options["--longest"], 0.15, 10.0, &plan.longest))
    return wrong("--longest: expected 0.15 to 10 m");
  if (!parse(options["--scatter"], 0.0, 1.0, &plan.scatter))
    return wrong("--scatter: expected 0 to 1");
  if (options["--start"] != "known" && options["--start"] != "unknown")
    return wrong("--start: expected known or unknown");
  if (!parse(options["--effect-size"], -100.0, 100.0, &effects.size))
    return wrong("--effect-size: expected -100 to 100");
  BlindPlan blind;
  if (!parse(options["--strength"], 0.1, 1000.0, &blind.strength))
    return wrong("--strength: expected 0.1 to 1000");
  if (options["--output"].empty()) return wrong("no --output given");

  const std::string rig = argv[1];
  const auto seed_number = static_cast<std::uint64_t>(seed);
  plan.lengths = static_cast<int>(lengths);
  plan.repeats = static_cast<int>(repeats);
  try {
    if (rig == "blind") {
      blind.suite = options["--suite"];
      blind.effect = options["--effect"];
      blind.seed = seed_number;
      blind.snr = snr;
      writeBlind(blindSet(blind), options["--output"]);
      return 0;
    }
    MeasurementSet set;
    if (rig == "random") {
      set = randomSet(seed_number, snr, effects);
    } else if (rig == "ringdowns") {
      RingdownPlan ringdowns;
      ringdowns.unknown_start = options["--start"] == "unknown";
      set = ringdownSet(seed_number, snr, ringdowns, effects);
    } else if (rig == "wire") {
      set = wireSet(seed_number, snr, effects);
    } else if (rig == "torsion-series") {
      set = torsionSeries(seed_number, snr, plan, effects);
    } else if (rig == "torsion-single") {
      plan.lengths = 1;
      set = torsionSeries(seed_number, snr, plan, effects);
    } else if (rig == "six") {
      set = sixRecords(seed_number, snr, effects);
    } else if (rig == "effects") {
      const EffectSets sets = effectSets(seed_number, snr, effects);
      writeSet(sets.unseen, options["--output"] + "/unseen");
      set = sets.seen;
    } else if (rig == "drive") {
      set = driveSet(seed_number, snr, effects);
    } else if (rig == "arch") {
      set = archSet(seed_number, snr, effects);
    } else if (rig == "bend") {
      set = bendSet(seed_number, snr, effects);
    } else {
      return wrong("unknown rig " + rig);
    }
    writeSet(set, options["--output"]);
  } catch (const std::invalid_argument& error) {
    return wrong(error.what());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "rig_generator: %s\n", error.what());
    return 3;
  }
  return 0;
}
