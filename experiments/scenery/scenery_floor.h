#pragma once

#include "experiments/scenery/scenery.h"

namespace halfstep {

/// How far above z = 0 the top of a floor may lie that is left out [m].
inline constexpr double kSceneryFloorTop = 1e-3;

/// Leaves out what is the floor, since the robot walks on z = 0: planes, and what lies wholly at or
/// below z = kSceneryFloorTop. Marks meshes whose triangles make at least a square metre of floor
/// facing up there, and sets what of clouds and maps is floor where most of their lower points lie
/// at z = 0. Tells each, and where a floor seems to lie at another height, by how much `--up`
/// brings it to 0. Throws InputError for a mesh, cloud or map that cannot be read.
void TakeFloorOut(Scenery* scenery);

}  // namespace halfstep
