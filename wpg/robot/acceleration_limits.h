#pragma once

#include "wpg/robot/robot_model.h"

namespace halfstep {

/// Whether a limit of the acceleration of any leg joint is known: the robot file states one
/// (`acceleration_limits_rad_s2`), or one is assumed. Source: wpg/README.md, "Robots".
bool HasAccelerationLimits(const RobotModel& robot);

/// Assumes a limit [rad/s²] > 0 for every leg joint of which the robot file states none. Where it
/// states all, nothing is assumed. Precondition: nothing is assumed yet (std::logic_error).
void AssumeAccelerationLimits(double limit, RobotModel* robot);

}  // namespace halfstep
