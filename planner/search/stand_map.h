#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/search/step_graph.h"

namespace halfstep {

/// How far it is from places of the workspace to the goal, around what stands in between: a guess
/// for searches. A place counts as free where some foot with some of 8 yaws lands on it in a
/// half-step of the set that is free; from one free place to another it goes straight as far as
/// footsteps lead. It knows nothing of what a foot steps over in between, nor of turning.
class StandMap {
 public:
  /// Asks the graph's query, at most 32 times a place. `set` is what its elements are of. The map
  /// has at most `places` places. Where they stand, both soles of `starts` are at one height.
  StandMap(const StepSet& set, const StepState& start, int places, StepGraph* graph);

  /// The way from a point of W to the goal [m]; ∞: none was found.
  double Way(const Eigen::Vector2d& p_W) const;

 private:
  Eigen::Vector2d PlaceOf(int cell) const;
  void FindFree(const StepSet& set, const StepState& start, StepGraph* graph);
  // The places that are free at a height of the waist.
  void AddFree(const StepSet& set, const StepState& start, int form, StepGraph* graph);
  void FindWays(const StepGraph& graph);

  Eigen::Vector2d origin_;
  double spacing_ = 0.0;
  Eigen::Vector2i count_ = {0, 0};
  std::vector<bool> free_;
  std::vector<double> ways_;
};

}  // namespace halfstep
