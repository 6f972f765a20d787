#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace halfstep::checker {

/// What a joint does between two knots, from what both knots tell.
enum class Interpolation {
  kLinear,  ///< by positions
  kCubic,   ///< by positions and velocities (Hermite)
  kQuintic  ///< by positions, velocities and accelerations (Hermite)
};
/// "linear" …
const char* Name(Interpolation interpolation);

/// A joint trajectory as its file has it: joints × knots.
struct Trajectory {
  std::string file;                                      ///< for complaints
  std::vector<std::string> joints;                       ///< their names
  std::vector<double> times;                             ///< of the knots, growing [s]
  Eigen::MatrixXd q;                                     ///< positions [rad]
  Eigen::MatrixXd v;                                     ///< velocities [rad/s], or empty
  Eigen::MatrixXd a;                                     ///< accelerations [rad/s²], or empty
  std::vector<std::string> unread;                       ///< columns of no joint
  Interpolation interpolation = Interpolation::kLinear;  ///< as chosen, or the most that there is
};

/// Names of a robot's joints.
struct JointNames {
  std::vector<std::string> turning;  ///< revolute and continuous ones
  std::vector<std::string>
      others;  ///< that move in another way, or whose axis or limits are missing
};

/// Reads a trajectory; `interpolation`: none is told by what the file has, as ROS' controllers do.
///   .csv         a first column `t_s`, `t`, `time` or `time_s`; then joints' columns in any order:
///                NAME or q_NAME_rad, NAME_vel or v_NAME_rad_s, NAME_acc or a_NAME_rad_s2
///   .yaml        trajectory_msgs/JointTrajectory: joint_names, and points with positions,
///                velocities, accelerations, time_from_start
/// Columns of no joint are left out. Throws InputError with the line of what is wrong: fewer than
/// two knots, times that do not grow, numbers beyond 1e6, one of the other joints,
/// velocities or accelerations of some joints only, or not what an interpolation needs.
Trajectory ReadTrajectory(const std::string& path,
                          const std::optional<Interpolation>& interpolation,
                          const JointNames& names);

}  // namespace halfstep::checker
