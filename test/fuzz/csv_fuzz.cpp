// Any bytes as a record, or as the motion of a clamp where the first one is odd, of a set that is
// good.
#include "cosserat_cable/measurement/measurement_set.h"
#include "fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cosserat_cable;
  if (size == 0) return 0;
  const bool is_motion = data[0] % 2 == 1;
  const std::filesystem::path folder = FuzzFolder();
  for (const auto& file : std::filesystem::directory_iterator(COSSERAT_CABLE_FUZZ_SET)) {
    const std::filesystem::path to = folder / file.path().filename();
    std::filesystem::copy_file(file.path(), to, std::filesystem::copy_options::overwrite_existing);
  }
  WriteFuzzFile(folder / (is_motion ? "shaker.csv" : "shaken.csv"), data + 1, size - 1);
  Problems problems, warnings;
  const MeasurementSet set = LoadMeasurementSet(folder.string(), &problems);
  if (problems.empty()) CheckPlausibility(set, &problems, &warnings);
  RequireTold(problems);
  return 0;
}
