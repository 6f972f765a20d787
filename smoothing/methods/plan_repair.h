#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "smoothing/methods/plan_change.h"

namespace halfstep {

/// What became of a plan whose half-steps, one after the other, miss a demand.
struct PlanRepair {
  HalfStepSequence sequence;      ///< with other durations and heights in `steps`
  std::vector<PlanChange> steps;  ///< that were changed; empty: the plan was feasible as it was
  /// A sentence on each step that was not made feasible; empty: the whole plan was proved.
  std::vector<std::string> failures;
  bool stopped = false;  ///< by the stop token, before it came to an end
};

/// Makes a plan feasible by the durations and the heights of its steps. In a plan nothing overlaps,
/// so each step is looked at by itself. A step that `test` refuses is first asked whether its
/// footprints alone miss a demand: at rest before and after it nothing depends on time or height,
/// so then it cannot be made at all ("footstep 4 cannot be made at any duration and height: reach
/// −0.031 m"). Else longer durations and other heights are tried, the shortest duration first and
/// the planned height first, those that miss least in samples are proved, and the duration is
/// lowered by bisection to within 1 %. A step for which nothing is proved is told with what it
/// misses least, which is no proof that there is nothing. The repaired plan is proved as a whole.
PlanRepair RepairPlan(const HalfStepSequence& plan, const FeasibilityTest& test,
                      const ChangeRange& range, const std::stop_token& stop);

}  // namespace halfstep
