#pragma once

#include <functional>
#include <vector>

#include "planner/search/plan_search.h"
#include "planner/search/pose_cells.h"

namespace halfstep {

/// What is left from a state to the goal, in footsteps. Infinity: the state is not wanted.
struct StepsToGo {
  double bound = 0.0;  ///< a lower bound: what cannot beat the best plan is left out
  double guess = 0.0;  ///< what orders the search
};

struct StepSearchOptions {
  /// Of the guess; each is searched anew, from the largest. After 1 with guess ≤ bound, the plan is
  /// the cheapest, as far as the cells tell states apart.
  std::vector<double> weights = {5.0, 2.5, 1.5, 1.0};
  PoseCells cells;
};

/// Weighted A*, begun anew with smaller weights. Edges are looked at in the order of cost so far
/// plus weight times guess and asked about only then. A cell that was reached is not entered again.
/// True: nothing cheaper is left. Source: restarts as in [Richter2010].
bool SearchSteps(const std::vector<StepState>& starts,
                 const std::function<StepsToGo(const StepState&)>& to_go,
                 const StepSearchOptions& options, StepGraph* graph, PlanMonitor* monitor);

}  // namespace halfstep
