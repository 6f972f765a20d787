#pragma once

#include <cstdint>
#include <vector>

#include "planner/search/plan_search.h"
#include "planner/search/stand_map.h"
#include "planner/search/step_search.h"

namespace halfstep {

/// A* for the fewest footsteps, whatever they cost, as one of the searches that take turns: many
/// plans have as few, so it soon finds one. Not in time.
class FewestSteps {
 public:
  /// All are borrowed but `starts` and `options`. Effort and plans are those of `monitor`, where a
  /// plan has the cost that `graph` says. `map`: tells ways around what is in between; null: none.
  FewestSteps(const PlanRequest& request, const std::vector<StepState>& starts,
              const StepSearchOptions& options, const StandMap* map, StepGraph* graph,
              PlanMonitor* monitor);
  FewestSteps(const FewestSteps&) = delete;
  FewestSteps& operator=(const FewestSteps&) = delete;

  /// Goes on until `monitor` stops it; whether it has ended by itself.
  bool Run();

 private:
  PlanRequest Counted(const PlanRequest& request);
  StepsToGo ToGo(const StepState& state) const;
  void Take();

  const StandMap* map_;
  StepGraph& graph_;
  PlanMonitor& monitor_;
  std::int64_t nodes_ = 0, queries_ = 0;  // told to monitor_ and graph_
  PlanRequest request_;                   // for the fewest footsteps
  StepGraph steps_;                       // where each costs 1
  PlanMonitor inner_;
  StepSearch search_;
  size_t taken_ = 0;  // of the plans of inner_
};

}  // namespace halfstep
