#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "wpg/robot/robot_model.h"

namespace halfstep {

/// A limit of a leg's joint that walking cannot meet: a number that stands for "not known".
struct PlaceholderLimit {
  std::string joint;  ///< its name
  std::string why;    ///< which limit, and against what it is so large
};

/// The torque that the robot's weight asks of a leg's joint at most, standing on that leg [N m]:
/// m·g times the farthest that a corner of the sole is from the joint's axis in the standing
/// posture. Source: wpg/README.md, "Limits that are placeholders".
double TorqueByWeight(const RobotModel& robot, const Leg& leg, size_t joint);

/// The limits of leg joints that are placeholders: torques of more than 10 times TorqueByWeight,
/// speeds of more than 10 √(g/ℓ), accelerations of more than 100 g/ℓ, with ℓ the leg's length, and
/// ranges within 1 % of a whole turn. Left leg first; of one joint in this order.
std::vector<PlaceholderLimit> PlaceholderLimits(const RobotModel& robot);

}  // namespace halfstep
