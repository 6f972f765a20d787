#include "wpg/robot/torque_limits.h"

#include <cmath>

namespace halfstep {

std::vector<std::string> JointsOfUnknownTorque(const RobotModel& robot) {
  std::vector<std::string> names;
  for (const Leg& leg : robot.legs) {
    for (const LegJoint& joint : leg.joints) {
      if (std::isinf(joint.max_torque)) names.push_back(joint.name);
    }
  }
  return names;
}

std::string TorqueFault(const RobotModel& robot) {
  if (!robot.masses.known()) return robot.masses.fault;
  if (JointsOfUnknownTorque(robot).size() < 12) return "";
  return "the URDF has no effort limit of a leg joint (effort_limits_n_m of the robot file)";
}

}  // namespace halfstep
