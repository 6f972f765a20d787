#pragma once

#include "wpg/robot/robot_model.h"

namespace halfstep {

/// The robot with this limit of every leg joint. Shipped robot files state none of accelerations,
/// and HRP-2's URDF none of torques.
inline RobotModel WithLimits(RobotModel robot, double LegJoint::*of, double limit) {
  for (Leg& leg : robot.legs) {
    for (LegJoint& joint : leg.joints) joint.*of = limit;
  }
  return robot;
}
/// Of accelerations [rad/s²].
inline RobotModel WithAccelerationLimits(const RobotModel& robot, double limit) {
  return WithLimits(robot, &LegJoint::max_acceleration, limit);
}
/// Of torques [N m].
inline RobotModel WithTorqueLimits(const RobotModel& robot, double limit) {
  return WithLimits(robot, &LegJoint::max_torque, limit);
}

}  // namespace halfstep
