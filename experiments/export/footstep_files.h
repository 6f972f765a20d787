#pragma once

#include <string>

#include "wpg/motion/half_step_sequence.h"

namespace halfstep {

/// The footsteps as humanoid_nav_msgs/StepTarget[] in YAML: a list `footsteps` of
/// `pose: {x, y, theta}` of the sole [m], [rad] and `leg` (0 right, 1 left), without where the feet
/// stand at the start. Poses are those in W. Source: [HumanoidNavMsgs].
std::string StepTargetsYaml(const HalfStepSequence& sequence);

}  // namespace halfstep
