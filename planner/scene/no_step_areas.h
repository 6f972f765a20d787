#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "planner/scene/scene.h"
#include "wpg/geometry/footprint.h"

namespace halfstep {

/// Areas of the floor that no sole may touch, prepared for questions about soles that stand. Const
/// and thread-safe.
class NoStepAreas {
 public:
  /// `sole_outline`: what of a foot touches the floor, a convex polygon (2×k) in the sole frame
  /// [m], of either foot (RobotModel::sole_outline).
  NoStepAreas(const Scene& scene, const Eigen::Matrix2Xd& sole_outline);

  bool empty() const { return areas_.empty(); }
  /// Of the outline from the sole frame's origin, at most [m].
  double sole_reach() const { return reach_; }

  struct Nearest {
    double distance = std::numeric_limits<double>::infinity();  ///< PolygonDistance [m]
    int area = -1;  ///< index into Scene::no_step; −1: there is none
  };
  /// The area nearest to a sole that stands at X_WF; of those that it touches, the deepest.
  Nearest NearestTo(const Footprint& X_WF) const;

  /// Whether a sole that stands at X_WF touches no area and keeps `distance` ≥ 0 [m] from all.
  bool Clears(const Footprint& X_WF, double distance) const;

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
