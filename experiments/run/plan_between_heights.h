#pragma once

#include "experiments/run/planning.h"
#include "planner/search/step_set.h"

namespace halfstep {

/// Plans with walk->config and half-steps at two heights of the waist, the config's and `lower`,
/// and with half-steps that lead from one to the other, and writes the plan, or why there is none,
/// into the walk. All are proved on an empty floor with the config's pendulum, and called free by
/// their swept volumes; those between the heights are few: ahead, back, aside and turns
/// (ClassicSubset). Preconditions: nothing moves, the ground is one level.
void PlanBetweenHeights(const Place& place, const StepSet::Form& lower, const PlanningHooks& hooks,
                        PlannedWalk* walk);

/// Whether the waist is not at the config's height everywhere in a plan.
bool ChangesHeight(const PlannedWalk& walk);

}  // namespace halfstep
