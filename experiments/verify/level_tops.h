#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "planner/scene/scene.h"
#include "wpg/geometry/pose2.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::verify {

/// The levels of a scene's ground on which soles may stand, from its prisms alone: a level is the
/// union of the tops of its height, or all of z = 0 where the floor is, less what prisms occupy
/// that reach through that height. How far inside a sole lies is found by cutting from a square
/// around it all that bears: what is left, and what stands there, it has to keep off (FromArea).
/// The planner finds borders instead. Written from planner/README.md, "Levels". Borrows the scene.
class LevelTops {
 public:
  explicit LevelTops(const Scene& scene) : scene_(scene) {}  ///< borrowed

  /// Whether there is one level everywhere: then nothing else here may be asked.
  bool even() const { return scene_.ground->OnlyLevel().has_value(); }

  /// How far inside the level at z [m] the outline of what touches the ground under a sole at X_WF
  /// lies [m]; −1 where part of it does not, or touches a border.
  double Inside(const RobotModel& robot, const Pose2& X_WF, double z) const;
  /// The height of the highest level that bears a sole at X_WF [m]; none where none does. `only`:
  /// that of the only level which is meant.
  std::optional<double> HeightUnder(const RobotModel& robot, const Pose2& X_WF,
                                    const std::optional<double>& only) const;
  /// The height of the level of a surface's name, or of "floor" [m]; none where there is none.
  std::optional<double> HeightNamed(const std::string& name) const;

 private:
  // Parts of a window where nothing bears at z.
  std::vector<Eigen::Matrix2Xd> Missing(const Eigen::Matrix2Xd& window, double z) const;

  const Scene& scene_;
};

}  // namespace halfstep::verify
