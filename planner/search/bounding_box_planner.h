#pragma once

#include "planner/search/box_path.h"
#include "planner/search/footstep_planner.h"
#include "planner/search/step_search.h"

namespace halfstep {

struct BoundingBoxOptions {
  RobotBox box;
  BoxGrid grid;
  /// How far from the path, as StateDistance, the footsteps may stray [m] > 0.
  double corridor = 0.3;
  StepSearchOptions steps = {.weights = {2.0}, .cells = {.position = 0.03, .yaw = 0.1}};
};

/// The way of the literature, a baseline: a box around the whole robot finds a way that touches
/// nothing, then footsteps follow it. It steps over nothing, so it never leaves a ring of cable.
/// Its footsteps are free by the query like any other's; the path ends its search, without
/// improvement. Takes nothing from `random`.
class BoundingBoxPlanner : public FootstepPlanner {
 public:
  /// Borrows the scene, which must outlive this and be the query's.
  BoundingBoxPlanner(const Scene& scene, const BoundingBoxOptions& options)
      : options_(options), world_(scene, options.box) {}
  PlanResult Plan(const PlanRequest& request, std::mt19937_64& random) const override;

 private:
  BoundingBoxOptions options_;
  BoxWorld world_;
};

}  // namespace halfstep
