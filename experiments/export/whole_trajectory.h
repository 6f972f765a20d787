#pragma once

#include "experiments/tables/csv_columns.h"
#include "experiments/tables/csv_reader.h"
#include "wpg/robot/robot_tree.h"

namespace halfstep {

/// What an exported trajectory says besides, or otherwise.
struct TrajectoryForm {
  bool all_joints = false;        ///< also the joints outside the legs, which keep their posture
  bool waist_quaternion = false;  ///< waist_qw, qx, qy, qz in place of waist_yaw_rad
};

/// A table and what its columns are.
struct DeclaredTable {
  CsvTable table;      ///< texts, as they are read
  CsvColumns columns;  ///< of the table, in its order
};

/// A trajectory.csv in that form. Further joints come after those of the legs, in the URDF file's
/// order. The quaternion is X_WB's, of unit length; its sign is such that no component jumps from
/// row to row, and qw ≥ 0 in the first. Cells that stay are as they were, to the byte. Throws
/// InputError when the table's columns are not those of this robot's trajectory.
DeclaredTable InForm(CsvTable trajectory, const RobotModel& robot, const RobotTree& tree,
                     const TrajectoryForm& form);

}  // namespace halfstep
