#pragma once

#include <functional>
#include <string>
#include <vector>

#include "planner/search/footstep_planner.h"
#include "planner/search/step_graph.h"
#include "planner/search/timed_edges.h"

namespace halfstep {

/// A chain of elements from a state to the goal.
struct StepPlan {
  StepState start;      ///< where it begins, a foot in the air
  std::vector<int> ks;  ///< places in StepGraph::elements()
  double cost = 0.0;    ///< of start and chain, by PlanRequest::cost
  /// In time: how each of `ks` is taken. Else empty.
  std::vector<TimedEdge> timed = {};
};

/// The states along a plan, the last of them its landing on the goal, and what it costs to get to
/// each.
struct PlanStates {
  std::vector<StepState> states;  ///< one more than the plan has elements
  std::vector<double> costs;      ///< of PlanRequest::cost, as many
};
/// In time with `edges`; null: not in time, or the costs do not matter.
PlanStates StatesOf(const StepGraph& graph, const StepPlan& plan,
                    const TimedEdges* edges = nullptr);

/// Counts nodes, asks the termination and keeps the plans found, on behalf of one call of Plan.
class PlanMonitor {
 public:
  /// Both are borrowed; `graph` tells how many queries there were.
  PlanMonitor(const PlanRequest& request, const StepGraph& graph)
      : request_(request), graph_(graph) {}

  /// Whether to stop; true from then on. To be asked before every node.
  bool Stop();
  /// From now on Stop() is also true after that much more effort, until the next call of it:
  /// several searches then take turns. ∞: as it was at first.
  void Allow(double effort) { turn_ends_ = progress_.effort() + effort; }
  /// Whether planning is over, not only this search's turn.
  bool stopped() const { return reason_ != StopReason::kGoOn; }
  void CountNode();                            ///< to be called for each node
  void CountSample() { ++progress_.samples; }  ///< for each sample of a tree that came to no node
  /// Keeps a plan if it is cheaper than all before, and returns whether it is.
  bool Offer(StepPlan plan);

  double best_cost() const { return progress_.cost; }  ///< of the best plan so far; ∞: none
  const std::vector<StepPlan>& plans() const { return plans_; }  ///< each cheaper than the last
  StopReason reason() const { return reason_; }                  ///< why Stop() returned true
  /// Counted so far; the queries of the last Stop().
  const PlanProgress& progress() const { return progress_; }
  /// Until the first plan, by the clock [s]; NaN: no plan or no clock.
  double time_to_first() const { return time_to_first_; }
  double elapsed() const;  ///< NaN without a clock [s]
  /// Forgets the plans and why it stopped.
  void StartOver();

 private:
  const PlanRequest& request_;
  const StepGraph& graph_;
  PlanProgress progress_;
  StopReason reason_ = StopReason::kGoOn;
  double turn_ends_ = std::numeric_limits<double>::infinity();
  std::vector<StepPlan> plans_;
  double begin_ = request_.clock ? request_.clock() : 0.0;
  double time_to_first_ = std::numeric_limits<double>::quiet_NaN();
};

/// Why a search ended.
struct SearchEnd {
  bool exhausted = false;     ///< nothing is left to search; else the monitor said stop
  std::string sentence = {};  ///< why there is no plan when exhausted; empty: a default
};

/// Searches from `starts` and offers plans to the monitor.
using PlanSearch = std::function<SearchEnd(const std::vector<StepState>& starts, StepGraph* graph,
                                           PlanMonitor* monitor)>;

/// Runs `search` and does what all planners share: checks the preconditions, handles a start that
/// is a goal or blocked, asks `accepts`, searches again without what was refused, and writes the
/// sentence of the result.
PlanResult PlanWith(const PlanRequest& request, const std::vector<int>& elements,
                    const PlanSearch& search);

/// The footsteps of a plan.
std::vector<Footstep> FootstepsOf(const PlanRequest& request, const StepGraph& graph,
                                  const StepPlan& plan);

}  // namespace halfstep
