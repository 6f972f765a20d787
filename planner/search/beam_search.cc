#include "planner/search/beam_search.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <unordered_map>

#include "wpg/nth.h"

namespace halfstep {
namespace {

struct Node {
  StepState state;
  int parent = -1;
  int k = -1;  // element that led here
  double cost = 0.0;
};

// An element of a node that was not asked about.
struct Candidate {
  double key = 0.0, guess = 0.0;
  int node = 0, k = 0;
  // The top of a heap is the most promising.
  bool operator<(const Candidate& other) const {
    return std::tie(key, guess, node, k) > std::tie(other.key, other.guess, other.node, other.k);
  }
};

class Beam {
 public:
  Beam(const std::vector<StepState>& starts, const StepSearch::ToGo& to_go,
       const BeamOptions& options, StepGraph* graph, PlanMonitor* monitor)
      : to_go_(to_go), options_(options), graph_(*graph), monitor_(*monitor) {
    for (const StepState& start : starts) {
      nodes_.push_back({.state = start, .cost = graph_.StartCost(start)});
      reached_[options_.cells.KeyOf(start)] = nodes_.back().cost;
    }
  }

  // In each round, the states that one footstep more leads to.
  void Run() {
    for (size_t first = 0, last = nodes_.size(); first < last;) {
      candidates_.clear();
      for (; first < last; ++first) {
        if (monitor_.Stop()) return;
        Expand(static_cast<int>(first));
      }
      std::make_heap(candidates_.begin(), candidates_.end());
      while (!candidates_.empty() && nodes_.size() < last + static_cast<size_t>(options_.width)) {
        if (monitor_.Stop()) return;
        std::pop_heap(candidates_.begin(), candidates_.end());
        const Candidate next = candidates_.back();
        candidates_.pop_back();
        Take(next);
      }
      last = nodes_.size();
    }
  }

 private:
  void Expand(int index) {
    monitor_.CountNode();
    const Node node = Nth(nodes_, index);
    graph_.Landings(node.state, &landings_);
    const double each = graph_.reach().least_cost();
    for (int k = 0; k < graph_.size(); ++k) {
      const Foothold& X_WF = Nth(landings_, k);
      if (!graph_.Fits(node.state, k)) continue;
      if (!graph_.looks_up_heights() && !graph_.IsLevel(X_WF.height)) continue;
      const double cost = node.cost + graph_.cost(k);
      if (graph_.IsGoal(node.state, X_WF)) {
        if (cost < monitor_.best_cost()) candidates_.push_back({cost, 0.0, index, k});
        continue;
      }
      if (!graph_.workspace().contains(X_WF.Planar().position())) continue;
      const StepsToGo left = to_go_(graph_.After(node.state, k, X_WF));
      if (!std::isfinite(left.guess)) continue;
      if (!(cost + each * left.bound < monitor_.best_cost())) continue;
      candidates_.push_back({cost + options_.weight * each * left.guess, left.guess, index, k});
    }
  }

  // Takes the element if it is free and the best plan is no better by now.
  void Take(const Candidate& candidate) {
    const int k = candidate.k;
    const StepState from = Nth(nodes_, candidate.node).state;
    const StepState after = graph_.After(from, k);
    if (!graph_.IsLevel(after.X_WS.height)) return;
    const double cost = Nth(nodes_, candidate.node).cost + graph_.cost(k);
    if (graph_.IsGoal(from, after.X_WS)) {
      if (cost < monitor_.best_cost() && graph_.DownIsFree(from, k)) Offer(candidate, cost);
      return;
    }
    const auto cell = options_.cells.KeyOf(after);
    const auto reached = reached_.find(cell);
    if (reached != reached_.end() && reached->second <= cost) return;
    const double left = graph_.reach().least_cost() * to_go_(after).bound;
    if (!(cost + left < monitor_.best_cost())) return;
    if (!graph_.DownIsFree(from, k) || !graph_.UpIsFree(from, k)) return;
    reached_[cell] = cost;
    nodes_.push_back({.state = after, .parent = candidate.node, .k = k, .cost = cost});
  }

  void Offer(const Candidate& last, double cost) {
    StepPlan plan{.start = {}, .ks = {last.k}, .cost = cost};
    for (int index = last.node; index >= 0; index = Nth(nodes_, index).parent) {
      const Node& node = Nth(nodes_, index);
      plan.start = node.state;
      if (node.k >= 0) plan.ks.push_back(node.k);
    }
    std::ranges::reverse(plan.ks);
    monitor_.Offer(std::move(plan));
  }

  const StepSearch::ToGo& to_go_;
  const BeamOptions& options_;
  StepGraph& graph_;
  PlanMonitor& monitor_;
  std::vector<Node> nodes_;
  std::vector<Candidate> candidates_;                  // a heap once a layer is expanded
  std::unordered_map<std::uint64_t, double> reached_;  // cells, and what they cost
  std::vector<Foothold> landings_;
};

}  // namespace

void SearchBeam(const std::vector<StepState>& starts, const StepSearch::ToGo& to_go,
                const BeamOptions& options, StepGraph* graph, PlanMonitor* monitor) {
  Beam(starts, to_go, options, graph, monitor).Run();
}

}  // namespace halfstep
