#pragma once

#include <vector>

#include "planner/search/plan_search.h"
#include "planner/search/pose_cells.h"
#include "planner/search/step_search.h"

namespace halfstep {

/// What a beam keeps.
struct BeamOptions {
  int width = 128;       ///< states of as many footsteps that go on, ≥ 1
  PoseCells cells = {};  ///< of states in one cell, one that costs less than those before
  double weight = 1.0;   ///< of the guess, ≥ 0
};

/// Beam search: of all states that n footsteps lead to, the `width` of least cost so far plus
/// weight times guess lead to those of n + 1, until none is left that may be part of a plan cheaper
/// than the best. Where guesses are too low A* stays with short beginnings, which look cheap; a
/// beam compares only what has as many footsteps. It leaves out what is worse than its width, so
/// that its end proves nothing. Offers plans to `monitor`, until that stops it. Not in time.
/// Source: [Lowerre1976].
void SearchBeam(const std::vector<StepState>& starts, const StepSearch::ToGo& to_go,
                const BeamOptions& options, StepGraph* graph, PlanMonitor* monitor);

}  // namespace halfstep
