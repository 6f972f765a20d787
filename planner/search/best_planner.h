#pragma once

#include <vector>

#include "planner/search/footstep_planner.h"
#include "planner/search/footstep_rrt.h"
#include "planner/search/pose_cells.h"

namespace halfstep {

/// Finds a plan, and then better ones until it is told to stop. Random trees, which soon find some
/// way, take turns with weighted A*; what improves a plan are beams along it, along other trees and
/// from nowhere, short-cuts, and A*, which knows when nothing is better. Turns grow from round to
/// round, and A* goes on where its turn ended. Guesses are those of LeastCost and, where half-steps
/// are called free by volumes, of a StandMap. In time the same searches but beams are those in
/// time, and others wait until all is at rest.
class BestPlanner : public FootstepPlanner {
 public:
  /// Of the random trees, and the cells of A*.
  BestPlanner(const RrtOptions& rrt, const PoseCells& cells) : rrt_(rrt), cells_(cells) {}
  PlanResult Plan(const PlanRequest& request, std::mt19937_64& random) const override;
  bool knows_time() const override { return true; }

 private:
  RrtOptions rrt_;
  PoseCells cells_;
};

}  // namespace halfstep
