#pragma once

#include <vector>

#include "experiments/tables/trajectory_file.h"
#include "wpg/robot/robot_tree.h"

namespace halfstep::replay {

/// The ZMP that the planned motion has by itself when every link is a point mass at its CoM, for
/// each row [m], in W: the planned ZMP is that of a single mass at constant height. Accelerations
/// by differences of neighbouring rows; the first and the last row are at rest. Joints outside the
/// legs keep the standing posture.
///     p = Σ m (x (z̈ + g) − (z − h) ẍ) / Σ m (z̈ + g), the same for y,
/// in the plane h = TrajectoryRow::zmp_z of the planned one.
/// Source: [Kajita2001], with several masses.
std::vector<Eigen::Vector2d> MassModelZmp(const RobotModel& robot, const RobotTree& tree,
                                          const std::vector<TrajectoryRow>& rows);

}  // namespace halfstep::replay
