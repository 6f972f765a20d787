#pragma once

#include <string>
#include <vector>

#include "experiments/tables/trajectory_file.h"
#include "wpg/robot/robot_tree.h"

namespace halfstep {

/// The texts of the files that hrpsys' SequencePlayer loads under one base name. Every line: the
/// time and numbers, separated by blanks, in the shortest form that reads back to the same double.
/// Lines are a whole period apart, so that a player of that period takes one line a cycle; the last
/// one repeats the walk's end at the next multiple.
/// Source: [hrpsys] SequencePlayer: seqplay.cpp, loadPattern; interpolator.cpp, load.
struct HrpsysFiles {
  std::string pos;     ///< time, angles of all joints [rad]
  std::string zmp;     ///< time, ZMP x y z in the waist frame B [m]
  std::string waist;   ///< time, B in W: x y z [m], roll pitch yaw [rad]
  std::string joints;  ///< the joints of `pos`, a name a line; not read by hrpsys
};

/// `joints`: indices into `tree.urdf.joints` in the order of `pos`. Joints outside the legs keep
/// the standing posture. Every `stride`-th row, `period` [s] apart.
HrpsysFiles WriteHrpsys(const RobotModel& robot, const RobotTree& tree,
                        const std::vector<int>& joints, const std::vector<TrajectoryRow>& rows,
                        size_t stride, double period);

/// The joints that each of `patterns` (globs) matches, pattern by pattern, in the URDF file's order
/// within one; all of them in that order without patterns. Throws InputError when a joint is
/// matched twice or not at all, or a pattern matches none.
std::vector<int> OrderedJoints(const RobotTree& tree, const std::vector<std::string>& patterns);

}  // namespace halfstep
