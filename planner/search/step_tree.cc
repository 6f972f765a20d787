#include "planner/search/step_tree.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "wpg/elementary.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

/// Blocked elements that one sample may try [count]. More: the tree clings to walls; fewer: it
/// needs more samples to find the way round.
constexpr int kTriesPerSample = 8;
/// A sample without a yaw that is farther than this is approached face forward [m].
constexpr double kFaceForwardBeyond = 0.6;

}  // namespace

StepTree::StepTree(const TreeTarget& target, const PoseCells& cells, StepGraph* graph,
                   PlanMonitor* monitor, TimedEdges* edges)
    : target_(target),
      cells_(cells),
      graph_(*graph),
      monitor_(*monitor),
      edges_(edges),
      buckets_(graph->workspace()) {}

bool StepTree::Hits(const StepState& from, int k, const Foothold& X_WF) const {
  if (!target_.state) return graph_.IsGoal(from, X_WF);
  return target_.state->support != from.support && target_.state->X_WS.height == X_WF.height &&
         target_.state->form == graph_.After(from, k, X_WF).form &&
         StateDistance(X_WF.Planar(), target_.state->X_WS.Planar(), true) <= target_.near;
}

double StepTree::LeastCostFrom(const StepState& state) const {
  const double each = graph_.reach().least_cost();
  if (!target_.state) return each * graph_.LeastSteps(state);
  const double left =
      (state.X_WS.Planar().position() - target_.state->X_WS.Planar().position()).norm() -
      target_.near;
  return each * std::max(1.0, graph_.reach().Steps(left, 0.0));
}

void StepTree::Arrive(int index, int k, double cost, const TimedEdge& edge) {
  arrival_ = {.start = {}, .ks = {k}, .cost = cost, .timed = {edge}};
  for (; index >= 0; index = Nth(nodes_, index).parent) {
    const Node& node = Nth(nodes_, index);
    arrival_.start = node.state;
    if (node.k < 0) continue;
    arrival_.ks.push_back(node.k);
    arrival_.timed.push_back(node.edge);
  }
  std::ranges::reverse(arrival_.ks);
  std::ranges::reverse(arrival_.timed);
  if (edges_ == nullptr) arrival_.timed.clear();
}

// In time, states that may be kept until different times are not the same.
std::uint64_t StepTree::KeyOf(const StepState& state, const TimedEdge& edge) const {
  if (edges_ == nullptr) return cells_.KeyOf(state);
  constexpr double kSameEnd = 0.25, kLate = 1e6;  // [s]
  const auto end = static_cast<std::uint64_t>(std::min(edge.to.rest.end, kLate) / kSameEnd);
  return cells_.KeyOf(state) ^ (end + 1) * 0x9e3779b97f4a7c15u;
}

StepTree::Edge StepTree::Try(int index, int k, const Foothold& X_WF) {
  Node& node = Nth(nodes_, index);
  if (Nth(node.tried, k)) return Edge::kUseless;
  Nth(node.tried, k) = true;
  --node.untried;
  if (!graph_.Bears(X_WF)) return Edge::kUseless;
  if (edges_ != nullptr) return TryInTime(index, k, X_WF);
  const StepState from = node.state, after = graph_.After(from, k, X_WF);
  const double cost = node.cost + graph_.cost(k);
  if (Hits(from, k, X_WF)) {
    if (cost >= target_.cost_limit) return Edge::kUseless;
    if (!graph_.DownIsFree(from, k)) return Edge::kBlocked;
    if (target_.state && !graph_.UpIsFree(from, k)) return Edge::kBlocked;
    Arrive(index, k, cost);
    return Edge::kArrived;
  }
  if (!graph_.workspace().contains(X_WF.Planar().position()) ||
      reached_.contains(cells_.KeyOf(after)) || cost + LeastCostFrom(after) >= target_.cost_limit) {
    return Edge::kUseless;
  }
  if (!graph_.DownIsFree(from, k) || !graph_.UpIsFree(from, k)) return Edge::kBlocked;
  return Add(after, index, k, cost) == Growth::kArrived ? Edge::kArrived : Edge::kAdded;
}

StepTree::Edge StepTree::TryInTime(int index, int k, const Foothold& X_WF) {
  const TimedState from = {Nth(nodes_, index).state, Nth(nodes_, index).edge.to.since,
                           Nth(nodes_, index).edge.to.rest};
  const bool hits = Hits(from.state, k, X_WF);
  const StepState after = graph_.After(from.state, k, X_WF);
  const double least =
      Nth(nodes_, index).cost + graph_.cost(k) + (hits ? 0.0 : LeastCostFrom(after));
  if (least >= target_.cost_limit) return Edge::kUseless;
  if (hits && !target_.state) {
    const auto edge = edges_->Land(from, k);
    if (!edge) return Edge::kBlocked;
    const double cost = edges_->CostOfLanding(*edge);
    if (cost >= target_.cost_limit) return Edge::kUseless;
    Arrive(index, k, cost, *edge);
    return Edge::kArrived;
  }
  // Of a state that may be kept for good, the cell's own key is reached as well.
  if (!hits && (!graph_.workspace().contains(X_WF.Planar().position()) ||
                reached_.contains(cells_.KeyOf(after)))) {
    return Edge::kUseless;
  }
  const double to_go = hits ? 0.0 : LeastCostFrom(after);
  const std::vector<TimedEdge> edges =
      edges_->Take(from, k, edges_->TimeOf(target_.cost_limit - to_go));
  Edge grown = edges.empty() ? Edge::kBlocked : Edge::kUseless;
  for (const TimedEdge& edge : edges) {
    const double cost = edges_->CostOf(edge.to);
    if (hits) {
      if (cost >= target_.cost_limit) continue;
      Arrive(index, k, cost, edge);
      return Edge::kArrived;
    }
    if (cost + LeastCostFrom(edge.to.state) >= target_.cost_limit) continue;
    const Growth growth = Add(edge.to.state, index, k, cost, edge);
    if (growth == Growth::kArrived) return Edge::kArrived;
    if (growth == Growth::kAdded) grown = Edge::kAdded;
  }
  return grown;
}

StepTree::Growth StepTree::AddRoot(const StepState& root, double cost) {
  return Add(root, -1, -1, cost);
}

StepTree::Growth StepTree::AddRoot(const TimedState& root) {
  TimedEdge edge;
  edge.to = root;
  return Add(root.state, -1, -1, edges_->CostOf(root), edge);
}

StepTree::Growth StepTree::Add(const StepState& state, int parent, int k, double cost,
                               const TimedEdge& edge) {
  if (!reached_.insert(KeyOf(state, edge)).second) return Growth::kTrapped;
  if (std::isinf(edge.to.rest.end)) reached_.insert(cells_.KeyOf(state));
  std::vector<bool> tried(static_cast<size_t>(graph_.size()), false);
  int untried = 0;
  for (int of = 0; of < graph_.size(); ++of) {
    tried[static_cast<size_t>(of)] = !graph_.Fits(state, of);
    untried += graph_.Fits(state, of) ? 1 : 0;
  }
  const int index = static_cast<int>(nodes_.size());
  nodes_.push_back({state, parent, k, cost, untried, std::move(tried), edge});
  buckets_.Insert(index, state);
  monitor_.CountNode();
  return LookForTarget(index);
}

// Without the height, and for little: false only where Hits() is false.
bool StepTree::MayHit(const Foothold& X_WF) const {
  if (!target_.state) return true;
  constexpr double kRounding = 1e-9;  // [m]
  const Foothold& at = target_.state->X_WS;
  return std::fabs(X_WF.x - at.x) <= target_.near + kRounding &&
         std::fabs(X_WF.y - at.y) <= target_.near + kRounding;
}

// Elements of a new node that land on the target. `landings_` may be in use by the caller.
StepTree::Growth StepTree::LookForTarget(int index) {
  const StepState from = Nth(nodes_, index).state;
  const bool near =
      target_.state
          ? (from.X_WS.Planar().position() - target_.state->X_WS.Planar().position()).norm() <=
                graph_.reach().one() + target_.near
          : graph_.LeastSteps(from) <= 1;
  if (!near) return Growth::kAdded;
  graph_.Landings(from, &near_target_);
  for (int k = 0; k < graph_.size(); ++k) {
    if (!MayHit(Nth(near_target_, k))) continue;
    const Foothold X_WF = graph_.Settled(from, Nth(near_target_, k));
    if (Hits(from, k, X_WF) && Try(index, k, X_WF) == Edge::kArrived) return Growth::kArrived;
  }
  return Growth::kAdded;
}

StepTree::Growth StepTree::Grow(const TreeSample& sample) {
  const bool counts = sample.yaw == TreeSample::Yaw::kCounts;
  const int index = buckets_.FindNearest(sample.X_WF, Opposite(sample.side), counts);
  if (index < 0) return Growth::kNothingLeft;
  const StepState from = Nth(nodes_, index).state;
  Pose2 wanted = sample.X_WF;
  const Eigen::Vector2d way = wanted.position() - from.X_WS.Planar().position();
  const bool face_forward = !counts && way.norm() > kFaceForwardBeyond;
  if (face_forward) wanted.yaw = Atan2(way.y(), way.x());
  const bool with_yaw = face_forward || sample.yaw != TreeSample::Yaw::kFree;

  graph_.Landings(from, &landings_);
  // The nearest first, as many as are tried; among equals in the order of elements.
  order_.clear();
  const std::vector<bool>& tried = Nth(nodes_, index).tried;
  for (size_t k = 0; k < landings_.size(); ++k) {
    if (tried[k]) continue;
    const double distance = StateDistance(landings_[k].Planar(), wanted, with_yaw);
    order_.emplace_back(distance, static_cast<int>(k));
  }
  const std::greater<> farther;
  std::ranges::make_heap(order_, farther);
  Growth growth = Growth::kTrapped;
  for (int blocked = 0; growth == Growth::kTrapped && blocked < kTriesPerSample;) {
    if (order_.empty()) break;
    const int k = order_.front().second;
    std::ranges::pop_heap(order_, farther);
    order_.pop_back();
    switch (Try(index, k, graph_.Settled(from, Nth(landings_, k)))) {
      case Edge::kUseless:
        break;
      case Edge::kBlocked:
        ++blocked;
        break;
      case Edge::kAdded:
        growth = Growth::kAdded;
        break;
      case Edge::kArrived:
        growth = Growth::kArrived;
        break;
    }
  }
  if (Nth(nodes_, index).untried == 0) buckets_.Remove(index, from);
  if (growth == Growth::kTrapped) monitor_.CountSample();
  return growth;
}

}  // namespace halfstep
