#pragma once

#include <Eigen/Core>

#include "planner/scene/scene.h"

namespace halfstep {

/// The rectangle around an obstacle seen from above whose first edge is shortest, of 72 directions.
struct ObstacleFootprint {
  Eigen::Vector2d across, along;   ///< unit vectors of W: over its narrower side, and along it
  double near = 0.0, far = 0.0;    ///< its bounds on `across` [m]
  double left = 0.0, right = 0.0;  ///< its bounds on `along` [m]
  double top = 0.0;                ///< z of the obstacle's highest point in W [m]
  double depth() const { return far - near; }  ///< [m]

  /// Whether the straight line between two points of the floor, of which one is at or before `near`
  /// and one at or beyond `far` on `across`, passes over the rectangle: in its middle.
  bool IsBetween(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
};

/// Of an obstacle at its pose.
ObstacleFootprint FootprintOf(const Obstacle& obstacle);

/// Whether the straight line between two points of the floor crosses the rectangle, its depth
/// grown by 1 cm on both sides.
bool LiesAcross(const ObstacleFootprint& print, const Eigen::Vector2d& from,
                const Eigen::Vector2d& to);

}  // namespace halfstep
