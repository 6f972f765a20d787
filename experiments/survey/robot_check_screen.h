#pragma once

#include <string>

#include "experiments/survey/robot_check.h"

namespace halfstep {

/// What `halfstep robot --check` prints, one screen: what is known of the robot, what is not, and
/// what it can do.
std::string RobotCheckScreen(const RobotModel& robot, const RobotCheck& check);

/// The same as one JSON object: m, s, kg, rad; null where something is not known or cannot be done.
std::string RobotCheckJson(const RobotModel& robot, const RobotCheck& check);

}  // namespace halfstep
