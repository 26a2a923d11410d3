// Any bytes as a URDF whose links `body` and `base` are to be touched: problems or a vehicle.
#include "cosserat_cable/vehicle/vehicle_model.h"
#include "fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cosserat_cable;
  Problems problems;
  VehicleUse use;
  use.visual_links = {"body"};
  use.moving_links = std::vector<std::string>{"body", "tip"};
  const VehicleModel vehicle = LoadVehicle(
      FuzzFile(data, size).path(), {"body", "base"},
      [](const std::string&) { return std::string(); }, &problems, use);
  RequireTold(problems);
  if (!problems.empty()) return 0;
  for (const JointModel& joint : vehicle.joints) {
    if (!vehicle.HasLink(joint.parent) || !vehicle.HasLink(joint.child)) abort();
    if (!joint.Evaluate(0.5).p.allFinite()) abort();
  }
  return 0;
}
