#pragma once

#include "planner/scene/scene.h"

namespace halfstep {

/// A scene without its obstacles that move.
Scene RestingPart(const Scene& scene);
/// Nothing but the obstacles that move, on the scene's ground, without areas and files.
Scene MovingPart(const Scene& scene);

}  // namespace halfstep
