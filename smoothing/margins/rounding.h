#pragma once

#include "wpg/motion/walk_state.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// What is added to the bounds of proofs for the rounding of postures, margins and forces: one
/// number for each kind, made from the robot, so that it is enough for a giant and does not eat up
/// what a dwarf has. Rounding is not bounded formally; each number is a hundred times and more what
/// was seen. Lengths go by the leg's length ℓ, accelerations of joints by 1/ℓ as a pendulum's do,
/// torques by m·g·ℓ.
class Rounding {
 public:
  /// That of a robot's walks.
  explicit Rounding(const RobotModel& robot);

  /// Of a place, an angle or a speed where the walk's quantities are these [m, rad, m/s, rad/s]:
  /// 1e-12 for robots with legs of up to 1 m within 10 m of the origin of W, and more in proportion
  /// to the length and to the way from there. On random intervals true displacements exceeded their
  /// bounds, which can be zero, by up to 2e-15 m.
  double Of(const WalkState& quantities) const;

  /// Of the whole robot's ZMP [m]. Joint accelerations are differences of nearly equal numbers, and
  /// those of legs without closed form follow from angles with residuals of 3e-14.
  double zmp;
  /// Of joint torques [N m]: the feet's shares multiply the ZMP's.
  double torque;
  double friction;      ///< of the needed coefficient of friction
  double acceleration;  ///< of joint accelerations [rad/s²]

 private:
  double length_;
};

}  // namespace halfstep
