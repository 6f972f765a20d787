#include "planner/search/step_search.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <tuple>
#include <unordered_map>

#include "wpg/nth.h"

namespace halfstep {
namespace {

// Intervals of rest in one cell that end by no more than this apart count as the same [s].
constexpr double kSameEnd = 0.25;

}  // namespace

// The search with one weight.
class StepSearch::Weighted {
 public:
  Weighted(const StepSearch& of, double weight)
      : starts_(of.starts_),
        to_go_(of.to_go_),
        weight_(weight),
        cells_(of.options_.cells),
        graph_(of.graph_),
        monitor_(of.monitor_),
        edges_(of.edges_),
        best_at_first_(of.monitor_.best_cost()) {}

  enum class End { kStopped, kFound, kExhausted };

  double weight() const { return weight_; }

  End Run() {
    for (; started_ < starts_.size(); ++started_) {
      if (monitor_.Stop()) return End::kStopped;
      Begin(starts_[started_]);
    }
    while (!open_.empty()) {
      if (monitor_.Stop()) return End::kStopped;
      const Waiting next = open_.top();
      open_.pop();
      if (next.found >= 0) {
        if (Follow(next.node, Nth(found_, next.found))) return End::kFound;
        continue;
      }
      const int k = static_cast<int>(Nth(Nth(nodes_, next.node).order, next.rank));
      Enqueue(next.node, next.rank + 1);
      if (Ask(next, k)) return End::kFound;
    }
    return End::kExhausted;
  }

 private:
  // A state whose outgoing elements wait in `order`, the most promising first. Not in time it is
  // reached at 0 and may be kept for good.
  struct Node {
    TimedEdge edge;  // how it was reached
    int parent = -1;
    int k = -1;  // element that led here
    double cost = 0.0;
    std::vector<std::uint32_t> order;
  };

  // The next element of a node to ask about, or an edge that was found free and is dearer than it.
  struct Waiting {
    double key = 0.0;    // cost so far + weight · guess
    double guess = 0.0;  // among equals the one nearer to the goal
    int node = 0;
    int rank = 0;                                 // in its order
    int found = -1;                               // which of the edges; −1: not asked about
    bool operator<(const Waiting& other) const {  // the top of the queue is the largest
      return std::tie(key, guess, node, rank, found) >
             std::tie(other.key, other.guess, other.node, other.rank, other.found);
    }
  };

  struct Promise {
    double key, guess;
    bool wanted;
  };
  // An edge that is free.
  struct Found {
    int k;
    TimedEdge edge;
    double cost;  // of getting to its end
    bool lands;   // on the goal
  };
  // Of a state.
  struct Reached {
    double rest_ends, cost;
  };

  void Begin(const StepState& start) {
    Node node;
    node.edge.to.state = start;
    node.cost = graph_.StartCost(start);
    if (edges_ != nullptr) {
      const auto at = edges_->Start(start);
      if (!at) return;
      node.edge.to = *at;
      node.cost = edges_->CostOf(*at);
    }
    Expand(std::move(node));
  }

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
  Promise Promises(const Node& node, int k, const Foothold& X_WF) const {
    const StepState& from = node.edge.to.state;
    return PromiseOf(graph_.After(from, k, X_WF), node.cost + graph_.cost(k),
                     graph_.IsGoal(from, X_WF));
  }

  // Whether a state in the same cell was reached that serves as well.
  bool IsReached(const StepState& state, double rest_ends, double cost) const {
    const bool first_counts = edges_ == nullptr || weight_ > 1.0;
    const auto [first, last] = reached_.equal_range(cells_.KeyOf(state));
    return std::any_of(first, last, [&](const auto& other) {
      return other.second.rest_ends >= rest_ends - kSameEnd &&
             (first_counts || other.second.cost <= cost);
    });
  }

  // Orders the elements of a new node.
  void Expand(Node node) {
    const StepState from = node.edge.to.state;
    const double rest_ends = node.edge.to.rest.end;
    if (IsReached(from, rest_ends, node.cost)) return;
    reached_.emplace(cells_.KeyOf(from), Reached{rest_ends, node.cost});
    monitor_.CountNode();
    graph_.Landings(from, &landings_);
    promises_.clear();
    for (int k = 0; k < graph_.size(); ++k) {
      const Foothold& X_WF = Nth(landings_, k);
      const bool may_bear =
          graph_.Fits(from, k) && (graph_.looks_up_heights() || graph_.IsLevel(X_WF.height));
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
    Node& node = Nth(nodes_, index);
    for (; rank < static_cast<int>(node.order.size()); ++rank) {
      const int k = static_cast<int>(Nth(node.order, rank));
      const Foothold X_WF = graph_.Landing(node.edge.to.state, k);
      if (!graph_.IsLevel(X_WF.height)) continue;
      const Promise promise = Promises(node, k, X_WF);
      open_.push({promise.key, promise.guess, index, rank});
      return;
    }
    node.order = {};
  }

  // Takes element k if it is free; whether that ended in a plan. An edge that rests waits for its
  // turn.
  bool Ask(const Waiting& asked, int k) {
    const Node& node = Nth(nodes_, asked.node);
    const TimedState from = node.edge.to;
    const StepState after = graph_.After(from.state, k);
    const double least = node.cost + graph_.cost(k);
    const bool lands = graph_.IsGoal(from.state, after.X_WS);
    // The best plan is better than when the element was put in order.
    if (monitor_.best_cost() < best_at_first_ && !PromiseOf(after, least, lands).wanted) {
      return false;
    }
    if (lands) {
      const auto edge = Land(from, k);
      return edge && Keep(asked, {k, *edge, CostOf(*edge, least, true), true});
    }
    if (IsReached(after, TimeInterval{}.end, least)) return false;
    for (const TimedEdge& edge : Take(from, k, after)) {
      if (Keep(asked, {k, edge, CostOf(edge, least, false), false})) return true;
    }
    return false;
  }

  std::optional<TimedEdge> Land(const TimedState& from, int k) {
    if (edges_ != nullptr) return edges_->Land(from, k);
    if (!graph_.DownIsFree(from.state, k)) return std::nullopt;
    return TimedEdge{};
  }
  std::vector<TimedEdge> Take(const TimedState& from, int k, const StepState& after) {
    if (edges_ != nullptr) {
      const double to_go = graph_.reach().least_cost() * to_go_(after).bound;
      return edges_->Take(from, k, edges_->TimeOf(monitor_.best_cost() - to_go));
    }
    if (!graph_.DownIsFree(from.state, k) || !graph_.UpIsFree(from.state, k)) return {};
    TimedEdge edge;
    edge.to.state = after;
    return {edge};
  }
  double CostOf(const TimedEdge& edge, double least, bool lands) const {
    if (edges_ == nullptr) return least;
    return lands ? edges_->CostOfLanding(edge) : edges_->CostOf(edge.to);
  }

  // Of an edge that is free.
  bool Keep(const Waiting& asked, const Found& found) {
    const TimedState& to = found.edge.to;
    const Promise promise = PromiseOf(to.state, found.cost, found.lands);
    if (!promise.wanted) return false;
    if (promise.key <= asked.key) return Follow(asked.node, found);
    if (!found.lands && IsReached(to.state, to.rest.end, found.cost)) return false;
    open_.push(
        {promise.key, promise.guess, asked.node, asked.rank, static_cast<int>(found_.size())});
    found_.push_back(found);
    return false;
  }

  // Whether the edge ended in a plan.
  bool Follow(int index, const Found& found) {
    if (found.lands) return monitor_.Offer(PlanTo(index, found));
    Expand({.edge = found.edge, .parent = index, .k = found.k, .cost = found.cost, .order = {}});
    return false;
  }

  StepPlan PlanTo(int index, const Found& last) const {
    StepPlan plan{.start = {}, .ks = {last.k}, .cost = last.cost, .timed = {last.edge}};
    for (; index >= 0; index = Nth(nodes_, index).parent) {
      const Node& node = Nth(nodes_, index);
      plan.start = node.edge.to.state;
      if (node.k < 0) continue;
      plan.ks.push_back(node.k);
      plan.timed.push_back(node.edge);
    }
    std::ranges::reverse(plan.ks);
    std::ranges::reverse(plan.timed);
    if (edges_ == nullptr) plan.timed.clear();
    return plan;
  }

  const std::vector<StepState>& starts_;
  const ToGo& to_go_;
  double weight_;
  PoseCells cells_;
  StepGraph& graph_;
  PlanMonitor& monitor_;
  TimedEdges* edges_;
  double best_at_first_;  // cost of the best plan when the search began
  size_t started_ = 0;    // of the starts
  std::vector<Node> nodes_;
  std::vector<Found> found_;
  std::priority_queue<Waiting> open_;
  std::unordered_multimap<std::uint64_t, Reached> reached_;
  std::vector<Foothold> landings_;
  std::vector<Promise> promises_;
};

StepSearch::StepSearch(const std::vector<StepState>& starts, ToGo to_go, StepSearchOptions options,
                       StepGraph* graph, PlanMonitor* monitor, TimedEdges* edges)
    : starts_(starts),
      to_go_(std::move(to_go)),
      options_(std::move(options)),
      graph_(*graph),
      monitor_(*monitor),
      edges_(edges) {}

StepSearch::~StepSearch() = default;

bool StepSearch::Run() {
  std::vector<double>& weights = options_.weights;
  while (search_ || next_ < weights.size()) {
    if (!search_) search_ = std::make_unique<Weighted>(*this, weights[next_++]);
    const Weighted::End end = search_->Run();
    if (end == Weighted::End::kStopped) return false;
    const bool exhausted = end == Weighted::End::kExhausted;
    // In time an earlier arrival may have been left out with a weight above 1.
    const bool left_out = exhausted && edges_ != nullptr && search_->weight() > 1.0;
    search_.reset();
    if (exhausted && !left_out) {
      next_ = weights.size();
      return true;
    }
    if (left_out && next_ == weights.size()) weights.push_back(1.0);
    if (monitor_.Stop()) return false;
  }
  return true;
}

}  // namespace halfstep
