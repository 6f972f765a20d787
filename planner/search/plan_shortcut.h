#pragma once

#include <optional>
#include <random>

#include "planner/search/plan_search.h"
#include "planner/search/pose_cells.h"

namespace halfstep {

/// Plans a stretch between two random states of `plan` anew, or from one of `starts` on, and
/// follows the rest: the whole, which may be dearer than `plan`. None: the stretch is not cheaper,
/// or the rest cannot be followed. Counts at least one node. Precondition: the plan has a footstep.
/// In time with `edges`; null: not in time.
std::optional<StepPlan> FindShortcut(const StepPlan& plan, const std::vector<StepState>& starts,
                                     const PoseCells& cells, StepGraph* graph, PlanMonitor* monitor,
                                     TimedEdges* edges, std::mt19937_64& random);
/// Offers a short-cut to the monitor. Returns whether it is the best plan.
bool TryShortcut(const StepPlan& plan, const std::vector<StepState>& starts, const PoseCells& cells,
                 StepGraph* graph, PlanMonitor* monitor, TimedEdges* edges,
                 std::mt19937_64& random);

/// Uniform in [lower, upper), from 53 bits of one number, so that it is the same on every platform.
double Uniform(double lower, double upper, std::mt19937_64& random);
/// Uniform among 0 … count − 1.
int Pick(int count, std::mt19937_64& random);

}  // namespace halfstep
