#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/scene/scene.h"

namespace halfstep::plot {

/// What two of the coordinates of an obstacle cover at the start of the walk, as polygons without
/// common meaning of their order [m]: one hull for what is convex, else a triangle each.
/// `first` and `second` are indices of coordinates: 0 and 1 from above, 0 and 2 from the side.
std::vector<std::vector<Eigen::Vector2d>> Silhouette(const Obstacle& obstacle, int first,
                                                     int second);

}  // namespace halfstep::plot
