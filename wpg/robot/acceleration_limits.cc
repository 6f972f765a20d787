#include "wpg/robot/acceleration_limits.h"

#include <algorithm>
#include <cmath>

#include "wpg/check.h"

namespace halfstep {

bool HasAccelerationLimits(const RobotModel& robot) {
  return std::ranges::any_of(robot.legs, [](const Leg& leg) {
    return std::ranges::any_of(
        leg.joints, [](const LegJoint& joint) { return std::isfinite(joint.max_acceleration); });
  });
}

void AssumeAccelerationLimits(double limit, RobotModel* robot) {
  HALFSTEP_CHECK(limit > 0.0 && !robot->assumed_acceleration, "limit " << limit);
  int joints = 0;
  for (Leg& leg : robot->legs) {
    for (LegJoint& joint : leg.joints) {
      if (std::isfinite(joint.max_acceleration)) continue;
      joint.max_acceleration = limit;
      ++joints;
    }
  }
  if (joints > 0) robot->assumed_acceleration = {.limit = limit, .joints = joints};
}

}  // namespace halfstep
