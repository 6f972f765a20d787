#include "planner/search/plan_search.h"

#include <cmath>

#include "wpg/check.h"
#include "wpg/files/plain_locale.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

void CheckRequest(const PlanRequest& request) {
  for (const Foothold& sole : request.start) {
    HALFSTEP_CHECK(sole.AllFinite(), "start sole " << sole.x << ", " << sole.y << ", " << sole.yaw);
  }
  HALFSTEP_CHECK(!request.in_air || request.in_air->X_WS.AllFinite(), "start in the air");
  const GoalRegion& goal = request.goal;
  HALFSTEP_CHECK(goal.IsValid(), "goal " << goal.X_WG.x << ", " << goal.X_WG.y << ", "
                                         << goal.X_WG.yaw << ", radius " << goal.radius);
  HALFSTEP_CHECK(request.set.size() > 0, "the set of half-steps is empty");
  HALFSTEP_CHECK(request.times == nullptr || !request.in_air, "in time, with a foot in the air");
  HALFSTEP_CHECK(request.times == nullptr || request.cost.kind != CostKind::kSmoothedDuration,
                 "in time, elements cost the same");
}

// Asks about the plans, the best first. What was refused is forbidden to later searches.
const StepPlan* FirstAccepted(const PlanRequest& request, const PlanMonitor& monitor,
                              StepGraph* graph, int* refusals) {
  for (auto plan = monitor.plans().rbegin(); plan != monitor.plans().rend(); ++plan) {
    if (!request.accepts) return &*plan;
    const std::vector<StepState> states = StatesOf(*graph, *plan).states;
    bool forbidden = false;
    for (size_t j = 0; j < plan->ks.size(); ++j) {
      forbidden = forbidden || graph->IsForbidden(states[j], plan->ks[j]);
    }
    if (forbidden) continue;
    const Acceptance answer = request.accepts(FootstepsOf(request, *graph, *plan));
    if (answer.accepted) return &*plan;
    const int last = static_cast<int>(plan->ks.size()) - 1;
    const bool named = answer.refused_footstep >= 0 && answer.refused_footstep <= last;
    const int at = named ? answer.refused_footstep : last;
    graph->Forbid(Nth(states, at), Nth(plan->ks, at));
    if (++*refusals >= request.max_refusals) break;
  }
  return nullptr;
}

// How long a walk rests, and how much of it on one foot; "": nowhere.
std::string RestsText(const std::vector<Footstep>& footsteps) {
  double on_both_feet = 0.0, on_one_foot = 0.0;
  for (const Footstep& footstep : footsteps) {
    on_both_feet += footstep.rest;
    on_one_foot += footstep.rest_on_one_foot;
  }
  if (on_both_feet + on_one_foot == 0.0) return "";
  std::string text = Formatted(", at rest for %.3g s", on_both_feet + on_one_foot);
  if (on_both_feet == 0.0) return text + " on one foot";
  return on_one_foot == 0.0 ? text : text + Formatted(", %.3g s of it on one foot", on_one_foot);
}

void Solve(const PlanRequest& request, const StepGraph& graph, const StepPlan& plan,
           PlanResult* result) {
  result->status = PlanStatus::kSolved;
  result->footsteps = FootstepsOf(request, graph, plan);
  for (int k : plan.ks) result->elements.push_back(Nth(graph.elements(), k));
  result->cost = plan.cost;
  PlainStream sentence;
  sentence << plan.ks.size() << (plan.ks.size() == 1 ? " footstep" : " footsteps");
  if (request.times != nullptr) sentence << RestsText(result->footsteps);
  if (result->stop == StopReason::kBudget) sentence << ", when the budget was used up";
  if (result->stop == StopReason::kClock) sentence << ", ended by the clock, not repeatable";
  if (result->stop == StopReason::kInterrupted) sentence << ", when it was interrupted";
  result->sentence = sentence.str();
}

void Fail(PlanStatus status, const std::string& sentence, PlanResult* result) {
  result->status = status;
  result->sentence = sentence;
}

// Without a plan that was accepted.
void Explain(const SearchEnd& end, PlanResult* result) {
  if (result->refusals > 0) {
    Fail(PlanStatus::kRefused, "every plan found was refused by the check of the whole walk",
         result);
  } else if (result->exhausted) {
    Fail(PlanStatus::kNoPlan,
         end.sentence.empty() ? "all that the half-steps reach inside the workspace was searched"
                              : end.sentence,
         result);
  } else if (result->stop == StopReason::kInterrupted) {
    Fail(PlanStatus::kInterrupted, "interrupted before a plan was found", result);
  } else if (result->stop == StopReason::kClock) {
    Fail(PlanStatus::kBudget, "ended by the clock before a plan was found, not repeatable", result);
  } else {
    Fail(PlanStatus::kBudget, "no plan was found before the budget was used up", result);
  }
}

}  // namespace

bool PlanMonitor::Stop() {
  if (reason_ != StopReason::kGoOn) return true;
  progress_.queries = graph_.queries();
  if (request_.proofs) progress_.proofs = request_.proofs();
  reason_ = request_.stop ? request_.stop(progress_) : AtFirstPlan()(progress_);
  return reason_ != StopReason::kGoOn || progress_.effort() >= turn_ends_;
}

void PlanMonitor::CountNode() {
  ++progress_.nodes;
  if (progress_.has_plan()) ++progress_.nodes_since_improvement;
}

bool PlanMonitor::Offer(StepPlan plan) {
  if (!(plan.cost < progress_.cost)) return false;
  if (request_.clock && std::isnan(time_to_first_)) time_to_first_ = elapsed();
  progress_.cost = plan.cost;
  progress_.nodes_since_improvement = 0;
  plans_.push_back(std::move(plan));
  return true;
}

double PlanMonitor::elapsed() const {
  return request_.clock ? request_.clock() - begin_ : std::numeric_limits<double>::quiet_NaN();
}

void PlanMonitor::StartOver() {
  progress_.cost = std::numeric_limits<double>::infinity();
  progress_.nodes_since_improvement = 0;
  reason_ = StopReason::kGoOn;
  turn_ends_ = std::numeric_limits<double>::infinity();
  plans_.clear();
}

PlanStates StatesOf(const StepGraph& graph, const StepPlan& plan, const TimedEdges* edges) {
  PlanStates path{{plan.start}, {graph.StartCost(plan.start)}};
  for (size_t j = 0; j < plan.ks.size(); ++j) {
    path.states.push_back(graph.After(path.states.back(), plan.ks[j]));
    path.costs.push_back(path.costs.back() + graph.cost(plan.ks[j]));
    if (edges == nullptr) continue;
    const bool last = j + 1 == plan.ks.size();
    path.costs.back() =
        last ? edges->CostOfLanding(plan.timed[j]) : edges->CostOf(plan.timed[j].to);
  }
  return path;
}

PlanResult PlanWith(const PlanRequest& request, const std::vector<int>& elements,
                    const PlanSearch& search) {
  CheckRequest(request);
  PlanResult result;
  if (!request.in_air && request.goal.ContainsStance(request.start)) {
    result.status = PlanStatus::kSolved;
    result.sentence = "the start is in the goal: nothing to plan";
    result.cost = 0.0;
    if (request.clock) result.time = 0.0;
    result.exhausted = true;
    return result;
  }
  StepGraph graph(request, elements);
  PlanMonitor monitor(request, graph);
  std::vector<StepState> starts;
  const StepPlan* plan = nullptr;
  SearchEnd end;
  if (!monitor.Stop()) {
    starts = graph.FreeStarts();
    if (starts.empty()) {
      Fail(PlanStatus::kStartBlocked, "neither foot can leave the floor at the start", &result);
      result.time = monitor.elapsed();
      return result;
    }
    while (true) {
      end = search(starts, &graph, &monitor);
      result.exhausted = end.exhausted;
      if (monitor.plans().empty()) break;
      plan = FirstAccepted(request, monitor, &graph, &result.refusals);
      const bool hard =
          monitor.reason() != StopReason::kGoOn && monitor.reason() != StopReason::kEnough;
      if (plan != nullptr || hard || result.refusals >= request.max_refusals) break;
      monitor.StartOver();
    }
  }
  result.stop = monitor.reason();
  result.nodes = monitor.progress().nodes;
  result.samples = monitor.progress().samples;
  result.queries = graph.queries();
  result.time_to_first = monitor.time_to_first();
  result.time = monitor.elapsed();
  if (plan != nullptr) {
    Solve(request, graph, *plan, &result);
  } else {
    Explain(end, &result);
  }
  return result;
}

std::vector<Footstep> FootstepsOf(const PlanRequest& request, const StepGraph& graph,
                                  const StepPlan& plan) {
  std::vector<Footstep> footsteps;
  StepState state = plan.start;
  std::vector<std::array<double, 2>> rests;
  if (request.times != nullptr) {
    const double T = request.set.prototype.duration;
    rests = RestsOf(WithLatestUps(*request.times, graph, state, plan.ks, plan.timed, T), T);
  }
  for (int k : plan.ks) {
    const HalfStep like = request.set.PrototypeOf(state.form);
    state = graph.After(state, k);
    footsteps.push_back({.side = state.support,
                         .X_WF = state.X_WS,
                         .via_height = like.via_height,
                         .duration = like.duration});
    if (request.set.num_forms() > 1) footsteps.back().crouch = like.shape.crouch;
    if (rests.empty()) continue;
    const auto& [on_both_feet, on_one_foot] = rests[footsteps.size() - 1];
    footsteps.back().rest = on_both_feet;
    footsteps.back().rest_on_one_foot = on_one_foot;
  }
  return footsteps;
}

std::string_view Name(PlanStatus status) {
  switch (status) {
    case PlanStatus::kNotRun:
      return "not_run";
    case PlanStatus::kSolved:
      return "solved";
    case PlanStatus::kNoPlan:
      return "no_plan";
    case PlanStatus::kStartBlocked:
      return "start_blocked";
    case PlanStatus::kBudget:
      return "budget";
    case PlanStatus::kInterrupted:
      return "interrupted";
    case PlanStatus::kRefused:
      return "refused";
  }
  return "";
}

}  // namespace halfstep
