// Any bytes as a bag: problems, an exception of the reader's, or messages.
#include "bag_file.h"
#include "cosserat_cable/ros/bag_reader.h"
#include "fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cosserat_cable;
  const FuzzFile file(data, size);
  Problems problems;
  const BagReader bag({file.path()}, &problems);
  RequireTold(problems);
  if (!problems.empty()) return 0;
  try {
    bag.ForEach(bag.begin_time(), bag.end_time(), [](const BagMessage& message) {
      if ((message.tf != nullptr) == (message.joints != nullptr)) abort();
      return true;
    });
  } catch (const BagFormatError&) {
  }
  return 0;
}
