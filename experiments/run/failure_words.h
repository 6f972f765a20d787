#pragma once

#include <string>

#include "experiments/config/experiment.h"
#include "experiments/run/watched_query.h"
#include "planner/scene/scene.h"
#include "planner/search/footstep_planner.h"
#include "planner/swept/swept_volumes.h"

namespace halfstep {

/// Which key of the config ended a search without a plan, and what it had used; "": none did.
std::string BudgetWords(const PlannerConfig& config, const PlanResult& plan, double proof_effort);

/// How near to the goal supporting soles came; "": no half-step was asked about.
std::string NearestWords(const WatchedQuery& watched, const PlanRequest& request);

/// What hinders a walk.
struct Hindrance {
  std::string words = {};  ///< "": nothing was found
  /// An obstacle of the place that no half-step of the set leads over, though it is low enough for
  /// other ones; null: there is none.
  const Obstacle* in_the_way = nullptr;
};

/// What meets most of the half-steps that were refused nearest to the goal, each obstacle or
/// no-step area alone in the scene; and of an obstacle, whether the set leads over it or only the
/// room could lead past it. At most 200 obstacles near them are looked at.
Hindrance FindBlocking(const WatchedQuery& watched, const SweptVolumes& volumes, const Place& place,
                       const MarginLimits& limits);

/// The same in time, of what moves: what is in the way of most half-steps near the goal that are
/// not free at all times. "": nothing is.
std::string MovingWords(const WatchedTimes& watched, const SweptVolumes& volumes,
                        const Place& place);

/// Of a plan that was found and is a quarter longer than the straight way: what lies across that,
/// low and narrow as it is, because no half-step of the set leads over it.
Hindrance FindDetour(const PlanRequest& request, const PlanResult& plan,
                     const SweptVolumes& volumes, const Place& place, const MarginLimits& limits);

}  // namespace halfstep
