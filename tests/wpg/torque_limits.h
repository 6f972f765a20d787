#pragma once

#include "wpg/robot/robot_model.h"

namespace halfstep {

/// The robot with this torque limit of every leg joint [N m]. HRP-2's URDF has none.
inline RobotModel WithTorqueLimits(RobotModel robot, double limit) {
  for (Leg& leg : robot.legs) {
    for (LegJoint& joint : leg.joints) joint.max_torque = limit;
  }
  return robot;
}

}  // namespace halfstep
