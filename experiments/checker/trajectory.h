#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "wpg/robot/urdf_file.h"

namespace halfstep::checker {

/// What a joint does between two knots, from what both knots tell.
enum class Interpolation {
  kLinear,  ///< by positions
  kCubic,   ///< by positions and velocities (Hermite)
  kQuintic  ///< by positions, velocities and accelerations (Hermite)
};
/// "linear" …
const char* Name(Interpolation interpolation);

/// A joint trajectory as its file has it: joints × knots. Positions of sliding joints, and so on,
/// are in metres.
struct Trajectory {
  std::string file;                 ///< for complaints
  std::vector<std::string> joints;  ///< their names
  std::vector<double> times;        ///< of the knots, growing [s]
  Eigen::MatrixXd q;                ///< positions [rad]
  Eigen::MatrixXd v;                ///< velocities [rad/s], or empty
  Eigen::MatrixXd a;                ///< accelerations [rad/s²], or empty
  /// Of the root link in W by knot, 7×knots: x, y, z [m], and the quaternion w, x, y, z (SetBase);
  /// empty: it is fixed at W. Between knots all seven go straight, or are cubic by their velocities
  /// (Hermite), and the rotation is that of the quaternion scaled to length 1.
  Eigen::MatrixXd base;
  /// Of the root link in W by knot, 6×knots: velocity of its origin [m/s] and angular velocity ω
  /// [rad/s], so that the quaternion q has the velocity ½ωq; empty: the base goes straight.
  Eigen::MatrixXd base_v;
  std::vector<std::string> unread;                       ///< columns of no joint
  Interpolation interpolation = Interpolation::kLinear;  ///< as chosen, or the most that there is
};

/// Names of a robot's joints.
struct JointNames {
  std::vector<std::string> moving;  ///< revolute, continuous and prismatic ones
  /// That move in another way, or whose axis or limits are missing.
  std::vector<std::string> others;
};
/// Of a URDF.
JointNames NamesOf(const UrdfTree& urdf);

/// Sets the base's poses, as Trajectory::base but for quaternions' lengths and signs: these become
/// 1, and such that neighbours turn into each other by the shorter way. Throws InputError for
/// lengths that are not within 1 % of 1, and for numbers beyond 1e6.
void SetBase(Eigen::MatrixXd poses, Trajectory* trajectory);
/// Sets Trajectory::base_v. Throws InputError for numbers beyond 1e6.
void SetBaseVelocities(Eigen::MatrixXd velocities, Trajectory* trajectory);
/// Sets what joints do between knots: as chosen, or by what is there, as ROS' controllers do. Where
/// linear is chosen the base goes straight, too. Throws InputError where it needs what is not
/// there.
void SetInterpolation(const std::optional<Interpolation>& chosen, Trajectory* trajectory);
/// Throws InputError for fewer than two knots, times that do not grow, no joint at all, joints that
/// are told twice or are of `others`, and numbers beyond 1e6.
void CheckNumbers(const Trajectory& trajectory, const JointNames& names);

/// Reads a trajectory; `interpolation` as for SetInterpolation.
///   .csv         a first column `t_s`, `t`, `time` or `time_s`; then joints' columns in any order:
///                NAME or q_NAME_rad, NAME_vel or v_NAME_rad_s, NAME_acc or a_NAME_rad_s2; and, if
///                the root moves, its base_x_m, base_y_m, base_z_m, and base_qw, base_qx, base_qy,
///                base_qz or base_roll_rad, base_pitch_rad, base_yaw_rad, all of them, and its
///                velocities base_vx_m_s …, base_wx_rad_s …, all six or none; also with `root_`,
///                and without units
///   .yaml        trajectory_msgs/JointTrajectory: joint_names, and points with positions,
///                velocities, accelerations, time_from_start
/// Columns of no joint are left out. Throws InputError with what is wrong, as the functions above,
/// and for velocities or accelerations of some joints only.
Trajectory ReadTrajectory(const std::string& path,
                          const std::optional<Interpolation>& interpolation,
                          const JointNames& names);

}  // namespace halfstep::checker
