#pragma once

#include <Eigen/Core>

#include "experiments/verify/played_motion.h"

namespace halfstep::verify {

/// z of a body's lowest point in W [m].
double LowestPoint(const RobotBody& body, const Placement& at);

/// Whether a body is rigid with a foot, which may touch the floor.
bool IsOnFoot(const RobotBody& body);

/// Distance [m] of a foot whose sole stands at X_WF from an area of the floor, a simple polygon
/// (2×n) in W; −1 when they share a point. The foot is the outline of what touches the floor
/// (RobotModel::sole_outline). Whether they meet is found by clipping the area's edges with the
/// convex outline, which is not the planner's way.
double FromArea(const RobotModel& robot, const Pose2& X_WF, const Eigen::Matrix2Xd& area);

}  // namespace halfstep::verify
