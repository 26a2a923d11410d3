// Any bytes as a cable file: problems, or a cable that is written and reads back without one.
#include "cosserat_cable/cable/cable_model.h"
#include "fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cosserat_cable;
  Problems problems;
  const CableFile cables = LoadCableFile(FuzzFile(data, size).path(), &problems, {});
  RequireTold(problems);
  if (!problems.empty()) return 0;
  const std::string text = WriteCableFile(cables);
  const FuzzFile written(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  Problems again;
  LoadCableFile(written.path(), &again, {});
  if (again.empty()) return 0;
  std::fputs((text + again.ToString()).c_str(), stderr);
  abort();
}
