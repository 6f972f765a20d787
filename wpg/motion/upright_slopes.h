#pragma once

#include "wpg/motion/robot_dynamics.h"

namespace halfstep {

/// How the waist's and a sole's motion change along a tangent of the walk's quantities. Spatial
/// vectors about the dynamics' O, which is held where it is. Per unit of the tangent.
struct WaistSlope {
  Vector6d displacement;  ///< of the waist's body, as a velocity per unit
  Vector6d velocity;      ///< of RobotDynamics::Body::velocity
  Vector6d acceleration;  ///< and of its acceleration

  /// Per unit of the parameter whose derivative of the walk is `tangent`.
  WaistSlope(const RobotModel& robot, const WalkJet& jet, const Posture& posture,
             const RobotDynamics& dynamics, const WalkJet& tangent);
};

/// Derivative of the sole's spatial acceleration that the walk demands.
Vector6d SoleAccelerationSlope(Side side, const WalkJet& jet, const Posture& posture,
                               const RobotDynamics& dynamics, const WalkJet& tangent);

}  // namespace halfstep
