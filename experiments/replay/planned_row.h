#pragma once

#include "experiments/tables/trajectory_file.h"
#include "smoothing/walk/superposed_walk.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::replay {

/// The row of trajectory.csv that a walk has at t [s]; before and after the walk it is that of its
/// ends. Precondition: the legs reach where the walk puts the feet.
TrajectoryRow PlannedRow(const RobotModel& robot, const SuperposedWalk& walk, double t);

}  // namespace halfstep::replay
