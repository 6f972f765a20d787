#pragma once

#include <Eigen/Core>
#include <vector>

#include "experiments/tables/csv_reader.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// The ZMP of the whole robot at each row of a trajectory.csv, in W [m]; not a number where a leg
/// does not reach, masses are not known, or the floor does not push. The CoM's derivatives are the
/// rows', all others central differences of the rows, so it is for drawing: nothing is proved of
/// it. Throws InputError where a column is missing or no number. Source: wpg/README.md, "Dynamics
/// of the whole robot".
std::vector<Eigen::Vector2d> RobotZmps(const RobotModel& robot, const CsvTable& trajectory);

}  // namespace halfstep
