#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "wpg/robot/robot_model.h"

namespace halfstep {

/// What a robot or a simulator plays of a row of trajectory.csv. Places are in W.
struct TrajectoryRow {
  double t = 0.0;                ///< [s]
  std::array<bool, 2> stands{};  ///< whether a sole carries, by Index(Side), as are the others
  Eigen::Vector2d zmp{0, 0};     ///< in W [m]
  /// Of the plane in which the walk's point mass has its ZMP, in W: Z(z) − z_c of its height z, by
  /// differences of neighbouring rows [m]. 0 in walks whose soles stand at z = 0 only.
  double zmp_z = 0.0;
  Eigen::Vector4d waist{0, 0, 0, 0};     ///< x, y, z [m], yaw [rad]
  std::array<Eigen::Vector4d, 2> soles;  ///< the same of the soles
  std::array<Vector6d, 2> q;             ///< joint angles [rad]

  Eigen::Isometry3d X_WB() const { return Upright(waist); }  ///< the waist's pose in W; upright
  /// The pose of an upright frame at x, y, z [m] and yaw [rad].
  static Eigen::Isometry3d Upright(const Eigen::Vector4d& place);
};

/// Fills TrajectoryRow::zmp_z of a walk's rows.
void FindZmpPlanes(const RobotModel& robot, std::vector<TrajectoryRow>* rows);

/// Reads a trajectory.csv of this robot: at least two rows, times that increase, finite numbers.
/// Throws InputError as path:line: column: … .
std::vector<TrajectoryRow> ReadTrajectory(const std::filesystem::path& path,
                                          const RobotModel& robot);
/// The same for a file's text; `path` stands for it in complaints.
std::vector<TrajectoryRow> ParseTrajectory(const std::string& path, const std::string& text,
                                           const RobotModel& robot);

/// The methods of a run folder by their names, raw first; only `method` when it is given. Throws
/// InputError for what is no whole run folder, and for a method that it does not have.
std::vector<std::string> MethodsOfRun(const std::string& run,
                                      const std::optional<std::string>& method);

}  // namespace halfstep
