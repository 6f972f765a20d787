#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/collision/collision_world.h"
#include "planner/scene/scene.h"
#include "planner/search/plan_search.h"

namespace halfstep {

/// A box that stands for the whole walking robot: centred on the middle of its feet and turned with
/// them, on the level where they stand.
struct RobotBox {
  double length = 0.7;      ///< along x [m] > 0
  double width = 0.9;       ///< along y [m] > 0
  double height = 1.6;      ///< [m] > 0
  double feet_apart = 0.2;  ///< of the feet beside each other [m] > 0
};

/// The grid of poses at which the box is checked.
struct BoxGrid {
  double spacing = 0.05;  ///< [m] > 0. Coarse: narrow passages are missed; fine: slow
  int yaws = 16;          ///< in a full turn, counted from the start's yaw, ≥ 4
};

/// A box among the obstacles and the no-step areas of a scene, both of which it must not touch.
class BoxWorld {
 public:
  /// Borrows the scene. Precondition: a box as above (std::logic_error).
  BoxWorld(const Scene& scene, const RobotBox& box);
  /// Whether the box, its middle of the feet at X_WM, touches nothing.
  bool IsClear(const Pose2& X_WM) const;
  const RobotBox& box() const { return box_; }  ///< as given
  /// Height on which the box stands [m]; not a number where the ground has levels, among which it
  /// finds no path.
  double level() const { return level_; }

 private:
  const Scene& scene_;
  RobotBox box_;
  double level_;
  CollisionWorld world_;
  CollisionShape shape_;
};

/// A path of the box, or why there is none.
struct [[nodiscard]] BoxPath {
  std::vector<Pose2> path;     ///< of the middle of the feet, from the start; empty: no path
  bool stopped = false;        ///< by the monitor
  bool start_blocked = false;  ///< the box touches something where it begins
};

/// A* over the grid, by steps to the eight neighbours and turns; walking sideways and backwards
/// costs more. The box is checked at the poses of the grid only, not between them. Every pose
/// checked counts as a node. The path ends where the part that shall reach the goal is within a
/// grid step of the region.
BoxPath FindBoxPath(const BoxWorld& world, const BoxGrid& grid, const Pose2& X_WM,
                    const GoalRegion& goal, const Eigen::AlignedBox2d& workspace,
                    PlanMonitor* monitor);

}  // namespace halfstep
