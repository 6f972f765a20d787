#pragma once

#include <string>
#include <vector>

#include "experiments/export/joint_motion.h"
#include "experiments/replay/mujoco_model.h"

namespace halfstep::replay {

/// MujocoModel() of the ground, with the obstacles where they are at t = 0, their names as <custom>
/// texts, and a keyframe for each of `motion`, "t=0.05" …: place and speed of the waist's tree,
/// angles and speeds of the legs' joints, the servos' targets, and where the obstacles are then.
/// One file that needs no other: MuJoCo's `simulate` loads it, and its keys walk through the
/// motion.
std::string MujocoKeyframes(const RobotModel& robot, const RobotTree& tree,
                            const SimulatedObstacles& world,
                            const std::vector<JointMotion>& motion);

}  // namespace halfstep::replay
