#pragma once

#include <string>

#include "wpg/robot/robot_model.h"

namespace halfstep {

/// An SVG picture of the standing robot from the right, from behind and from above: outlines of
/// its bodies, the axes of its legs' joints, waist frame, soles and CoM. To check a robot file by.
std::string RobotPicture(const RobotModel& robot);

}  // namespace halfstep
