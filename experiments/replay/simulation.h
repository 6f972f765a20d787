#pragma once

#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <string>
#include <utility>

#include "wpg/robot/robot_model.h"

namespace halfstep::replay {

/// A sentence that says why this build cannot simulate robots; "" when it can.
std::string WhyNoSimulation();
/// Version of the engine, "" without one.
std::string EngineVersion();

/// Joint angles of both legs by Index(Side) [rad], and their speeds [rad/s].
struct JointTargets {
  std::array<Vector6d, 2> q;
  std::array<Vector6d, 2> speed;
};

/// What the floor does to the robot during a time step, in W.
struct FloorForces {
  std::array<double, 2> vertical{};  ///< on each sole, by Index(Side) [N]
  Eigen::Vector2d moment{0, 0};  ///< Σ vertical · place [N m]; / Σ vertical: the measured ZMP
  double total() const { return vertical[0] + vertical[1]; }
};

/// A simulated robot of MujocoModel. A copy continues independently from the same state.
class Simulation {
 public:
  /// Precondition: WhyNoSimulation() is "". Throws std::runtime_error with MuJoCo's reason for a
  /// model that it refuses.
  Simulation(const std::string& mjcf, const RobotModel& robot, const std::string& waist_link);
  ~Simulation();
  Simulation(const Simulation& other);
  Simulation& operator=(const Simulation&) = delete;

  double timestep() const;
  /// The weight of the model [N].
  double weight() const;

  /// Places the robot at rest with the waist at X_WB.
  void Place(const Eigen::Isometry3d& X_WB, const std::array<Vector6d, 2>& q);
  /// Makes one time step: the servos follow `targets`, `push` [N] in W acts on the waist's CoM.
  /// Throws std::runtime_error when the simulation becomes unstable.
  FloorForces Step(const JointTargets& targets, const Eigen::Vector3d& push);

  Eigen::Isometry3d X_WB() const;
  /// Pose of a sole's centre.
  Eigen::Isometry3d X_WSole(Side side) const;
  /// The CoM of all links, in W [m].
  Eigen::Vector3d com() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace halfstep::replay
