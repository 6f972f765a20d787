#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "planner/scene/scene.h"
#include "wpg/geometry/pose2.h"

namespace halfstep {

/// Areas of the floor that no sole may touch, prepared for questions about soles that stand. Const
/// and thread-safe.
class NoStepAreas {
 public:
  /// `sole_outline` is the outline of what touches the floor under either foot: a convex polygon
  /// (2×k) in the sole frame [m] (RobotModel::sole_outline).
  NoStepAreas(const Scene& scene, const Eigen::Matrix2Xd& sole_outline);

  bool empty() const { return areas_.empty(); }  ///< whether there are none
  /// The largest distance of a point of the outline from the sole frame's origin [m].
  double sole_reach() const { return reach_; }

  /// The area nearest to a sole.
  struct Nearest {
    double distance = std::numeric_limits<double>::infinity();  ///< by PolygonDistance [m]
    int area = -1;  ///< index into Scene::no_step; −1: there is none
  };
  /// The area that is nearest to a sole standing at X_WF. When the sole touches several areas, it
  /// is the one into which the sole reaches deepest.
  Nearest NearestTo(const Pose2& X_WF) const;

  /// Whether a sole that stands at X_WF touches no area and keeps `distance` ≥ 0 [m] from all.
  bool Clears(const Pose2& X_WF, double distance) const;

 private:
  struct Area {
    Eigen::Matrix2Xd polygon;
    Eigen::Vector2d center;  // of a circle around it [m]
    double radius = 0.0;
  };

  Eigen::Matrix2Xd outline_;
  double reach_ = 0.0;
  std::vector<Area> areas_;
};

}  // namespace halfstep
