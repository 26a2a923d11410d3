// Where a vehicle's joints are when no recording moves them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cosserat_cable/vehicle/vehicle_model.h"

namespace cosserat_cable {

/// By joint [rad] or [m].
using JointPositions = std::map<std::string, double>;

/// Whether positions can be given for it: it turns or slides, and follows no other.
bool IsDriven(const JointModel& joint);

/// Zero, or the end of the joint's range that is nearest to zero; of a joint that follows another
/// one, what that makes of it.
double RestPosition(const VehicleModel& vehicle, const JointModel& joint);
/// The same of all joints that have positions.
JointPositions RestPositions(const VehicleModel& vehicle);
/// A sentence for each driven joint whose range excludes zero, but those in `given`.
std::vector<std::string> RestNotes(const VehicleModel& vehicle, const JointPositions& given);

/// Reads "NAME=VALUE,NAME=VALUE..." texts. Problems under the key `joints`: a joint that is not
/// there (with the nearest one) or has no position of its own, a value that is no number or lies
/// outside the limits of the joint or of one that follows it, and two values for one joint.
JointPositions ReadJointPositions(const std::vector<std::string>& texts,
                                  const VehicleModel& vehicle, Problems* problems);

/// All joints that have positions: those given, the others at rest, followers where they are led.
JointPositions CompletePositions(const VehicleModel& vehicle, const JointPositions& given);

/// Of a link in the root. @pre `positions` has all joints that have positions
Pose PoseInRoot(const VehicleModel& vehicle, const std::string& link,
                const JointPositions& positions);

}  // namespace cosserat_cable
