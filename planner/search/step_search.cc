#include "planner/search/step_search.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>
#include <unordered_set>

#include "wpg/nth.h"

namespace halfstep {
namespace {

// A state whose outgoing edges wait in `order`, the most promising first.
struct Node {
  StepState state;
  int parent = -1;
  int k = -1;  // element that led here
  double cost = 0.0;
  std::vector<std::uint32_t> order;
};

// The next edge of a node to look at.
struct Waiting {
  double key = 0.0;    // cost so far + weight · guess
  double guess = 0.0;  // among equals the one nearer to the goal
  int node = 0;
  int rank = 0;                                 // in its order
  bool operator<(const Waiting& other) const {  // the top of the queue is the largest
    return std::tie(key, guess, node, rank) >
           std::tie(other.key, other.guess, other.node, other.rank);
  }
};

class WeightedSearch {
 public:
  WeightedSearch(const std::function<StepsToGo(const StepState&)>& to_go, double weight,
                 const PoseCells& cells, StepGraph* graph, PlanMonitor* monitor)
      : to_go_(to_go), weight_(weight), cells_(cells), graph_(*graph), monitor_(*monitor) {}

  enum class End { kStopped, kFound, kExhausted };

  End Run(const std::vector<StepState>& starts) {
    for (const StepState& start : starts) {
      if (monitor_.Stop()) return End::kStopped;
      Expand({.state = start, .order = {}});
    }
    while (!open_.empty()) {
      if (monitor_.Stop()) return End::kStopped;
      const Waiting next = open_.top();
      open_.pop();
      const int k = Nth(Nth(nodes_, next.node).order, next.rank);
      Enqueue(next.node, next.rank + 1);
      if (Follow(next.node, k)) return End::kFound;
    }
    return End::kExhausted;
  }

 private:
  struct Promise {
    double key, guess;
    bool wanted;
  };

  // Of the edge from a node that lands at X_WF.
  Promise Promises(const Node& node, int k, const Foothold& X_WF) const {
    const double cost = node.cost + graph_.cost(k);
    if (graph_.IsGoal(node.state, X_WF)) return {cost, 0.0, cost < monitor_.best_cost()};
    const StepState after = graph_.After(node.state, k, X_WF);
    if (!graph_.workspace().contains(X_WF.Planar().position())) return {0.0, 0.0, false};
    const StepsToGo left = to_go_(after);
    const double each = graph_.reach().least_cost();
    return {cost + weight_ * each * left.guess, left.guess,
            std::isfinite(left.guess) && cost + each * left.bound < monitor_.best_cost()};
  }

  // Orders the edges of a new node.
  void Expand(Node node) {
    if (!reached_.insert(cells_.KeyOf(node.state)).second) return;
    monitor_.CountNode();
    graph_.Landings(node.state, &landings_);
    promises_.clear();
    for (int k = 0; k < graph_.size(); ++k) {
      const Foothold& X_WF = Nth(landings_, k);
      const bool may_bear =
          graph_.Fits(node.state, k) && (graph_.looks_up_heights() || graph_.IsLevel(X_WF.height));
      promises_.push_back(may_bear ? Promises(node, k, X_WF) : Promise{0.0, 0.0, false});
      if (promises_.back().wanted) node.order.push_back(static_cast<std::uint32_t>(k));
    }
    std::sort(node.order.begin(), node.order.end(), [this](std::uint32_t a, std::uint32_t b) {
      return std::tie(promises_[a].key, promises_[a].guess, a) <
             std::tie(promises_[b].key, promises_[b].guess, b);
    });
    nodes_.push_back(std::move(node));
    Enqueue(static_cast<int>(nodes_.size()) - 1, 0);
  }

  void Enqueue(int index, int rank) {
    Node& node = Nth(nodes_, index);
    for (; rank < static_cast<int>(node.order.size()); ++rank) {
      const int k = Nth(node.order, rank);
      const Foothold X_WF = graph_.Landing(node.state, k);
      if (!graph_.IsLevel(X_WF.height)) continue;
      const Promise promise = Promises(node, k, X_WF);
      open_.push({promise.key, promise.guess, index, rank});
      return;
    }
    node.order = {};
  }

  // Takes the edge if it is free; whether it ended in a plan.
  bool Follow(int index, int k) {
    const Node& node = Nth(nodes_, index);
    const StepState from = node.state, after = graph_.After(from, k);
    const double cost = node.cost + graph_.cost(k);
    if (graph_.IsGoal(from, after.X_WS)) {
      return graph_.DownIsFree(from, k) && monitor_.Offer(PlanTo(index, k, cost));
    }
    if (reached_.contains(cells_.KeyOf(after))) return false;
    if (!graph_.DownIsFree(from, k) || !graph_.UpIsFree(from, k)) return false;
    Expand({.state = after, .parent = index, .k = k, .cost = cost, .order = {}});
    return false;
  }

  StepPlan PlanTo(int index, int last, double cost) const {
    StepPlan plan{.start = {}, .ks = {last}, .cost = cost};
    for (; index >= 0; index = Nth(nodes_, index).parent) {
      const Node& node = Nth(nodes_, index);
      plan.start = node.state;
      if (node.k >= 0) plan.ks.push_back(node.k);
    }
    std::reverse(plan.ks.begin(), plan.ks.end());
    return plan;
  }

  const std::function<StepsToGo(const StepState&)>& to_go_;
  double weight_;
  PoseCells cells_;
  StepGraph& graph_;
  PlanMonitor& monitor_;
  std::vector<Node> nodes_;
  std::priority_queue<Waiting> open_;
  std::unordered_set<std::uint64_t> reached_;
  std::vector<Foothold> landings_;
  std::vector<Promise> promises_;
};

}  // namespace

bool SearchSteps(const std::vector<StepState>& starts,
                 const std::function<StepsToGo(const StepState&)>& to_go,
                 const StepSearchOptions& options, StepGraph* graph, PlanMonitor* monitor) {
  for (const double weight : options.weights) {
    const WeightedSearch::End end =
        WeightedSearch(to_go, weight, options.cells, graph, monitor).Run(starts);
    if (end == WeightedSearch::End::kExhausted) return true;
    if (end == WeightedSearch::End::kStopped || monitor->Stop()) return false;
  }
  return true;
}

}  // namespace halfstep
