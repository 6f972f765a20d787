#pragma once

#include "experiments/run/planning.h"

namespace halfstep {

/// After a search with `config` in which half-steps of its set do not lead over walk->in_the_way:
/// plans with a set of another form that does (FormsOver), and keeps that plan where it is the only
/// one, or leads over the obstacle and costs less; else the walk says what was missed.
/// Precondition: as PlanByVolumes has it. Throws InputError. Source: planner/README.md, "Over an
/// obstacle".
void PlanOver(const ExperimentConfig& config, const Place& place, const PlanningHooks& hooks,
              PlannedWalk* walk);

}  // namespace halfstep
