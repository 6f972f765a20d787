#pragma once

#include <functional>
#include <vector>

#include "planner/search/plan_search.h"
#include "planner/search/pose_cells.h"

namespace halfstep {

/// Estimates of the footsteps from a state to the goal. Infinity: the state shall not be entered.
struct StepsToGo {
  double bound = 0.0;  ///< a lower bound, to leave out what cannot beat the best plan
  double guess = 0.0;  ///< an estimate, to order the search
};

/// Options of a search by weighted costs.
struct StepSearchOptions {
  /// Weights of the guess, largest first; each makes a search of its own. After 1 with guess ≤
  /// bound, the plan is the cheapest, as far as the cells tell states apart.
  std::vector<double> weights = {5.0, 2.5, 1.5, 1.0};
  PoseCells cells;  ///< states in one cell count as one
};

/// Weighted A*, restarted with smaller weights. Edges are taken in the order of cost so far plus
/// weight times guess, and the query is asked only then. A cell that was reached is not entered
/// again. Returns true when it ended by itself, false when the monitor stopped it. Source: restarts
/// as in [Richter2010].
bool SearchSteps(const std::vector<StepState>& starts,
                 const std::function<StepsToGo(const StepState&)>& to_go,
                 const StepSearchOptions& options, StepGraph* graph, PlanMonitor* monitor);

}  // namespace halfstep
