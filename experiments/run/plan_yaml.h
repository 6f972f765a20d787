#pragma once

#include <string>

#include "experiments/run/planning.h"

namespace halfstep {

/// The footsteps of a plan as a config has them, before them what of `half_step` differs from the
/// config that was planned with. Precondition: there are footsteps.
std::string PlanYaml(const PlannedWalk& walk);

}  // namespace halfstep
