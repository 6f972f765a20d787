#pragma once

#include "wpg/motion/dynamics_slope.h"
#include "wpg/motion/robot_dynamics.h"

namespace halfstep {

/// Torques of a leg's joints, from the waist down, when its foot gets the wrench `on_foot` from the
/// floor [N m]: what the motors give, for joints without friction and rotors without inertia of
/// their own. `on_foot` is about the dynamics' O. Source: wpg/README.md, "Joint torques".
Vector6d LegTorques(const RobotDynamics& dynamics, Side side, const Vector6d& on_foot);

/// Their derivative along the tangent of `slope` when `on_foot` changes by `on_foot_slope`.
Vector6d LegTorqueSlopes(const RobotDynamics& dynamics, const DynamicsSlope& slope, Side side,
                         const Vector6d& on_foot, const Vector6d& on_foot_slope);

}  // namespace halfstep
