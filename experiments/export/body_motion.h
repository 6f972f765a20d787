#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string>
#include <vector>

#include "smoothing/walk/superposed_walk.h"
#include "wpg/robot/robot_tree.h"

namespace halfstep {

/// All links and joints of a robot at an instant of a walk, with exact first derivatives: those of
/// the walk's closed form, not differences. Places and velocities are in W.
struct BodyFrame {
  double t = 0.0;                         ///< [s]
  std::array<bool, 2> stands{};           ///< whether a sole carries, by Index(Side)
  Eigen::Vector3d com{0, 0, 0};           ///< of the walk's model [m]
  std::vector<double> q;                  ///< by URDF joint index [rad]
  std::vector<double> speeds;             ///< the same [rad/s]
  std::vector<Eigen::Isometry3d> X_W;     ///< poses of the links, by URDF link index
  std::vector<Eigen::Vector3d> velocity;  ///< of the links' origins [m/s]
  std::vector<Eigen::Vector3d> turn;      ///< angular velocities of the links [rad/s]
};

/// The links and joints of a robot in the order in which MuJoCo has those of its URDF: a link
/// before what hangs on it, a branch before the next, branches as the file has their joints.
struct BodyOrder {
  std::vector<int> links;   ///< URDF link indices, the root first
  std::vector<int> joints;  ///< URDF joint indices, the revolute ones
};

/// Makes frames of a robot's walks.
class BodyMotion {
 public:
  /// Reads the robot file, and the URDF that it names. Throws InputError.
  explicit BodyMotion(const std::string& robot_yaml);

  const RobotModel& robot() const { return robot_.model; }  ///< as walking needs it
  /// Links and joints; link frames are those of the URDF file, that of the waist as well.
  const RobotTree& tree() const { return robot_.tree; }

  /// Without `all_links` those alone that can move by a revolute joint, and the root: links that
  /// are fixed to another are one body with it, as where MuJoCo reads a URDF. Joints of other
  /// kinds than revolute and fixed are welded at 0, and so are their links.
  BodyOrder Order(bool all_links) const;

  /// The frame at t [s], which is clamped to the walk's time. Joints outside the legs keep the
  /// standing posture. Throws InputError where a leg is stretched so far that its joint speeds have
  /// no bound; `path` stands for the walk in the complaint.
  BodyFrame At(const SuperposedWalk& walk, double t, const std::string& path) const;

 private:
  WholeRobot robot_;
  RobotTree still_;            // joints outside the legs have no speeds
  Eigen::Matrix3d R_LinkB_;    // the waist frame B seen from the waist's link
  std::vector<int> to_waist_;  // joints from the waist up to the root
};

/// Frames 1/fps apart [1/s] from 0 to the first such instant at which the walk has ended, where it
/// is at rest: at least two.
std::vector<BodyFrame> FramesOf(const BodyMotion& motion, const SuperposedWalk& walk, int fps,
                                const std::string& path);

}  // namespace halfstep
