#pragma once

#include <cstdint>
#include <optional>
#include <unordered_set>
#include <utility>
#include <vector>

#include "planner/search/plan_search.h"
#include "planner/search/pose_cells.h"
#include "planner/search/state_buckets.h"
#include "wpg/geometry/foothold.h"

namespace halfstep {

/// What a tree grows towards: the goal of its graph, or the neighbourhood of a state.
struct TreeTarget {
  std::optional<StepState> state = {};  ///< none: the goal
  double near = 0.08;  ///< how near counts as reached, by StateDistance with yaw [m]
  double cost_limit = std::numeric_limits<double>::infinity();  ///< costlier paths are useless
};

/// Where a tree shall grow to: a foot `side` near X_WF.
struct TreeSample {
  /// Whether the sample's yaw counts for what is near to it.
  enum class Yaw {
    kCounts,
    kCountsWhenNear,  ///< counts when the foot is near; facing the sample counts when it is far
    kFree,            ///< does not count; facing the sample counts when the foot is far
  };
  Pose2 X_WF;               ///< where the foot shall land, about, seen from above
  Side side = Side::kLeft;  ///< the foot that lands
  Yaw yaw = Yaw::kCounts;   ///< of X_WF
};

/// A tree of states over free edges. Every node tries each of its elements once, in the order in
/// which samples ask for them, and grows no further after the last.
class StepTree {
 public:
  /// `graph` and `monitor` are borrowed, and in time `edges`; null: not in time.
  StepTree(const TreeTarget& target, const PoseCells& cells, StepGraph* graph, PlanMonitor* monitor,
           TimedEdges* edges = nullptr);

  /// What became of a sample: a node, none from that node, none from any node, or the target.
  enum class Growth { kAdded, kTrapped, kNothingLeft, kArrived };

  /// `cost` is that of getting to the root.
  Growth AddRoot(const StepState& root, double cost);
  /// The same in time.
  Growth AddRoot(const TimedState& root);
  /// Lets the node nearest to the sample land as near to it as it can. kNothingLeft: no node can
  /// step with that foot any more.
  Growth Grow(const TreeSample& sample);
  /// Whether no node can step any more.
  bool IsExhausted() const {
    return buckets_.size(Side::kLeft) == 0 && buckets_.size(Side::kRight) == 0;
  }

  /// After kArrived: from the root to the target. Its last edge has a free up half-step if the
  /// target is a state.
  const StepPlan& arrival() const { return arrival_; }

 private:
  struct Node {
    StepState state;
    int parent;
    int k;
    double cost;
    int untried;
    std::vector<bool> tried;
    TimedEdge edge;  // in time: how it was reached, and when
  };
  enum class Edge { kUseless, kBlocked, kAdded, kArrived };

  bool Hits(const StepState& from, int k, const Foothold& X_WF) const;
  bool MayHit(const Foothold& X_WF) const;
  double LeastCostFrom(const StepState& state) const;
  Edge Try(int index, int k, const Foothold& X_WF);
  Edge TryInTime(int index, int k, const Foothold& X_WF);
  std::uint64_t KeyOf(const StepState& state, const TimedEdge& edge) const;
  Growth Add(const StepState& state, int parent, int k, double cost, const TimedEdge& edge = {});
  Growth LookForTarget(int index);
  void Arrive(int index, int k, double cost, const TimedEdge& edge = {});

  TreeTarget target_;
  PoseCells cells_;
  StepGraph& graph_;
  PlanMonitor& monitor_;
  TimedEdges* edges_;
  std::vector<Node> nodes_;
  StateBuckets buckets_;
  std::unordered_set<std::uint64_t> reached_;
  StepPlan arrival_;
  std::vector<Foothold> landings_, near_target_;
  std::vector<std::pair<double, int>> order_;  // a heap of distance and element
};

}  // namespace halfstep
