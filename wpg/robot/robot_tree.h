#pragma once

#include <array>
#include <string>
#include <vector>

#include "wpg/robot/robot_model.h"
#include "wpg/robot/urdf_file.h"

namespace halfstep {

/// All links and joints of a robot, for programs that need the whole machine (simulation, joint
/// files); RobotModel has its legs only.
struct RobotTree {
  UrdfTree urdf;                ///< links and joints as the file has them
  int waist = -1;               ///< link index
  std::array<int, 2> feet{};    ///< link indices by Index(Side)
  std::vector<double> posture;  ///< standing posture by joint index [rad]
};

/// A robot as walking needs it, with all of its URDF.
struct WholeRobot {
  RobotModel model;  ///< its legs, bodies and masses
  RobotTree tree;    ///< all of its joints
};

/// LoadRobot() and the tree, both from one reading of the robot file and its URDF. Throws
/// InputError.
WholeRobot LoadWholeRobot(const std::string& yaml_path);

/// Angles of all joints by URDF joint index [rad]: those of the legs are `q` (by Index(Side)), all
/// others those of the standing posture.
std::vector<double> JointAngles(const RobotModel& robot, const RobotTree& tree,
                                const std::array<Vector6d, 2>& q);

/// Indices of the revolute joints in the order in which the URDF file has them.
std::vector<int> JointsInFileOrder(const UrdfTree& urdf);

}  // namespace halfstep
