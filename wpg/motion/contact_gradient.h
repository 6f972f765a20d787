#pragma once

#include <array>

#include "wpg/motion/robot_dynamics.h"

namespace halfstep {

/// The gradient of a number that depends on what the floor gives (RobotDynamics::contact), with
/// respect to the walk's quantities and the legs' joints: the transpose of DynamicsSlope::contact.
/// Its change along a tangent is the sum of its products with the tangent's parts. Exact, by one
/// sweep from the soles to the waist, of vectors only. Source: wpg/README.md, "Dynamics of the
/// whole robot"; [Singh2022].
struct ContactGradient {
  WalkJet jet;                     ///< of the walk's quantities, in W
  std::array<Vector6d, 2> q;       ///< of joint angles [1/rad], by Index(Side)
  std::array<Vector6d, 2> speeds;  ///< of joint speeds [s/rad]

  /// `by_contact`: the number's gradient with respect to contact(), about the dynamics' O, which is
  /// held where it is.
  ContactGradient(const RobotModel& robot, const WalkJet& jet, const Posture& posture,
                  const RobotDynamics& dynamics, const Vector6d& by_contact);
};

}  // namespace halfstep
