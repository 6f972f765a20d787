#pragma once

#include <string>
#include <vector>

#include "wpg/robot/robot_model.h"

namespace halfstep {

/// Names of the leg joints whose torque limits are not known: the URDF has an effort of 0, or none,
/// and the robot file has no other.
std::vector<std::string> JointsOfUnknownTorque(const RobotModel& robot);

/// Why nothing can be demanded of the robot's joint torques: masses are not known, or no leg
/// joint's torque limit is; "" when something can.
std::string TorqueFault(const RobotModel& robot);

}  // namespace halfstep
