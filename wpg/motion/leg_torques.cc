#include "wpg/motion/leg_torques.h"

#include "wpg/nth.h"

namespace halfstep {

Vector6d LegTorques(const RobotDynamics& dynamics, Side side, const Vector6d& on_foot) {
  Vector6d torques, carried = -on_foot;
  for (Eigen::Index j = 6; j-- > 0;) {
    const RobotDynamics::Body& link = Nth(dynamics.leg(side), j);
    carried += link.force;
    torques[j] = link.screw.dot(carried);
  }
  return torques;
}

Vector6d LegTorqueSlopes(const RobotDynamics& dynamics, const DynamicsSlope& slope, Side side,
                         const Vector6d& on_foot, const Vector6d& on_foot_slope) {
  Vector6d slopes, carried = -on_foot, carried_slope = -on_foot_slope;
  for (Eigen::Index j = 6; j-- > 0;) {
    const RobotDynamics::Body& link = Nth(dynamics.leg(side), j);
    const DynamicsSlope::Link& change = Nth(slope.leg(side), j);
    carried += link.force;
    carried_slope += change.force;
    slopes[j] = change.screw.dot(carried) + link.screw.dot(carried_slope);
  }
  return slopes;
}

}  // namespace halfstep
