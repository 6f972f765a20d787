#include "smoothing/margins/demandable.h"

#include "wpg/robot/acceleration_limits.h"
#include "wpg/robot/torque_limits.h"

namespace halfstep {

std::string WhyNotDemandable(MarginFamily family, const RobotModel& robot) {
  switch (family) {
    case MarginFamily::kZmpRobot:
    case MarginFamily::kFriction:
      return robot.masses.fault;
    case MarginFamily::kTorque:
      return TorqueFault(robot);
    case MarginFamily::kJointAcceleration:
      if (StatesAccelerationLimits(robot)) return "";
      return "the robot file states no limits (`acceleration_limits_rad_s2`)";
    default:
      return "";
  }
}

MarginLimits Demandable(MarginLimits limits, const RobotModel& robot) {
  for (const MarginFamily family : AllMarginFamilies()) {
    if (!WhyNotDemandable(family, robot).empty()) limits.demanded_of(family) = kNotDemanded;
  }
  return limits;
}

}  // namespace halfstep
