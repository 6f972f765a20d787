#pragma once

#include "wpg/robot/robot_model.h"

namespace halfstep {

/// What is added to the bounds of proofs for the rounding of forces and joint accelerations: one
/// number for each kind, made from the robot, so that it is enough for a giant and does not eat up
/// what a dwarf has. These are not derived; each is a hundred times and more what was seen. Lengths
/// go by the leg's length ℓ, accelerations of joints by 1/ℓ as a pendulum's do, torques by m·g·ℓ.
/// Of places, angles and speeds rounding is bounded: IntervalMotion::rounding.
struct Rounding {
  /// That of a robot's walks.
  explicit Rounding(const RobotModel& robot);

  /// Of the whole robot's ZMP [m]. Joint accelerations are differences of nearly equal numbers, and
  /// those of legs without closed form follow from angles with residuals of 3e-14.
  double zmp;
  /// Of joint torques [N m]: the feet's shares multiply the ZMP's.
  double torque;
  double friction;      ///< of the needed coefficient of friction
  double acceleration;  ///< of joint accelerations [rad/s²]
};

}  // namespace halfstep
