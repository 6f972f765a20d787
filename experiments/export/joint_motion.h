#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "experiments/tables/trajectory_file.h"
#include "smoothing/walk/superposed_walk.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// A row of a trajectory, and how it goes on: derivatives of the walk in closed form, not
/// differences of rows.
struct JointMotion {
  TrajectoryRow row;                        ///< the instant, soles, waist and joint angles
  std::array<Vector6d, 2> speeds;           ///< of the legs' joints by Index(Side) [rad/s]
  std::array<Vector6d, 2> accelerations;    ///< [rad/s²]
  Eigen::Vector3d waist_velocity{0, 0, 0};  ///< of B's origin in W [m/s]
  double waist_yaw_rate = 0.0;              ///< [rad/s]
};

/// Every `stride`-th row and the last, but those within a microsecond of the last, with the
/// derivatives of `walk`, whose rows they are. `path` stands for the rows in complaints. Throws
/// InputError where a leg is stretched so far that its joint speeds have no bound.
std::vector<JointMotion> MotionOfRows(const RobotModel& robot, const SuperposedWalk& walk,
                                      const std::vector<TrajectoryRow>& rows, size_t stride,
                                      const std::string& path);

}  // namespace halfstep
