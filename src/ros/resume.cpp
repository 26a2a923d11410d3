#include "cosserat_cable/ros/resume.h"

#include <iostream>

#include "cosserat_cable/ros/cable_engine.h"
#include "cosserat_cable/ros/conversions.h"
#include "cosserat_cable/ros/inputs.h"
#include "state_dump.h"

namespace cosserat_cable {
namespace {

std::vector<const Body*> FindBodies(const StateDump& dump, const BodyMap& bodies,
                                    const std::string& vehicle, Problems* problems) {
  std::vector<const Body*> found;
  for (const std::string& link : dump.obstacles) {
    found.push_back(FindBody(bodies, dump.cable.cables.front(), link));
    if (!found.back())
      problems->Add(vehicle, 0, "link", "'" + link + "' has no geometry, expected that of the run");
  }
  return found;
}

}  // namespace

ExitCode ResumeDump(const std::string& path, const std::string& other_vehicle) {
  Problems problems;
  const StateDump dump = ReadStateDump(path, &problems);
  const std::string vehicle = other_vehicle.empty() ? dump.vehicle_file : other_vehicle;
  VehicleModel model;
  BodyMap all;
  std::vector<const Body*> bodies;
  if (problems.empty() && !dump.obstacles.empty()) {
    if (vehicle.empty())
      problems.Add("", 0, "vehicle", "missing, expected the URDF whose links the cable avoids");
    else
      model = LoadVehicleOf(dump.cable, vehicle, &problems);
    if (problems.empty()) {
      all = MakeBodies(model, 1);
      bodies = FindBodies(dump, all, vehicle, &problems);
    }
  }
  std::string message;
  if (problems.empty()) message = FailAgain(dump, bodies, &problems);
  if (!problems.empty()) {
    std::cerr << problems.ToString();
    return kExitBadInput;
  }
  std::cout << "cable '" << dump.cable.cables.front().name << "' stopped at "
            << StampText(dump.stamp) << ": " << dump.message << "\n";
  if (message == dump.message) {
    std::cout << "it does so again, in the same words\n";
    return kExitFailed;
  }
  if (message.empty())
    std::cout << "it does not fail here: by another version, on another machine, or beside other "
                 "bodies\n";
  else
    std::cout << "here it fails otherwise: " << message << "\n";
  return kExitDone;
}

}  // namespace cosserat_cable
