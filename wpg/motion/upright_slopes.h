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

/// A number's gradient with respect to the parts of WaistSlope.
struct WaistGradient {
  Vector6d displacement, velocity, acceleration;  ///< per unit of each

  /// Adds the number's gradient with respect to the walk's quantities: the transpose of WaistSlope.
  void AddTo(const RobotModel& robot, const WalkJet& jet, const Posture& posture,
             const RobotDynamics& dynamics, WalkJet* by_jet) const;
};

/// Adds the gradient with respect to the walk's quantities of a number whose gradient with respect
/// to the sole's spatial acceleration is `by_sole`: the transpose of SoleAccelerationSlope.
void AddSoleAcceleration(Side side, const WalkJet& jet, const Posture& posture,
                         const RobotDynamics& dynamics, const Vector6d& by_sole, WalkJet* by_jet);

}  // namespace halfstep
