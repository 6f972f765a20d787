#pragma once

#include "wpg/motion/dynamics_rounding.h"
#include "wpg/motion/motion_bounds.h"
#include "wpg/motion/robot_dynamics.h"

namespace halfstep {

/// How far rounding may carry the accelerations of a leg's joints at the midpoint of an interval
/// [rad/s²]: what they miss of the sole's acceleration, and what may be missing in that, through
/// the inverse Jacobian. +∞ where nothing can be said. `motion` was bounded with rounding;
/// `dynamics` are of its midpoint, `waist` is of its waist's twist and origin. Source:
/// smoothing/README.md, "Rounding", 3.
Vector6d AccelerationRounding(const IntervalMotion& motion, const RobotDynamics& dynamics,
                              const BodyRounding& waist, Side side, double gravity);

}  // namespace halfstep
