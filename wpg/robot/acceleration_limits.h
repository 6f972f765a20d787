#pragma once

#include "wpg/robot/robot_model.h"

namespace halfstep {

/// Whether the robot file states a limit of the acceleration of any leg joint
/// (`acceleration_limits_rad_s2`). Source: wpg/README.md, "Robots".
bool StatesAccelerationLimits(const RobotModel& robot);

}  // namespace halfstep
