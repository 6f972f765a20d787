#pragma once

#include <array>

#include "wpg/motion/robot_dynamics.h"
#include "wpg/nth.h"

namespace halfstep {

/// How the walk's quantities and joints change along one homotopy parameter, or in time. Per unit
/// of that parameter.
struct DynamicsTangent {
  const WalkJet& jet;                     ///< of the walk's quantities
  const std::array<Vector6d, 2>& q;       ///< [rad], by Index(Side)
  const std::array<Vector6d, 2>& speeds;  ///< [rad/s]
};

/// The derivative of RobotDynamics along one tangent: of each leg link's screw and force, of the
/// joints' accelerations, and of what the floor gives. Exact, by one sweep from the waist to the
/// soles. Where one number of what the floor gives is asked for along many tangents,
/// ContactGradient is faster. About the dynamics' O, which is held where it is. Source:
/// wpg/README.md, "Dynamics of the whole robot".
class DynamicsSlope {
 public:
  /// Derivatives of one link's joint screw and of the force that moves it.
  struct Link {
    Vector6d screw, force;  ///< spatial vectors: turn or moment, then translation or force
  };

  /// Per unit of the parameter that `tangent` belongs to.
  DynamicsSlope(const RobotModel& robot, const WalkJet& jet, const Posture& posture,
                const RobotDynamics& dynamics, const DynamicsTangent& tangent);

  /// Its six links, from the hip down.
  const std::array<Link, 6>& leg(Side side) const { return Nth(legs_, Index(side)); }
  /// Of RobotDynamics::accelerations [rad/s² per unit].
  const Vector6d& accelerations(Side side) const { return Nth(accelerations_, Index(side)); }
  const Vector6d& contact() const { return contact_; }  ///< of RobotDynamics::contact

 private:
  std::array<std::array<Link, 6>, 2> legs_;
  std::array<Vector6d, 2> accelerations_;
  Vector6d contact_;
};

}  // namespace halfstep
