#pragma once

#include "planner/scene/obstacle_motion.h"
#include "wpg/files/fields.h"

namespace halfstep {

/// The largest coordinate of a place in a scene file [m].
inline constexpr double kFarthestPlace = 1000.0;

/// Declares the keys of an obstacle's `motion` (planner/README.md, "Scenes"). Complains about
/// waypoints that are not in the order of their times.
void DeclareMotion(Fields& fields, ObstacleMotion* motion);

}  // namespace halfstep
