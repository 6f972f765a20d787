#pragma once

#include <functional>

#include "experiments/config/experiment.h"
#include "experiments/run/planning.h"
#include "planner/search/half_step_query.h"
#include "planner/search/half_step_times.h"
#include "planner/search/step_set.h"
#include "planner/swept/swept_volumes.h"

namespace halfstep {

/// A search of footsteps, with what differs between what says that half-steps are free. All is
/// borrowed.
struct FootstepSearch {
  const StepSet& set;          ///< of the half-steps
  const HalfStepQuery& query;  ///< of the set; in time it answers for what rests
  std::function<double(const Pose2&, double)> ground = {};  ///< as in PlanRequest
  std::function<double()> effort = {};    ///< of the query; empty: as the planner counts it
  const HalfStepTimes* times = nullptr;   ///< as in PlanRequest
  const SweptVolumes* volumes = nullptr;  ///< what the query asks, if it asks volumes
};

/// Plans with walk->config, with the planner that it names, and writes the plan, or why there is
/// none, into the walk.
void SearchFootsteps(const FootstepSearch& search, const Place& place, const PlanningHooks& hooks,
                     PlannedWalk* walk);

/// The place without what moves.
Place Resting(const Place& place);

}  // namespace halfstep
