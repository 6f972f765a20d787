#pragma once

#include <string>
#include <vector>

#include "experiments/export/joint_motion.h"
#include "wpg/robot/robot_tree.h"

namespace halfstep {

/// A message trajectory_msgs/JointTrajectory of ROS 2 as YAML: header, joint_names, and a point for
/// each row with positions [rad], velocities [rad/s], accelerations [rad/s²], no effort, and
/// time_from_start. `joints`: indices into `tree.urdf.joints` in the order of joint_names; joints
/// outside the legs keep the standing posture. The message says nothing of the waist's place.
/// Positions are those of the rows, in the shortest form that reads back to the same double; times
/// are rounded to nanoseconds. Source: [RosTrajectory].
std::string JointTrajectoryYaml(const RobotModel& robot, const RobotTree& tree,
                                const std::vector<int>& joints,
                                const std::vector<JointMotion>& motion);

}  // namespace halfstep
