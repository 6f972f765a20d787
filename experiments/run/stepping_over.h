#pragma once

#include <string>

#include "planner/scene/scene.h"
#include "planner/swept/swept_volumes.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// Why no half-step of a set leads over an obstacle that rests, wherever it would stand and however
/// it would be turned: too short, or too low, in figures. "": one does, or the feet do not rise to
/// its top at all. Looked at across the obstacle's narrower side seen from above, in front of its
/// middle, with nothing else in the scene. `clearance` is what soles keep off obstacles [m].
std::string NoHalfStepOver(const Obstacle& obstacle, const RobotModel& robot,
                           const SweptVolumes& volumes, double clearance);

}  // namespace halfstep
