#pragma once

#include "planner/search/step_graph.h"

namespace halfstep {

/// A lower bound of what a walk from a state to the goal costs, by the cheapest way of going a
/// metre and of turning a radian that two footsteps of the set have. Where costs differ from
/// element to element it is far above the number of footsteps times the least cost.
///
/// With c_i the cost of an element and d_ik how far two footsteps i, k lead at most, let ρ be the
/// least (c_i + c_k) / d_ik and e the largest |x_i| − c_i / ρ, or 0. Footsteps taken two by two
/// lead no farther than their cost over ρ, and one that is left over at most e farther than that.
/// So to go d costs at least ρ (d − e).
class LeastCost {
 public:
  /// The graph is borrowed; `set` is what its elements are of.
  LeastCost(const StepSet& set, const StepGraph& graph);

  /// Of any walk from a state to the goal.
  double From(const StepState& state) const;
  /// ρ: of a metre [cost/m]; 0 where elements lead nowhere.
  double per_metre() const { return per_metre_; }

 private:
  const StepGraph& graph_;
  double per_metre_ = 0.0;   // ρ
  double extra_ = 0.0;       // e [m]
  double per_radian_ = 0.0;  // least cost of a radian of turn
};

}  // namespace halfstep
