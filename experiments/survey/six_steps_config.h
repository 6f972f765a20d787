#pragma once

#include <string>

#include "wpg/robot/robot_model.h"

namespace halfstep {

/// Text of a config: six steps straight ahead on an empty floor (SixSteps), all else by default.
/// `robot_file` is the robot's file as the config names it.
std::string SixStepsConfig(const RobotModel& robot, const std::string& robot_file);

}  // namespace halfstep
