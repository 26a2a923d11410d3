// Any bytes as measurement.yaml, beside the records of a set that is good.
#include "cosserat_cable/measurement/measurement_set.h"
#include "fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cosserat_cable;
  static const std::filesystem::path folder = [] {
    for (const auto& file : std::filesystem::directory_iterator(COSSERAT_CABLE_FUZZ_SET))
      std::filesystem::copy_file(file.path(), FuzzFolder() / file.path().filename());
    return FuzzFolder();
  }();
  WriteFuzzFile(folder / "measurement.yaml", data, size);
  Problems problems, warnings;
  const MeasurementSet set = LoadMeasurementSet(folder.string(), &problems);
  if (problems.empty()) CheckPlausibility(set, &problems, &warnings);
  RequireTold(problems);
  RequireTold(warnings);
  return 0;
}
