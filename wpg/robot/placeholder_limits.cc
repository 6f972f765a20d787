#include "wpg/robot/placeholder_limits.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wpg/files/text.h"
#include "wpg/robot/gravity.h"
#include "wpg/robot/robot_legs.h"

namespace halfstep {
namespace {

constexpr double kTimes = 10.0;                 // what counts as beyond all use
constexpr double kOfATurn = 0.99;               // a range of so much of a whole turn is none
constexpr double kTurn = 2 * std::numbers::pi;  // [rad]

// "limit of 1e+09 N m is 4.5e+06 times".
std::string Times(const char* what, double limit, const char* unit, double usual) {
  return Formatted("its %s limit of %.3g %s is %.2g times ", what, limit, unit, limit / usual);
}

}  // namespace

double TorqueByWeight(const RobotModel& robot, const Leg& leg, size_t joint) {
  const LegFrames frames = PlaceLeg(leg, leg.standing_q);
  double farthest = 0.0;
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      const Eigen::Vector3d corner =
          frames.X_BLink[6] *
          Eigen::Vector3d(x * robot.sole_size.x(), y * robot.sole_size.y(), 0.0);
      farthest =
          std::max(farthest, frames.axis_B[joint].cross(corner - frames.point_B[joint]).norm());
    }
  }
  return robot.mass * kGravity * farthest;
}

std::vector<PlaceholderLimit> PlaceholderLimits(const RobotModel& robot) {
  std::vector<PlaceholderLimit> found;
  for (const Leg& leg : robot.legs) {
    const double rate = std::sqrt(kGravity / LengthOfLeg(leg));
    for (size_t j = 0; j < leg.joints.size(); ++j) {
      const LegJoint& joint = leg.joints[j];
      const auto add = [&](const std::string& why) { found.push_back({joint.name, why}); };
      const double torque = TorqueByWeight(robot, leg, j);
      if (std::isfinite(joint.max_torque) && joint.max_torque > kTimes * torque) {
        add(Times("torque", joint.max_torque, "N m", torque) +
            Formatted("the %.3g N m that the robot's weight asks of it at most", torque));
      }
      if (joint.max_speed > kTimes * rate) {
        add(Times("speed", joint.max_speed, "rad/s", rate) +
            Formatted("the %.3g rad/s of √(g/leg length), which walking does not come near", rate));
      }
      if (std::isfinite(joint.max_acceleration) &&
          joint.max_acceleration > kTimes * kTimes * rate * rate) {
        add(Times("acceleration", joint.max_acceleration, "rad/s²", rate * rate) +
            Formatted("the %.3g rad/s² of g/leg length, which walking does not come near",
                      rate * rate));
      }
      if (joint.upper - joint.lower > kOfATurn * kTurn) {
        add("its range is a whole turn, which is no limit of a leg");
      }
    }
  }
  return found;
}

}  // namespace halfstep
