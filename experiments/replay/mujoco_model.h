#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "experiments/control/joint_spring.h"
#include "experiments/replay/simulated_floor.h"
#include "experiments/replay/simulated_obstacles.h"
#include "wpg/robot/robot_model.h"
#include "wpg/robot/robot_tree.h"

namespace halfstep::replay {

/// What the simulated robot is made of beside its URDF; the numbers are HRP-2's (PhysicsOf() has
/// those of other sizes). Documented in experiments/replay.md, "Replay".
struct ModelOptions {
  double timestep = 0.0005;  ///< [s]; half or twice of it changes the ZMP's error by a millimetre
  /// Friction of the soles on the floor. At 0.2 the walks are the same; at 0.05 soles slip by
  /// centimetres.
  double friction = 0.7;
  /// Stiffness of the joints' servos [N m/rad]. Stiffer servos follow the plan more closely, until
  /// the contacts give way instead. 3000: bar_8cm drifts by centimetres; 700: it falls.
  double stiffness = 30000.0;
  double damping = 1000.0;      ///< [N m s/rad]; at 300 the robot sways for a second
  double armature = 0.1;        ///< rotor inertia at the joints [kg m²]; 0.01: soles slip more
  double contact_time = 0.005;  ///< of the contacts' spring [s], at least 2 time steps
  /// Inertias by principal axes. MuJoCo finds these only so well that joint torques are off by
  /// 1e-7.
  bool principal_axes = false;
  /// A passive bush between the last joint of each leg and all that it moves: hinges about the
  /// sole's y and x through the frame of that joint. None: the ankle is rigid.
  std::optional<control::JointSpring> ankle = {};
  /// Whether servos give no more than LegJoint::max_torque.
  bool torque_limits = false;
  Eigen::Vector2d com_shift{0, 0};  ///< of all links that no leg moves, along x and y of B [m]
  SimulatedFloor floor = {};        ///< what the soles stand on
};

/// The name of a link's body. MuJoCo calls its own root "world" and refuses a second body of that
/// name, so a link "world" is "world_", and, lest that be another link's, "world_" is "world__" and
/// so on. Every other name is the link's.
std::string BodyName(const std::string& link);

/// The robot as a MuJoCo model (MJCF), standing on the floor: the URDF's links with their
/// masses and inertias, a free base, hinges in the legs with servos (actuators: left leg from the
/// hip, then right), every other joint welded in the standing posture, and soles as boxes that
/// touch the ground and nothing else. Names are the URDF's, those of links as BodyName() says;
/// soles are "left_sole", "right_sole". Obstacles are mocap bodies in their order; with them the
/// robot gets its convex bodies, which touch obstacles and nothing else: "body_I" by their index in
/// RobotModel::bodies. The ground's solids are fixed, "solid_I" by their index; soles stand on
/// them, and bodies touch them, those of feet only above the sole's box ("body_I_above"). Without a
/// floor a site "floor" is where its plane would be. Principal moments of inertia below 1e-6 kg m²,
/// which MuJoCo refuses when they are 0, are raised to it.
std::string MujocoModel(const RobotModel& robot, const RobotTree& tree, const ModelOptions& options,
                        const std::vector<SimulatedObstacle>& obstacles = {});

}  // namespace halfstep::replay
