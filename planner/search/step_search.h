#pragma once

#include <functional>
#include <memory>
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

/// Weighted A*, begun anew with smaller weights. Edges are taken in the order of cost so far plus
/// weight times guess, and the query is asked only then. A cell that was reached is not entered
/// again. Source: restarts as in [Richter2010].
///
/// In time, states carry when they are reached and the safe interval in which they may be kept
/// [Phillips2011], edges rest as long as they have to, and the cost is the duration of the walk. Of
/// states in one cell that may be kept equally long, the earliest counts; with a weight above 1 the
/// first that was reached, and the search with the next weight, at last with 1, says whether there
/// is more.
class StepSearch {
 public:
  using ToGo = std::function<StepsToGo(const StepState&)>;  ///< the estimates
  /// Borrows `graph`, `monitor` and, in time, `edges`; null: not in time.
  StepSearch(const std::vector<StepState>& starts, ToGo to_go, StepSearchOptions options,
             StepGraph* graph, PlanMonitor* monitor, TimedEdges* edges = nullptr);
  ~StepSearch();

  /// Searches on from where the monitor stopped it the last time, and offers plans. False when the
  /// monitor stopped it, true when it has ended by itself.
  bool Run();

 private:
  class Weighted;
  std::vector<StepState> starts_;
  ToGo to_go_;
  StepSearchOptions options_;
  StepGraph& graph_;
  PlanMonitor& monitor_;
  TimedEdges* edges_;
  size_t next_ = 0;  // of the weights
  std::unique_ptr<Weighted> search_;
};

}  // namespace halfstep
