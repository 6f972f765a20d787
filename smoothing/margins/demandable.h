#pragma once

#include <string>

#include "smoothing/margins/margin.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// Why a robot's files do not let anything be demanded of a family, as a sentence without subject:
/// masses or limits are not known; "" where they let it be.
std::string WhyNotDemandable(MarginFamily family, const RobotModel& robot);

/// The same limits, with nothing demanded where the robot's files do not let it be.
MarginLimits Demandable(MarginLimits limits, const RobotModel& robot);

}  // namespace halfstep
