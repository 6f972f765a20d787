#include "halfstep/planner/search/planner_registry.h"

#include "halfstep/wpg/check.h"

namespace halfstep {

std::vector<std::string> PlannerNames() {
  return {"rrt", "astar", "astar/classic", "bounding_box"};
}

std::unique_ptr<FootstepPlanner> MakePlanner(const std::string& name, const Scene& scene,
                                             const PlannerOptions& options) {
  if (name == "rrt") return std::make_unique<FootstepRrt>(options.rrt);
  if (name == "astar") {
    return std::make_unique<FootstepAStar>(FootstepAStar::Elements::kAll, options.astar);
  }
  if (name == "astar/classic") {
    return std::make_unique<FootstepAStar>(FootstepAStar::Elements::kClassic, options.astar);
  }
  HALFSTEP_CHECK(name == "bounding_box", "no planner " << name);
  return std::make_unique<BoundingBoxPlanner>(scene, options.bounding_box);
}

}  // namespace halfstep
