#pragma once

#include <array>
#include <string>

#include "smoothing/margins/margin.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// Why a robot's files do not let anything be demanded of a family, as a sentence without subject:
/// masses or limits are not known; "" where they let it be.
std::string WhyNotDemandable(MarginFamily family, const RobotModel& robot);

/// What a tube adds for a robot to what is demanded of each family [its unit]; 0 of those that are
/// certified of the planned motion alone (FamilyTraits::in_tube).
std::array<double, kNumMarginFamilies> RaisedBy(const Tube& tube, const RobotModel& robot);

/// The same limits, with nothing demanded where the robot's files do not let it be, and with what
/// their tube adds for this robot.
MarginLimits Demandable(MarginLimits limits, const RobotModel& robot);

}  // namespace halfstep
