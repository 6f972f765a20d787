#include "experiments/verify/tolerances.h"

#include <algorithm>
#include <cmath>

#include "experiments/verify/robot_numbers.h"

namespace halfstep::verify {
namespace {

constexpr double kLegLength = 0.705;    // of HRP-2 [m]
constexpr double kOfWeight = 2.5e-6;    // of m·g·ℓ: 1e-3 N m for HRP-2
constexpr double kOfLeastLimit = 1e-3;  // of the least limit of a joint

double LeastLimit(const RobotModel& robot, double LegJoint::*limit) {
  double least = std::numeric_limits<double>::infinity();
  for (const Leg& leg : robot.legs) {
    for (const LegJoint& joint : leg.joints) least = std::min(least, joint.*limit);
  }
  return least;
}

}  // namespace

Tolerances::Tolerances(const RobotModel& robot)
    : size(LegLength(robot) / kLegLength),
      time(std::sqrt(size)),
      played(1e-3 * size),
      length(1e-9 * size),
      sole(1e-6 * size),
      pendulum(1e-8 * size),
      row(1e-8 * size),
      column(1e-8 * size),
      claim(1e-7 * size),
      joint_speed(1e-6 / time),
      momentum(1e-7 * size),
      torque(std::min(kOfWeight * robot.mass * kGravity * LegLength(robot),
                      kOfLeastLimit * LeastLimit(robot, &LegJoint::max_torque))),
      friction(1e-6),
      acceleration(
          std::min(1e-5 / size, kOfLeastLimit * LeastLimit(robot, &LegJoint::max_acceleration))),
      distance(2e-6 * size),
      slab(2e-6 * std::max(1.0, size)),
      inside(1e-9 * time),
      speed_step(1e-5 * time),
      momentum_step(2e-3 * time),
      acceleration_step(5e-4 * time) {}

}  // namespace halfstep::verify
