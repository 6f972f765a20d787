#pragma once

#include <Eigen/Core>

#include "experiments/replay/mujoco_model.h"
#include "experiments/replay/player.h"
#include "experiments/replay/seed_draws.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::replay {

/// What is not known of a robot and its floor, and what happens to it. Documented in
/// experiments/replay.md, "Replay".
struct Disturbance {
  double friction = 0.7;            ///< of the soles on the floor
  double contact_time = 0.005;      ///< ModelOptions::contact_time [s]
  double stiffness_share = 1.0;     ///< of the servos' stiffness
  Eigen::Vector2d com_shift{0, 0};  ///< ModelOptions::com_shift [m]
  Push push;                        ///< on the waist

  /// The same robot, disturbed. The push is not in it.
  ModelOptions Applied(ModelOptions model) const;
};

/// Draws one for a walk that ends at `duration` [s], in the order of the members: friction from 0.5
/// to 0.8, the time constant from that of the robot's size to twice that, stiffness ± 10 %, the CoM
/// ± 1 cm along x and y, the push's instant, then its direction; its impulse is 2 N s in 0.1 s.
/// What has a unit is HRP-2's and scaled by RobotScale.
Disturbance DrawDisturbance(const RobotModel& robot, double duration, SeedDraws* draws);

}  // namespace halfstep::replay
