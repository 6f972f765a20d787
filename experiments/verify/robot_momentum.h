#pragma once

#include <Eigen/Core>

#include "wpg/motion/walk_state.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::verify {

/// Where the floor's force on the whole robot has no horizontal moment, in W [m], when the walk's
/// quantities have these values and derivatives. Every body counts as six point masses with its
/// mass, centre and inertia; their accelerations are differences of eighth order of the places that
/// inverse and forward kinematics give them while the quantities go along the parabola of `jet`.
/// Nothing of the dynamics that the prover uses. nan where masses are not known, a leg does not
/// reach or the floor does not push.
Eigen::Vector2d RobotZmp(const RobotModel& robot, const WalkJet& jet, double gravity);

}  // namespace halfstep::verify
