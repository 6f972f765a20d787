#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "wpg/geometry/side.h"
#include "wpg/robot/leg_ik.h"

namespace halfstep {

/// A small robot described by its left leg at q = 0 in the waist frame; the right one mirrors it.
struct GeneratedRobot {
  std::string name;
  std::array<Eigen::Vector3d, 6> axes;  ///< need not be normalized.
  Eigen::Vector3d hip{0, 0.08, -0.05};
  Eigen::Vector3d thigh{0, 0, -0.3};        ///< hip point to knee.
  Eigen::Vector3d shank{0, 0, -0.3};        ///< knee to ankle point.
  Eigen::Vector3d foot{0.02, 0.01, -0.09};  ///< ankle point to sole centre.
  /// Shift of each joint's origin along its axis [m].
  std::array<double, 6> slide{};
  /// Whether mirrored joints turn the same way (+1) or the opposite way (−1) for the same motion.
  double right_sign = 1;
  /// Turns the link frames at q = 0 away from the waist frame's [rad]; 0: parallel.
  double frame_tilt = 0;
  /// How far each axis is moved off hip, knee or ankle point [m]; all 0: a closed-form leg.
  std::array<Eigen::Vector3d, 6> offset = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, 0, 0),
                                           Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, 0, 0),
                                           Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, 0, 0)};
};

/// Three robots unlike HRP-2: other orders of axes, ankle roll before pitch, offset knees, axes not
/// orthogonal, link frames not parallel.
std::vector<GeneratedRobot> GeneratedRobots();
/// Three robots whose hip or ankle axes do not meet, with offsets as public humanoids have them:
/// hip yaw and roll meet, pitch ahead and below of both; ankle axes apart, hip nearly spherical;
/// hip pitch first and no two axes meet.
std::vector<GeneratedRobot> OffsetRobots();
/// The leg that LoadRobot should find, made without URDF; standing posture by inverse kinematics,
/// limits one radian around it.
Leg MakeLeg(const GeneratedRobot& robot, Side side);
namespace generated {
/// A vector as URDF has it.
std::string Text(const Eigen::Vector3d& v);
}  // namespace generated

/// URDF text of the robot. Bodies: box waist and thigh, cylinder shank, sphere ankle, box foot.
std::string GeneratedUrdf(const GeneratedRobot& robot);
/// The robot file to go with it, which names the URDF `urdf_name` in its own folder.
std::string GeneratedYaml(const GeneratedRobot& robot, const std::string& urdf_name);

/// A robot's two files in a folder of its own, which goes with it.
class TemporaryRobot {
 public:
  explicit TemporaryRobot(const GeneratedRobot& robot)
      : TemporaryRobot(robot.name, GeneratedUrdf(robot), GeneratedYaml(robot, "robot.urdf")) {}
  TemporaryRobot(const std::string& name, const std::string& urdf, const std::string& yaml);
  ~TemporaryRobot();
  TemporaryRobot(const TemporaryRobot&) = delete;
  TemporaryRobot& operator=(const TemporaryRobot&) = delete;

  /// How many there were before, so that robots of one name do not share a folder.
  static int Count();

  std::string yaml_path() const { return (folder_ / "robot.yaml").string(); }
  RobotModel Load() const { return LoadRobot(yaml_path()); }

 private:
  std::filesystem::path folder_;
};

}  // namespace halfstep
