#include "smoothing/margins/demandable.h"

#include "wpg/robot/acceleration_limits.h"
#include "wpg/robot/torque_limits.h"

namespace halfstep {

std::string WhyNotDemandable(MarginFamily family, const RobotModel& robot) {
  if (family == MarginFamily::kZmpRobot || family == MarginFamily::kFriction) {
    return robot.masses.fault;
  }
  if (family == MarginFamily::kTorque) return TorqueFault(robot);
  if (family == MarginFamily::kJointAcceleration && !StatesAccelerationLimits(robot)) {
    return "the robot file states no limits (`acceleration_limits_rad_s2`)";
  }
  return "";
}

MarginLimits Demandable(MarginLimits limits, const RobotModel& robot) {
  for (const MarginFamily family : AllMarginFamilies()) {
    if (!WhyNotDemandable(family, robot).empty()) limits.demanded_of(family) = kNotDemanded;
  }
  return limits;
}

}  // namespace halfstep
