#pragma once

#include <Eigen/Core>
#include <vector>

#include "experiments/tables/csv_reader.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// Where the ground's force passes through the plane halfway between the soles that stand.
struct RobotZmp {
  Eigen::Vector2d zmp;   ///< in W [m]
  Eigen::Vector2d tilt;  ///< RobotDynamics::Tilt
};

/// The ZMP of the whole robot at each row of a trajectory.csv; not a number where a leg does not
/// reach, masses are not known, or the ground does not push. The CoM's derivatives are the rows',
/// all others central differences of the rows, so it is for drawing: nothing is proved of it.
/// Throws InputError where a column is missing or no number. Source: wpg/README.md, "Dynamics of
/// the whole robot" and "Soles at different heights".
std::vector<RobotZmp> RobotZmps(const RobotModel& robot, const CsvTable& trajectory);

}  // namespace halfstep
