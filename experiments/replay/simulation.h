#pragma once

#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "experiments/control/tracking_controller.h"
#include "experiments/replay/simulated_obstacles.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::replay {

/// A sentence that says why this build cannot simulate robots; "" when it can.
std::string WhyNoSimulation();
/// Version of the engine, "" without one.
std::string EngineVersion();

/// Joint angles of both legs by Index(Side) [rad], and their speeds [rad/s].
struct JointTargets {
  std::array<Vector6d, 2> q;      ///< joint angles by Index(Side) [rad]
  std::array<Vector6d, 2> speed;  ///< of the joints [rad/s]
};

/// What the ground does to the soles that are on it during a time step, in W.
struct FloorForces {
  std::array<double, 2> vertical{};  ///< on each sole, by Index(Side) [N]
  Eigen::Vector2d horizontal{0, 0};  ///< Σ of the forces along the floor [N]
  /// Σ vertical · place − height · horizontal [N m]; / Σ vertical: the measured ZMP, in the plane
  /// z = 0. That in the plane z = h is h Σ horizontal / Σ vertical aside of it.
  Eigen::Vector2d moment{0, 0};
  Eigen::Vector2d pressure{0, 0};  ///< the same, places seen from above whatever their height
  double total() const { return vertical[0] + vertical[1]; }  ///< of both soles [N]
};

/// A body of the robot and an obstacle in contact.
struct Touch {
  /// Index of RobotModel::bodies; beyond these the left and the right sole, whose side is against a
  /// solid of the ground.
  int body = 0;
  int obstacle = 0;    ///< index of the obstacles; beyond these that of the ground's solids
  double force = 0.0;  ///< of all their contact points together [N]
};

/// How the robot moves at an instant, in W.
struct RobotMotion {
  Eigen::Isometry3d X_WB;                  ///< pose of the waist
  Eigen::Vector3d velocity, acceleration;  ///< of the waist's origin [m/s], [m/s²]
  Eigen::Vector3d turn, turn1;             ///< ω of the waist [rad/s], and ω̇ [rad/s²]
  std::array<Vector6d, 2> q, speeds, accelerations;  ///< of the legs' joints by Index(Side)
};

/// What such a motion takes where nothing touches the robot.
struct RobotForces {
  Eigen::Vector3d force, moment;    ///< on the robot, about the waist's origin, in W [N], [N m]
  std::array<Vector6d, 2> torques;  ///< of the legs' joints by Index(Side) [N m]
};

/// A simulated robot of MujocoModel among obstacles. A copy continues independently from the same
/// state.
class Simulation {
 public:
  /// Precondition: WhyNoSimulation() is "". Throws std::runtime_error with MuJoCo's reason for a
  /// model that it refuses. `obstacles` are those of the model.
  Simulation(const std::string& mjcf, const RobotModel& robot, const std::string& waist_link,
             const std::vector<SimulatedObstacle>& obstacles = {});
  ~Simulation();
  Simulation(const Simulation& other);  ///< in the same state, independent from then on
  Simulation& operator=(const Simulation&) = delete;

  double timestep() const;  ///< [s]
  /// The weight of the model [N].
  double weight() const;
  /// The model's floor (SimulatedFloor::X_WFloor); where the robot begins on a plate, that plate's
  /// height.
  Eigen::Isometry3d X_WFloor() const;
  /// Length and width of a sole [m].
  Eigen::Vector2d sole_size() const;

  /// Places the robot at rest with the waist at X_WB, servos holding q, and the obstacles where
  /// they are at t = 0.
  void Place(const Eigen::Isometry3d& X_WB, const std::array<Vector6d, 2>& q);
  /// The keyframes of the model, and their state: robot and obstacles as keyframe `index` has them.
  int num_keyframes() const;
  void PlaceAtKeyframe(int index);  ///< index ∈ [0, num_keyframes())
  /// Makes one time step: the servos follow `targets`, `push` [N] in W acts on the waist's CoM.
  /// Throws std::runtime_error when the simulation becomes unstable.
  FloorForces Step(const JointTargets& targets, const Eigen::Vector3d& push);
  /// Inverse dynamics in the air, rotors (ModelOptions::armature) included. The robot is elsewhere
  /// afterwards: Place() it.
  RobotForces Needed(const RobotMotion& motion);
  /// Puts the obstacles where they are at the time t of the walk [s].
  void MoveObstacles(double t);
  /// The robot's contacts with obstacles, and with the ground but for what soles stand on, in the
  /// last time step, one for each pair of bodies.
  std::vector<Touch> touches() const;

  Eigen::Isometry3d X_WB() const;  ///< pose of the waist
  /// Pose of an obstacle, by its index.
  Eigen::Isometry3d X_WObstacle(int index) const;
  /// Pose of a sole's centre.
  Eigen::Isometry3d X_WSole(Side side) const;
  /// The CoM of all links, in W [m].
  Eigen::Vector3d com() const;
  /// What perfect sensors would say now, with the soles' loads of the last time step. `t` is left
  /// 0.
  control::MeasuredState Measure() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace halfstep::replay
