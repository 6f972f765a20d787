#pragma once

#include "planner/search/footstep_planner.h"
#include "planner/search/plan_search.h"
#include "planner/search/pose_cells.h"

namespace halfstep {

/// Options of FootstepRrt.
struct RrtOptions {
  /// Share of the samples that lie in the goal ∈ [0, 1]. Small: many nodes in open space; 1: never
  /// looks for a way round.
  double goal_bias = 0.3;
  /// No two nodes of a tree lie in one cell. Small: a closed room takes long to search; large: a
  /// narrow way out of it is missed.
  PoseCells cells = {.position = 0.03, .yaw = 0.1};
};

/// How a tree ended: it found a plan, was stopped, or nothing was left to try.
enum class TreeEnd { kPlan, kStopped, kExhausted };

/// Grows a tree from `starts` to the goal until one of these, in time with `edges`; null: not in
/// time. `plan` is written with kPlan.
TreeEnd GrowTree(const std::vector<StepState>& starts, const RrtOptions& options, StepGraph* graph,
                 PlanMonitor* monitor, TimedEdges* edges, std::mt19937_64& random, StepPlan* plan);

/// Rapidly-exploring random tree over a discrete set of elements, after [LaValle2001] and
/// [Perrin2012]: the node nearest to a random pose takes the free element that leads nearest to it.
/// When it has a plan it goes on: a stretch of the plan between two random states is planned anew;
/// the rest follows its old places as closely as free elements can; what is cheaper is kept.
class FootstepRrt : public FootstepPlanner {
 public:
  /// They hold for every call.
  explicit FootstepRrt(const RrtOptions& options) : options_(options) {}
  PlanResult Plan(const PlanRequest& request, std::mt19937_64& random) const override;
  bool knows_time() const override { return true; }

 private:
  RrtOptions options_;
};

}  // namespace halfstep
