#pragma once

#include "planner/search/box_path.h"
#include "planner/search/footstep_planner.h"
#include "planner/search/step_search.h"

namespace halfstep {

/// Options of the planner that looks for a path of a box first.
struct BoundingBoxOptions {
  RobotBox box;  ///< what stands for the robot
  BoxGrid grid;  ///< where it is checked
  /// How far from the path, as StateDistance, the footsteps may stray [m] > 0.
  double corridor = 0.3;
  /// Of the search for footsteps along the path.
  StepSearchOptions steps = {.weights = {2.0}, .cells = {.position = 0.03, .yaw = 0.1}};
};

/// A baseline from the literature: plans a collision-free path for a box around the whole robot,
/// then footsteps along it. It never steps over anything, so it cannot leave a ring of cable. Its
/// footsteps are checked by the query like those of any planner; its first plan is not improved.
/// Does not use `random`.
class BoundingBoxPlanner : public FootstepPlanner {
 public:
  /// Borrows the scene, which must outlive this and be the query's.
  BoundingBoxPlanner(const Scene& scene, const BoundingBoxOptions& options)
      : options_(options), world_(scene, options.box) {}
  PlanResult Plan(const PlanRequest& request, std::mt19937_64& random) const override;
  bool knows_levels() const override { return false; }

 private:
  BoundingBoxOptions options_;
  BoxWorld world_;
};

}  // namespace halfstep
