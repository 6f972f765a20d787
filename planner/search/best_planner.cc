#include "planner/search/best_planner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "planner/search/least_cost.h"
#include "planner/search/plan_search.h"
#include "planner/search/plan_shortcut.h"
#include "planner/search/stand_map.h"
#include "planner/search/state_buckets.h"
#include "planner/search/step_search.h"
#include "planner/search/timed_search.h"

namespace halfstep {
namespace {

constexpr double kFirstTurn = 0.05;      // effort until another kind of search looks for a plan
constexpr double kFewest = 5.0;          // times a turn, for A* of the fewest footsteps
constexpr double kImprovingTurn = 0.02;  // effort of the first turns that improve it
constexpr int kRestarts = 2;             // of a random tree, a round
constexpr int kPlaces = 4000;            // of the map
/// Of A*, one turn after the other: the larger, the sooner it finds a way.
constexpr double kWeights[] = {2.0, 1.4, 1.15};
constexpr double kFirstWeight = 5.0;
constexpr double kUnlimited = std::numeric_limits<double>::infinity();

// One call of Plan.
class BestSearch {
 public:
  BestSearch(const PlanRequest& request, const std::vector<StepState>& starts,
             const RrtOptions& rrt, const PoseCells& cells, StepGraph* graph, PlanMonitor* monitor,
             std::mt19937_64* random)
      : request_(request),
        starts_(starts),
        rrt_(rrt),
        cells_(cells),
        graph_(*graph),
        monitor_(*monitor),
        random_(*random),
        least_(request.set, *graph) {
    if (request.times == nullptr) return;
    in_time_.emplace(*request.times, request.set.prototype.duration, graph);
    edges_ = &*in_time_;
  }

  SearchEnd Run() {
    for (double turn = kFirstTurn; monitor_.plans().empty(); turn *= 2.0) {
      monitor_.Allow(turn);
      const bool no_tree = Grow(nullptr);
      if (!monitor_.plans().empty()) break;
      if (monitor_.stopped()) return {};
      if (no_tree && edges_ == nullptr) return {.exhausted = true};
      if (edges_ == nullptr) {
        monitor_.Allow(kFewest * turn);
        FewestSteps({kFirstWeight});
        if (!monitor_.plans().empty()) break;
        if (monitor_.stopped()) return {};
      }
      monitor_.Allow(no_tree ? kUnlimited : turn);  // in time A* has the last word
      if (SearchWith(kFirstWeight)) return {.exhausted = true};
      if (monitor_.stopped()) return {};
    }
    monitor_.Allow(kUnlimited);
    if (monitor_.Stop()) return {};
    if (!request_.ground) map_.emplace(request_.set, starts_.front(), kPlaces, &graph_);
    coarse_ = true;
    for (double turn = kImprovingTurn; !IsCheapest(); turn *= 1.5) {
      const bool nothing_better = Round(turn);
      if (nothing_better && !coarse_) break;
      if (monitor_.stopped()) return {};
      coarse_ = !coarse_ && !nothing_better;
    }
    return {.exhausted = true};
  }

 private:
  // Whether no plan is cheaper than the best.
  bool IsCheapest() const {
    return std::ranges::all_of(starts_, [this](const StepState& start) {
      return monitor_.best_cost() <= least_.From(start) * (1.0 + 1e-12);
    });
  }

  // One turn of each way to improve the best plan; whether nothing is better.
  bool Round(double turn) {
    StepPlan fewest;
    if (edges_ == nullptr) {  // in time they are what costs least
      monitor_.Allow(kFewest * turn);
      fewest = FewestSteps({kFirstWeight, 2.5, 1.5, 1.0});
    }
    if (!fewest.ks.empty() && !monitor_.stopped()) {
      monitor_.Allow(turn);
      fewest = Shorten(std::move(fewest));
    }
    if (!fewest.ks.empty() && !monitor_.stopped()) {
      monitor_.Allow(turn);
      SearchAlong(fewest);
    }
    if (monitor_.stopped()) return false;
    for (const double weight : kWeights) {
      monitor_.Allow(turn);
      if (SearchWith(weight)) return true;
      if (monitor_.stopped()) return false;
    }
    monitor_.Allow(turn);
    SearchAlong(monitor_.plans().back());
    if (monitor_.stopped()) return false;
    monitor_.Allow(turn);
    Shorten(monitor_.plans().back());
    if (monitor_.stopped()) return false;
    for (int restart = 0; restart < kRestarts && !monitor_.stopped(); ++restart) {
      monitor_.Allow(turn);
      StepPlan other;
      Grow(&other);
      if (other.ks.empty() || monitor_.stopped()) continue;
      other = Shorten(std::move(other));
      if (monitor_.stopped()) break;
      monitor_.Allow(turn);
      SearchAlong(other);
    }
    return false;
  }

  // Until the turn ends.
  StepPlan Shorten(StepPlan plan) {
    while (!monitor_.Stop()) {
      auto found = FindShortcut(plan, starts_, rrt_.cells, &graph_, &monitor_, edges_, random_);
      if (!found || !(found->cost < plan.cost)) continue;
      plan = std::move(*found);
      monitor_.Offer(plan);
    }
    return plan;
  }

  // A tree; whether it ended for want of half-steps.
  bool Grow(StepPlan* plan) {
    StepPlan grown;
    const TreeEnd end = GrowTree(starts_, rrt_, &graph_, &monitor_, edges_, random_, &grown);
    if (end == TreeEnd::kPlan) monitor_.Offer(grown);
    if (end == TreeEnd::kPlan && plan != nullptr) *plan = std::move(grown);
    return end == TreeEnd::kExhausted;
  }

  // Of A*: in every second round, from the first on, larger ones, which leave fewer states.
  PoseCells Cells() const {
    constexpr double kLarger = 2.5;
    if (!coarse_) return cells_;
    return {.position = kLarger * cells_.position, .yaw = kLarger * cells_.yaw};
  }

  // A* for the fewest footsteps, whatever they cost: many plans have as few, so it soon finds one.
  StepPlan FewestSteps(const std::vector<double>& weights) {
    PlanRequest request = request_;
    request.cost.kind = CostKind::kSteps;
    StepGraph graph(request, graph_.elements());
    std::int64_t nodes = 0, queries = 0;
    request.stop = [&](const PlanProgress& progress) {
      for (; nodes < progress.nodes; ++nodes) monitor_.CountNode();
      graph_.AddQueries(graph.queries() - queries);
      queries = graph.queries();
      return monitor_.Stop() ? StopReason::kBudget : StopReason::kGoOn;
    };
    PlanMonitor monitor(request, graph);
    const double per_step = 0.5 * graph.reach().Distance(2);
    const auto to_go = [&](const StepState& state) {
      const double way = map_ && coarse_ ? map_->Way(state.X_WS.Planar().position()) : 0.0;
      const double guess = graph.SteadySteps(state);
      return StepsToGo{.bound = static_cast<double>(graph.LeastSteps(state)),
                       .guess = std::isfinite(way) ? std::max(guess, way / per_step) : guess + 3.0};
    };
    SearchSteps(starts_, to_go, {.weights = weights, .cells = Cells()}, &graph, &monitor);
    if (monitor.plans().empty()) return {};
    StepPlan plan = monitor.plans().back();
    plan.cost = 0.0;
    StepState state = plan.start;
    for (int k : plan.ks) {
      if (graph_.IsForbidden(state, k)) return {};
      plan.cost += graph_.cost(k);
      state = graph_.After(state, k);
    }
    monitor_.Offer(plan);
    return plan;
  }

  // A*; whether there is nothing better.
  bool SearchWith(double weight) {
    const double before = monitor_.best_cost(), each = graph_.reach().least_cost();
    const auto to_go = [&](const StepState& state) {
      const double bound = least_.From(state);
      double guess = bound;
      if (map_) {
        constexpr double kOffTheMap = 1.0;  // [m] more than the bound says
        const double way = map_->Way(state.X_WS.Planar().position());
        guess = std::isfinite(way) ? std::max(guess, least_.per_metre() * way)
                                   : guess + least_.per_metre() * kOffTheMap;
      }
      return StepsToGo{.bound = bound / each, .guess = guess / each};
    };
    return Search(to_go, weight) && monitor_.best_cost() == before;
  }

  // Whether it ended by itself. In time only a weight of 1 leaves nothing out.
  bool Search(const std::function<StepsToGo(const StepState&)>& to_go, double weight) {
    if (edges_ == nullptr) {
      return SearchSteps(starts_, to_go, {.weights = {weight}, .cells = Cells()}, &graph_,
                         &monitor_);
    }
    return SearchStepsInTime(starts_, to_go, {.weights = {weight, 1.0}, .cells = Cells()}, request_,
                             &graph_, &monitor_);
  }

  // A* near a plan, which tells how far it is to the goal around what stands in between.
  void SearchAlong(const StepPlan& plan) {
    constexpr double kNear = 0.4;    // [m] of its states, by StateDistance
    constexpr double kBetter = 0.9;  // what a good plan costs of it
    const PlanStates path = StatesOf(graph_, plan, edges_);
    const double each = graph_.reach().least_cost();
    const auto to_go = [&](const StepState& state) {
      double guess = std::numeric_limits<double>::infinity();
      for (size_t j = 0; j < path.states.size(); ++j) {
        const Pose2 X_WS = state.X_WS.Planar(), near = path.states[j].X_WS.Planar();
        if ((X_WS.position() - near.position()).squaredNorm() > kNear * kNear) continue;
        const double away = StateDistance(X_WS, near, true);
        if (away > kNear) continue;
        guess = std::min(guess, kBetter * (plan.cost - path.costs[j]) + least_.per_metre() * away);
      }
      const double bound = least_.From(state);
      return StepsToGo{.bound = bound / each, .guess = std::max(bound, guess) / each};
    };
    Search(to_go, 1.0);
  }

  const PlanRequest& request_;
  const std::vector<StepState>& starts_;
  const RrtOptions& rrt_;
  const PoseCells& cells_;
  StepGraph& graph_;
  PlanMonitor& monitor_;
  std::mt19937_64& random_;
  LeastCost least_;
  std::optional<TimedEdges> in_time_;
  TimedEdges* edges_ = nullptr;  // null: not in time
  bool coarse_ = false;
  std::optional<StandMap> map_;
};

}  // namespace

PlanResult BestPlanner::Plan(const PlanRequest& request, std::mt19937_64& random) const {
  return PlanWith(
      request, AllElements(request.set),
      [&](const std::vector<StepState>& starts, StepGraph* graph, PlanMonitor* monitor) {
        return BestSearch(request, starts, rrt_, cells_, graph, monitor, &random).Run();
      });
}

}  // namespace halfstep
