#include "planner/search/timed_search.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <tuple>
#include <unordered_map>

#include "planner/search/timed_edges.h"
#include "wpg/check.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// Intervals of rest in one cell that end by no more than this apart count as the same [s].
constexpr double kSameEnd = 0.25;

// A state whose outgoing elements wait in `order`, the most promising first.
struct TimedNode {
  TimedState at;
  int parent = -1;
  int k = -1;      // element that led here
  TimedEdge edge;  // how
  std::vector<std::uint32_t> order;
};

// The next element of a node to ask about, or an edge that was found free.
struct TimedWaiting {
  double key = 0.0;    // cost so far + weight · guess
  double guess = 0.0;  // among equals the one nearer to the goal
  int node = 0;
  int rank = 0;    // in its order
  int found = -1;  // which of the edges that are free; −1: not asked about
  bool operator<(const TimedWaiting& other) const {  // the top of the queue is the largest
    return std::tie(key, guess, node, rank, found) >
           std::tie(other.key, other.guess, other.node, other.rank, other.found);
  }
};

class SearchInTime {
 public:
  enum class End { kStopped, kFound, kExhausted };

  SearchInTime(const std::function<StepsToGo(const StepState&)>& to_go, double weight,
               const PoseCells& cells, const PlanRequest& request, StepGraph* graph,
               PlanMonitor* monitor)
      : to_go_(to_go),
        weight_(weight),
        cells_(cells),
        edges_(*request.times, request.set.prototype.duration, graph),
        graph_(*graph),
        monitor_(*monitor) {}

  End Run(const std::vector<StepState>& starts) {
    for (const StepState& start : starts) {
      if (monitor_.Stop()) return End::kStopped;
      if (const auto at = edges_.Start(start)) Expand({.at = *at, .edge = {}, .order = {}});
    }
    while (!open_.empty()) {
      if (monitor_.Stop()) return End::kStopped;
      const TimedWaiting next = open_.top();
      open_.pop();
      if (next.found >= 0) {
        if (Follow(next)) return End::kFound;
        continue;
      }
      Enqueue(next.node, next.rank + 1);
      Ask(next);
    }
    return End::kExhausted;
  }

 private:
  struct Promise {
    double key, guess;
    bool wanted;
  };
  // An edge that is free.
  struct Found {
    int k;
    TimedEdge edge;
    bool lands;  // on the goal
  };

  // Of being at a state after such a cost, or of a landing on the goal.
  Promise PromiseOf(const StepState& after, double cost, bool is_goal) const {
    if (is_goal) return {cost, 0.0, cost < monitor_.best_cost()};
    if (!graph_.workspace().contains(after.X_WS.Planar().position())) return {0.0, 0.0, false};
    const StepsToGo left = to_go_(after);
    const double each = graph_.reach().least_cost();
    return {cost + weight_ * each * left.guess, left.guess,
            std::isfinite(left.guess) && cost + each * left.bound < monitor_.best_cost()};
  }

  // Of an element that lands at X_WF, when there is no need to rest.
  Promise Promises(const TimedNode& node, int k, const Foothold& X_WF) const {
    return PromiseOf({X_WF, Opposite(node.at.state.support)},
                     edges_.CostOf(node.at) + graph_.cost(k), graph_.IsGoal(node.at.state, X_WF));
  }

  // Whether a state in the same cell was reached that serves as well.
  bool IsReached(const TimedState& at) const {
    const auto known = reached_.find(cells_.KeyOf(at.state));
    return known != reached_.end() &&
           std::ranges::any_of(known->second, [&](const TimedState& other) {
             return other.rest.end >= at.rest.end - kSameEnd &&
                    (weight_ > 1.0 || other.since <= at.since);
           });
  }

  void Expand(TimedNode node) {
    if (IsReached(node.at)) return;
    reached_[cells_.KeyOf(node.at.state)].push_back(node.at);
    monitor_.CountNode();
    graph_.Landings(node.at.state, &landings_);
    promises_.clear();
    for (int k = 0; k < graph_.size(); ++k) {
      const Foothold& X_WF = Nth(landings_, k);
      const bool may_bear = graph_.looks_up_heights() || graph_.IsLevel(X_WF.height);
      promises_.push_back(may_bear ? Promises(node, k, X_WF) : Promise{0.0, 0.0, false});
      if (promises_.back().wanted) node.order.push_back(static_cast<std::uint32_t>(k));
    }
    std::ranges::sort(node.order, [this](std::uint32_t a, std::uint32_t b) {
      return std::tie(promises_[a].key, promises_[a].guess, a) <
             std::tie(promises_[b].key, promises_[b].guess, b);
    });
    nodes_.push_back(std::move(node));
    Enqueue(static_cast<int>(nodes_.size()) - 1, 0);
  }

  void Enqueue(int index, int rank) {
    TimedNode& node = Nth(nodes_, index);
    for (; rank < static_cast<int>(node.order.size()); ++rank) {
      const int k = static_cast<int>(Nth(node.order, rank));
      const Foothold X_WF = graph_.Landing(node.at.state, k);
      if (!graph_.IsLevel(X_WF.height)) continue;
      const Promise promise = Promises(node, k, X_WF);
      open_.push({promise.key, promise.guess, index, rank});
      return;
    }
  }

  // Finds the edges of an element in time; those that may be of use wait for their turn.
  void Ask(const TimedWaiting& asked) {
    const TimedNode& node = Nth(nodes_, asked.node);
    const int k = static_cast<int>(Nth(node.order, asked.rank));
    const TimedState from = node.at;
    if (graph_.IsGoal(from.state, graph_.Landing(from.state, k))) {
      if (const auto edge = edges_.Land(from, k)) Keep(asked, {k, *edge, true});
      return;
    }
    for (const TimedEdge& edge : edges_.Take(from, k)) Keep(asked, {k, edge, false});
  }

  void Keep(const TimedWaiting& asked, const Found& found) {
    const double cost =
        found.lands ? edges_.CostOfLanding(found.edge) : edges_.CostOf(found.edge.to);
    const Promise promise = PromiseOf(found.edge.to.state, cost, found.lands);
    if (!promise.wanted || (!found.lands && IsReached(found.edge.to))) return;
    open_.push(
        {promise.key, promise.guess, asked.node, asked.rank, static_cast<int>(found_.size())});
    found_.push_back(found);
  }

  // Whether the edge ended in a plan.
  bool Follow(const TimedWaiting& next) {
    const Found found = Nth(found_, next.found);
    if (found.lands) return monitor_.Offer(PlanTo(next.node, found));
    Expand(
        {.at = found.edge.to, .parent = next.node, .k = found.k, .edge = found.edge, .order = {}});
    return false;
  }

  StepPlan PlanTo(int index, const Found& last) const {
    StepPlan plan{
        .start = {}, .ks = {last.k}, .cost = edges_.CostOfLanding(last.edge), .timed = {last.edge}};
    for (; index >= 0; index = Nth(nodes_, index).parent) {
      const TimedNode& node = Nth(nodes_, index);
      plan.start = node.at.state;
      if (node.k < 0) continue;
      plan.ks.push_back(node.k);
      plan.timed.push_back(node.edge);
    }
    std::ranges::reverse(plan.ks);
    std::ranges::reverse(plan.timed);
    return plan;
  }

  const std::function<StepsToGo(const StepState&)>& to_go_;
  double weight_;
  PoseCells cells_;
  TimedEdges edges_;
  StepGraph& graph_;
  PlanMonitor& monitor_;
  std::vector<TimedNode> nodes_;
  std::vector<Found> found_;
  std::priority_queue<TimedWaiting> open_;
  std::unordered_map<std::uint64_t, std::vector<TimedState>> reached_;
  std::vector<Foothold> landings_;
  std::vector<Promise> promises_;
};

}  // namespace

bool SearchStepsInTime(const std::vector<StepState>& starts,
                       const std::function<StepsToGo(const StepState&)>& to_go,
                       const StepSearchOptions& options, const PlanRequest& request,
                       StepGraph* graph, PlanMonitor* monitor) {
  HALFSTEP_CHECK(request.times != nullptr, "no times");
  const auto search = [&](double weight) {
    return SearchInTime(to_go, weight, options.cells, request, graph, monitor).Run(starts);
  };
  // With a weight above 1 an earlier arrival may have been left out.
  bool left_out = false;
  for (const double weight : options.weights) {
    const SearchInTime::End end = search(weight);
    if (end == SearchInTime::End::kExhausted && weight <= 1.0) return true;
    if (end == SearchInTime::End::kStopped || monitor->Stop()) return false;
    left_out = end == SearchInTime::End::kExhausted;
  }
  return !left_out || search(1.0) != SearchInTime::End::kStopped;
}

}  // namespace halfstep
