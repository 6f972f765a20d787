#pragma once

#include <memory>

#include "planner/ground/level_borders.h"
#include "planner/scene/scene.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// At which heights the ground of a scene bears a robot's soles. Const and thread-safe.
class SoleHeights {
 public:
  /// Soles stand inside their level by `foothold` ≥ 0 [m].
  SoleHeights(const RobotModel& robot, const Scene& scene, double foothold);

  /// The height [m] of the highest level that bears a sole at X_WF, seen from above, and is no
  /// farther than `most` [m] above or below `from`; NaN: none.
  double At(const Pose2& X_WF, double from, double most) const;

 private:
  std::shared_ptr<const Ground> ground_;
  Eigen::Matrix2Xd outline_;
  double foothold_;
  LevelBorders borders_;
};

}  // namespace halfstep
