#pragma once

#include <string>

#include "wpg/robot/robot_model.h"

namespace halfstep {

inline const std::string kHrp2 = HALFSTEP_SOURCE_DIR "/wpg/robots/hrp2.yaml";

inline RobotModel Hrp2() { return LoadRobot(kHrp2); }

}  // namespace halfstep
