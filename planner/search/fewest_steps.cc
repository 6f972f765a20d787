#include "planner/search/fewest_steps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace halfstep {

FewestSteps::FewestSteps(const PlanRequest& request, const std::vector<StepState>& starts,
                         const StepSearchOptions& options, const StandMap* map, StepGraph* graph,
                         PlanMonitor* monitor)
    : map_(map),
      graph_(*graph),
      monitor_(*monitor),
      request_(Counted(request)),
      steps_(request_, graph->elements()),
      inner_(request_, steps_),
      search_(
          starts, [this](const StepState& state) { return ToGo(state); }, options, &steps_,
          &inner_) {}

// The request with another cost, whose effort and end are those of monitor_.
PlanRequest FewestSteps::Counted(const PlanRequest& request) {
  PlanRequest counted = request;
  counted.cost.kind = CostKind::kSteps;
  counted.stop = [this](const PlanProgress& progress) {
    for (; nodes_ < progress.nodes; ++nodes_) monitor_.CountNode();
    graph_.AddQueries(steps_.queries() - queries_);
    queries_ = steps_.queries();
    Take();
    // Only a turn ends, so that the search can go on.
    inner_.Allow(monitor_.Stop() ? 0.0 : std::numeric_limits<double>::infinity());
    return StopReason::kGoOn;
  };
  return counted;
}

StepsToGo FewestSteps::ToGo(const StepState& state) const {
  constexpr double kOffTheMap = 3.0;  // footsteps more than without it
  const auto bound = static_cast<double>(steps_.LeastSteps(state));
  const double guess = steps_.SteadySteps(state);
  if (map_ == nullptr) return {.bound = bound, .guess = guess};
  const double per_step = 0.5 * steps_.reach().Distance(2);
  const double way = map_->Way(state.X_WS.Planar().position());
  return {.bound = bound,
          .guess = std::isfinite(way) ? std::max(guess, way / per_step) : guess + kOffTheMap};
}

bool FewestSteps::Run() {
  const bool ended = search_.Run();
  Take();
  return ended;
}

// Offers the plans that are new.
void FewestSteps::Take() {
  for (; taken_ < inner_.plans().size(); ++taken_) {
    StepPlan plan = inner_.plans()[taken_];
    plan.cost = graph_.StartCost(plan.start);
    StepState state = plan.start;
    bool forbidden = false;
    for (int k : plan.ks) {
      forbidden = forbidden || graph_.IsForbidden(state, k);
      plan.cost += graph_.cost(k);
      state = graph_.After(state, k);
    }
    if (forbidden) continue;
    monitor_.Offer(std::move(plan));
  }
}

}  // namespace halfstep
