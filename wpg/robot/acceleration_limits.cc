#include "wpg/robot/acceleration_limits.h"

#include <algorithm>
#include <cmath>

namespace halfstep {

bool StatesAccelerationLimits(const RobotModel& robot) {
  return std::ranges::any_of(robot.legs, [](const Leg& leg) {
    return std::ranges::any_of(
        leg.joints, [](const LegJoint& joint) { return std::isfinite(joint.max_acceleration); });
  });
}

}  // namespace halfstep
