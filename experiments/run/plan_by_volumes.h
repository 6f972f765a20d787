#pragma once

#include <vector>

#include "experiments/run/obstacle_footprint.h"
#include "experiments/run/planning.h"
#include "wpg/geometry/foothold.h"

namespace halfstep {

/// What half-steps may lead over by their proofs.
struct LedOver {
  std::vector<ObstacleFootprint> obstacles;  ///< that count
  /// More places of the set, level, seen from a left support: they have no volumes. What is not
  /// certified on an empty floor is left out.
  std::vector<Foothold> landings;
};

/// Plans with walk->config and half-steps that are called free by their swept volumes, and, where
/// they lead over something, else by their proofs (CrossingQuery), and writes the plan, or why
/// there is none, into the walk. Precondition: nothing moves, or walk->in_time, where something is
/// led over. Throws InputError.
void PlanByVolumes(const Place& place, const PlanningHooks& hooks, PlannedWalk* walk,
                   const LedOver& over = {});

/// How far half-steps keep off obstacles [m]: each body as far as any of them may be from its
/// place.
double ClearanceOf(const ExperimentConfig& config, const RobotModel& robot);

/// Whether a foot starts where none may stand; then the walk says so.
bool StartsOnNoStep(const Place& place, PlannedWalk* walk);

}  // namespace halfstep
