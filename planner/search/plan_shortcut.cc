#include "planner/search/plan_shortcut.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "planner/search/step_tree.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// What a stretch begins with: states, in time with when they are reached.
struct Roots {
  std::vector<StepState> states;
  std::vector<TimedState> timed;
};

Roots RootsOf(const StepPlan& plan, const PlanStates& path, size_t a,
              const std::vector<StepState>& starts, const TimedEdges* edges) {
  Roots roots;
  if (edges == nullptr) {
    roots.states = a == 0 ? starts : std::vector{path.states[a]};
  } else if (a > 0) {
    roots.timed = {plan.timed[a - 1].to};
  } else {
    for (const StepState& start : starts) {
      if (const auto at = edges->Start(start)) roots.timed.push_back(*at);
    }
  }
  return roots;
}

// The stretch from state a to near state b (the last one: to the goal), cheaper than it was.
std::optional<StepPlan> PlanStretch(const Roots& roots, const PlanStates& path, size_t a, size_t b,
                                    const PoseCells& cells, StepGraph* graph, PlanMonitor* monitor,
                                    TimedEdges* edges, std::mt19937_64& random) {
  constexpr double kRoom = 0.4;
  constexpr double kTowardsTarget = 0.6;
  const bool to_goal = b + 1 == path.states.size();
  TreeTarget target{.cost_limit = path.costs[b]};
  if (!to_goal) target.state = path.states[b];
  StepTree tree(target, cells, graph, monitor, edges);
  StepTree::Growth growth = StepTree::Growth::kTrapped;
  for (const StepState& root : roots.states) {
    if (growth == StepTree::Growth::kArrived) break;
    growth = tree.AddRoot(root, a == 0 ? graph->StartCost(root) : path.costs[a]);
  }
  for (const TimedState& root : roots.timed) {
    if (growth != StepTree::Growth::kArrived) growth = tree.AddRoot(root);
  }
  Eigen::AlignedBox2d box(path.states[a].X_WS.Planar().position());
  box.extend(path.states[b].X_WS.Planar().position());
  const int samples = 20 + 8 * static_cast<int>(b - a);
  for (int i = 0; i < samples && growth != StepTree::Growth::kArrived; ++i) {
    if (tree.IsExhausted() || monitor->Stop()) break;
    TreeSample sample{.X_WF = path.states[b].X_WS.Planar(),
                      .side = path.states[b].support,
                      .yaw = to_goal ? TreeSample::Yaw::kFree : TreeSample::Yaw::kCountsWhenNear};
    if (i % 2 == 1) sample.side = Opposite(sample.side);
    if (Uniform(0.0, 1.0, random) >= kTowardsTarget) {
      sample.X_WF.x = Uniform(box.min().x() - kRoom, box.max().x() + kRoom, random);
      sample.X_WF.y = Uniform(box.min().y() - kRoom, box.max().y() + kRoom, random);
      sample.yaw = TreeSample::Yaw::kFree;
    }
    growth = tree.Grow(sample);
  }
  if (growth != StepTree::Growth::kArrived) return std::nullopt;
  return tree.arrival();
}

// Adds an element to a plan that has come to `state`, if it is free.
bool TakeElement(const StepState& state, int k, bool last, StepGraph* graph, TimedEdges* edges,
                 StepPlan* plan) {
  if (edges == nullptr) {
    if (!graph->DownIsFree(state, k) || (!last && !graph->UpIsFree(state, k))) return false;
    plan->ks.push_back(k);
    plan->cost += graph->cost(k);
    return true;
  }
  std::optional<TimedEdge> edge;
  const TimedState& from = plan->timed.back().to;
  if (last) {
    edge = edges->Land(from, k);
  } else if (const std::vector<TimedEdge> found = edges->Take(from, k); !found.empty()) {
    edge = found.front();  // the earliest
  }
  if (!edge) return false;
  plan->ks.push_back(k);
  plan->timed.push_back(*edge);
  plan->cost = last ? edges->CostOfLanding(*edge) : edges->CostOf(edge->to);
  return true;
}

// From a state to the goal along old landings, each followed by the free element nearest to it.
bool Follow(const PlanStates& path, size_t from, StepState state, StepGraph* graph,
            TimedEdges* edges, StepPlan* plan) {
  std::vector<Foothold> landings;
  std::vector<std::pair<double, int>> order;
  for (size_t j = from + 1; j < path.states.size(); ++j) {
    const bool last = j + 1 == path.states.size();
    graph->Landings(state, &landings);
    order.clear();
    for (int k = 0; k < graph->size(); ++k) {
      if (!graph->Fits(state, k)) continue;
      const Foothold& old = path.states[j].X_WS;
      Foothold& X_WF = Nth(landings, k);
      constexpr double kNear = 0.15;  // [m] heights of farther ones are not looked up
      if (graph->looks_up_heights()) {
        if (StateDistance(X_WF.Planar(), old.Planar(), true) > kNear) continue;
        X_WF = graph->Settled(state, X_WF);
      }
      if (X_WF.height != old.height) continue;
      if (last && !graph->IsGoal(state, X_WF)) continue;
      if (!last && !graph->workspace().contains(X_WF.Planar().position())) continue;
      order.emplace_back(StateDistance(X_WF.Planar(), old.Planar(), true), k);
    }
    std::sort(order.begin(), order.end());
    constexpr size_t kTries = 10;
    if (order.size() > kTries) order.resize(kTries);
    const auto free = std::find_if(order.begin(), order.end(), [&](const auto& choice) {
      return TakeElement(state, choice.second, last, graph, edges, plan);
    });
    if (free == order.end()) return false;
    state = graph->After(state, free->second, Nth(landings, free->second));
  }
  return true;
}

}  // namespace

std::optional<StepPlan> FindShortcut(const StepPlan& plan, const std::vector<StepState>& starts,
                                     const PoseCells& cells, StepGraph* graph, PlanMonitor* monitor,
                                     TimedEdges* edges, std::mt19937_64& random) {
  const PlanStates path = StatesOf(*graph, plan, edges);
  const int count = static_cast<int>(plan.ks.size());
  const int a = Pick(count, random);
  const int b = a + 1 + Pick(count - a, random);
  const auto ia = static_cast<size_t>(a), ib = static_cast<size_t>(b);
  const Roots roots = RootsOf(plan, path, ia, starts, edges);
  const auto stretch = PlanStretch(roots, path, ia, ib, cells, graph, monitor, edges, random);
  if (!stretch) return std::nullopt;
  StepPlan candidate{.start = a == 0 ? stretch->start : plan.start,
                     .ks = {plan.ks.begin(), plan.ks.begin() + a},
                     .cost = stretch->cost};
  candidate.ks.insert(candidate.ks.end(), stretch->ks.begin(), stretch->ks.end());
  if (edges != nullptr) {
    candidate.timed.assign(plan.timed.begin(), plan.timed.begin() + a);
    candidate.timed.insert(candidate.timed.end(), stretch->timed.begin(), stretch->timed.end());
  }
  StepState state = stretch->start;
  for (int k : stretch->ks) state = graph->After(state, k);
  if (b < count && !Follow(path, ib, state, graph, edges, &candidate)) return std::nullopt;
  return candidate;
}

bool TryShortcut(const StepPlan& plan, const std::vector<StepState>& starts, const PoseCells& cells,
                 StepGraph* graph, PlanMonitor* monitor, TimedEdges* edges,
                 std::mt19937_64& random) {
  std::optional<StepPlan> found = FindShortcut(plan, starts, cells, graph, monitor, edges, random);
  return found && monitor->Offer(std::move(*found));
}

double Uniform(double lower, double upper, std::mt19937_64& random) {
  return lower + (upper - lower) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

int Pick(int count, std::mt19937_64& random) {
  return std::min(count - 1, static_cast<int>(Uniform(0.0, count, random)));
}

}  // namespace halfstep
