#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "smoothing/methods/plan_change.h"
#include "smoothing/proof/missed_demands.h"

namespace halfstep {

/// What makes one step feasible; nothing: it was not found.
struct StepRemedies {
  int step = 0;                   ///< from 0
  std::vector<PlanChange> found;  ///< each by itself
};

/// What was found by trying.
struct PlanRemedies {
  std::vector<PlanChange> of_all;  ///< changes of every step, each of which mends the plan
  /// Where a leg does not reach and no crouch is among these: the least with which legs reach [m],
  /// though other demands are missed then.
  std::optional<double> crouch_to_reach = {};
  std::vector<StepRemedies> steps;  ///< of those that miss most, the worst first
  bool together = false;            ///< whether the first of each step mends the whole plan
};

/// A plan as those know it who made it.
struct ChangeablePlan {
  HalfStepSequence sequence;  ///< as it is
  PlanChange usual;           ///< duration, height and crouch of steps that have none of their own
  /// The same with changes; none where it is no plan then: the ground does not bear a landing, or
  /// the via point is lower than a footstep.
  std::function<std::optional<HalfStepSequence>(const std::vector<PlanChange>&)> With;
};

/// What makes a plan feasible that misses demands: the height of the via point, the duration of the
/// half-steps, and where a footstep lands along its way. For the footsteps that miss most (three at
/// most) each of them is moved away from the planned one until the half-steps that it concerns are
/// feasible by the test; height and duration together where neither helps alone. Where several
/// footsteps miss a demand, height and duration of all of them are tried as well; and where a leg
/// does not reach, a lower waist. Nothing is tried among obstacles that move, since no step can be
/// looked at by itself; nothing is found when stopped.
PlanRemedies FindRemedies(const ChangeablePlan& plan, const FeasibilityTest& test,
                          const MissedDemands& missed, const std::stop_token& stop);

}  // namespace halfstep
