#pragma once

#include "wpg/robot/robot_model.h"

namespace halfstep {

/// The robot with this acceleration limit of every leg joint [rad/s²]. Shipped robot files state
/// none.
inline RobotModel WithAccelerationLimits(RobotModel robot, double limit) {
  for (Leg& leg : robot.legs) {
    for (LegJoint& joint : leg.joints) joint.max_acceleration = limit;
  }
  return robot;
}

}  // namespace halfstep
