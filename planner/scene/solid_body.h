#pragma once

#include "planner/scene/scene.h"

namespace halfstep {

/// A solid of the ground as a body at rest under its name, for what keeps off obstacles: a box
/// where its polygon is a rectangle, else the hull of its corners.
/// Preconditions: finite numbers and a polygon with an area, bottom < top (std::logic_error).
Obstacle BodyOf(const GroundSolid& solid);

}  // namespace halfstep
