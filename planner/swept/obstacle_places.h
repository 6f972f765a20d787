#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <vector>

#include "planner/scene/scene.h"

namespace halfstep {

/// A pose of an obstacle's shape, which is to be grown by `extra` [m] in all directions.
struct ObstaclePlace {
  Eigen::Isometry3d X_WO;  ///< in W
  double extra = 0.0;      ///< ≥ 0 [m]
};

/// Places that together contain the obstacle at every time of [0, until] [s], wherever its
/// uncertainty lets it be. An obstacle without waypoints has one place, grown by its largest
/// uncertainty. Known motion is cut into parts in which no point moves by more than 2 cm, or into
/// 400 when these are more; each part has the pose of its middle, grown by half of its way besides.
/// Throws InputError, naming the obstacle, when its uncertainty has no bound: a speed without a
/// horizon, and no `until`.
std::vector<ObstaclePlace> PlacesOf(const Obstacle& obstacle,
                                    double until = std::numeric_limits<double>::infinity());

/// Throws as PlacesOf does for any obstacle of the scene, all complaints at once.
void CheckPlaces(const Scene& scene, double until = std::numeric_limits<double>::infinity());

}  // namespace halfstep
