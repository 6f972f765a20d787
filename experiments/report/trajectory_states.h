#pragma once

#include <vector>

#include "experiments/tables/csv_reader.h"
#include "wpg/motion/walk_state.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// The quantities of a robot's walk at each row of a trajectory.csv, [m] and [rad]; the places of
/// the ZMP, which a posture does not ask for, are 0. Throws InputError where a column is missing or
/// no number.
std::vector<WalkState> StatesOf(const RobotModel& robot, const CsvTable& trajectory);

}  // namespace halfstep
