#include "planner/search/footstep_rrt.h"

#include <cmath>
#include <numbers>
#include <optional>

#include "planner/search/plan_search.h"
#include "planner/search/plan_shortcut.h"
#include "planner/search/step_tree.h"
#include "wpg/elementary.h"

namespace halfstep {
namespace {

Pose2 SampleGoal(const GoalRegion& goal, std::mt19937_64& random) {
  Eigen::Vector2d p_G;
  if (goal.box) {
    p_G = {(*goal.box)[0] * Uniform(-0.5, 0.5, random),
           (*goal.box)[1] * Uniform(-0.5, 0.5, random)};
  } else {
    const double angle = Uniform(0.0, 2.0 * std::numbers::pi, random);
    const double r = goal.radius * std::sqrt(Uniform(0.0, 1.0, random));
    p_G = {r * Cos(angle), r * Sin(angle)};
  }
  const Eigen::Vector2d p_W = goal.X_WG * p_G;
  return {p_W.x(), p_W.y(), goal.X_WG.yaw};
}

TreeSample Sample(const StepGraph& graph, double goal_bias, std::mt19937_64& random) {
  TreeSample sample;
  sample.side = Pick(2, random) == 0 ? Side::kLeft : Side::kRight;
  if (Uniform(0.0, 1.0, random) < goal_bias) {
    sample.X_WF = SampleGoal(graph.goal(), random);
    sample.yaw =
        graph.goal().yaw_tolerance ? TreeSample::Yaw::kCountsWhenNear : TreeSample::Yaw::kFree;
    return sample;
  }
  const Eigen::AlignedBox2d& area = graph.workspace();
  sample.X_WF.x = Uniform(area.min().x(), area.max().x(), random);
  sample.X_WF.y = Uniform(area.min().y(), area.max().y(), random);
  sample.X_WF.yaw = Uniform(-std::numbers::pi, std::numbers::pi, random);
  sample.yaw = Pick(2, random) == 0 ? TreeSample::Yaw::kCounts : TreeSample::Yaw::kFree;
  return sample;
}

}  // namespace

TreeEnd GrowTree(const std::vector<StepState>& starts, const RrtOptions& options, StepGraph* graph,
                 PlanMonitor* monitor, TimedEdges* edges, std::mt19937_64& random, StepPlan* plan) {
  StepTree tree({}, options.cells, graph, monitor, edges);
  StepTree::Growth growth = StepTree::Growth::kTrapped;
  for (const StepState& start : starts) {
    if (monitor->Stop()) return TreeEnd::kStopped;
    if (edges == nullptr) {
      growth = tree.AddRoot(start, graph->StartCost(start));
    } else if (const auto at = edges->Start(start)) {
      growth = tree.AddRoot(*at);
    }
    if (growth == StepTree::Growth::kArrived) break;
  }
  while (growth != StepTree::Growth::kArrived) {
    if (monitor->Stop()) return TreeEnd::kStopped;
    if (tree.IsExhausted()) return TreeEnd::kExhausted;
    growth = tree.Grow(Sample(*graph, options.goal_bias, random));
  }
  *plan = tree.arrival();
  return TreeEnd::kPlan;
}

namespace {

constexpr const char* kFirstArrivals =
    "all was searched that the half-steps reach inside the workspace, but not every arrival at a "
    "place that was reached before (`planner.name: best` looks at these)";

// No plan from these states can be cheaper.
bool IsCheapest(double cost, const std::vector<StepState>& starts, const StepGraph& graph) {
  for (const StepState& start : starts) {
    if (cost > graph.StartCost(start) + graph.reach().least_cost() * graph.LeastSteps(start)) {
      return false;
    }
  }
  return true;
}

}  // namespace

PlanResult FootstepRrt::Plan(const PlanRequest& request, std::mt19937_64& random) const {
  return PlanWith(
      request, AllElements(request.set),
      [&](const std::vector<StepState>& starts, StepGraph* graph, PlanMonitor* monitor) {
        std::optional<TimedEdges> in_time;
        if (request.times != nullptr) {
          in_time.emplace(*request.times, request.set.prototype.duration, graph);
        }
        TimedEdges* edges = in_time ? &*in_time : nullptr;
        StepPlan first;
        const TreeEnd end = GrowTree(starts, options_, graph, monitor, edges, random, &first);
        if (end != TreeEnd::kPlan) {
          return SearchEnd{.exhausted = end == TreeEnd::kExhausted,
                           .sentence = edges == nullptr ? "" : kFirstArrivals};
        }
        monitor->Offer(std::move(first));
        while (!IsCheapest(monitor->best_cost(), starts, *graph)) {
          if (monitor->Stop()) return SearchEnd{};
          const StepPlan best = monitor->plans().back();
          TryShortcut(best, starts, options_.cells, graph, monitor, edges, random);
        }
        return SearchEnd{.exhausted = true};
      });
}

}  // namespace halfstep
