#include "planner/search/planners.h"

namespace halfstep {

Planners Planners::Standard() {
  const auto astar = [](FootstepAStar::Elements elements) {
    return [elements](const Scene&, const PlannerOptions& options) {
      return std::make_unique<FootstepAStar>(elements, options.astar);
    };
  };
  return Planners(
      {{"best", "a way by random trees and A*, then better ones until the work is used",
        [](const Scene&, const PlannerOptions& options) {
          return std::make_unique<BestPlanner>(options.rrt, options.astar.cells);
        }},
       {"rrt", "random tree over all half-steps, then short-cuts",
        [](const Scene&, const PlannerOptions& options) {
          return std::make_unique<FootstepRrt>(options.rrt);
        }},
       {"astar", "weighted A* over all half-steps, anytime", astar(FootstepAStar::Elements::kAll)},
       {"astar/classic", "the same over 14 classic ones", astar(FootstepAStar::Elements::kClassic)},
       {"bounding_box", "a box around the robot finds the way: a baseline",
        [](const Scene& scene, const PlannerOptions& options) {
          return std::make_unique<BoundingBoxPlanner>(scene, options.bounding_box);
        }}});
}

}  // namespace halfstep
