#pragma once

#include <string>

#include "tests/places.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

inline const std::string kHrp2 = InSources("wpg/robots/hrp2.yaml");

inline RobotModel Hrp2() { return LoadRobot(kHrp2); }

}  // namespace halfstep
