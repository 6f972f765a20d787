#pragma once

#include "wpg/robot/robot_model.h"

namespace halfstep::verify {

inline constexpr double kGravity = 9.81;  ///< [m/s²]

/// ω = √(g/z_c) of the robot's pendulum [1/s].
double PendulumRate(const RobotModel& robot);
/// Hip–ankle distance of a stretched leg [m].
double StretchedLength(const Leg& leg);
/// ℓ: from the hip to the knee's axis, from there to the ankle, and from there down to the sole
/// [m].
double LegLength(const RobotModel& robot);
/// Whether the robot file limits any joint's acceleration.
bool LimitsAccelerations(const RobotModel& robot);

}  // namespace halfstep::verify
