#pragma once

#include <optional>

#include "wpg/robot/robot_model.h"

namespace halfstep::verify {

inline constexpr double kGravity = 9.81;  ///< [m/s²]

/// ω = √(g/z_c) of the pendulum of a robot that crouches so far [m], [1/s].
double PendulumRate(const RobotModel& robot, double crouch = 0);
/// Hip–ankle distance of a stretched leg [m].
double StretchedLength(const Leg& leg);
/// ℓ: from the hip to the knee's axis, from there to the ankle, and from there down to the sole
/// [m].
double LegLength(const RobotModel& robot);
/// Whether any joint's acceleration is limited, by the robot file or an assumption.
bool LimitsAccelerations(const RobotModel& robot);
/// The robot, with an assumed limit [rad/s²] of those leg joints' accelerations of which its file
/// states none. Precondition: nothing is assumed of it yet.
RobotModel WithAccelerations(RobotModel robot, const std::optional<double>& assumed);

}  // namespace halfstep::verify
