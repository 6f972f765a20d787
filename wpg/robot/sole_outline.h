#pragma once

#include <Eigen/Core>

#include "wpg/robot/robot_model.h"

namespace halfstep {

/// The outline of a foot where it touches a floor: the convex hull of the sole rectangle and of the
/// projections of those points of the feet's bodies that are less than 1 mm above their sole's
/// plane, both feet in one outline (2×k, k ≥ 4, counter-clockwise, in the sole frame) [m]. Round
/// parts are widened by their radius, so the outline may be larger than what touches, never
/// smaller.
Eigen::Matrix2Xd SoleOutline(const RobotModel& robot);

/// The same of all points of the feet's bodies, at whatever height: the outline of a foot from
/// above.
Eigen::Matrix2Xd FootOutline(const RobotModel& robot);

/// How far the bodies of a leg's foot reach below its sole's plane [m]: ≤ 0 when they do not, −∞
/// without bodies.
double DepthBelowSole(const RobotModel& robot, Side side);

}  // namespace halfstep
