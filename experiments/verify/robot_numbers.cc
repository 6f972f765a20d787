#include "experiments/verify/robot_numbers.h"

#include <algorithm>
#include <cmath>

namespace halfstep::verify {
namespace {

// From the hip to the knee's axis, and from there to the ankle [m].
double AcrossKnee(const Leg& leg) {
  const LegJoint& knee = leg.joints[3];
  return knee.axis_B.cross(leg.hip_B - knee.point_B).norm() +
         knee.axis_B.cross(leg.ankle_B - knee.point_B).norm();
}

}  // namespace

double PendulumRate(const RobotModel& robot, double crouch) {
  return std::sqrt(kGravity / (robot.com_height - crouch));
}

// Hip (a point of the thigh), knee axis and ankle (a point of the shank): stretched when both lie
// in one half-plane pair of the knee axis.
double StretchedLength(const Leg& leg) {
  return std::hypot(AcrossKnee(leg), leg.joints[3].axis_B.dot(leg.ankle_B - leg.hip_B));
}

double LegLength(const RobotModel& robot) {
  const Leg& leg = robot.legs[0];
  return AcrossKnee(leg) + (leg.X_BSole.inverse() * leg.ankle_B).z();
}

bool LimitsAccelerations(const RobotModel& robot) {
  return std::ranges::any_of(robot.legs, [](const Leg& leg) {
    return std::ranges::any_of(
        leg.joints, [](const LegJoint& joint) { return std::isfinite(joint.max_acceleration); });
  });
}

RobotModel WithAccelerations(RobotModel robot, const std::optional<double>& assumed) {
  if (!assumed) return robot;
  AssumedAcceleration of_joints{.limit = *assumed};
  for (Leg& leg : robot.legs) {
    for (LegJoint& joint : leg.joints) {
      if (std::isfinite(joint.max_acceleration)) continue;
      joint.max_acceleration = *assumed;
      ++of_joints.joints;
    }
  }
  if (of_joints.joints > 0) robot.assumed_acceleration = of_joints;
  return robot;
}

}  // namespace halfstep::verify
