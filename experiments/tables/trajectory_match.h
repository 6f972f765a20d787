#pragma once

#include <string>

#include "experiments/tables/csv_reader.h"
#include "smoothing/walk/superposed_walk.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// Where the rows of a trajectory.csv are not those of a walk: a sentence on the first number that
/// is off by more than 1e-6 (in its column's unit), or on an end at another time; "" when all rows
/// are the walk's. Margins are not compared. Throws InputError for a table without the columns of
/// this robot's motion.
std::string TrajectoryMismatch(const RobotModel& robot, const SuperposedWalk& walk,
                               const CsvTable& trajectory);

}  // namespace halfstep
