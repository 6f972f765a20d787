// Names of methods, planners and programs for the readers of configs, without what they name.

#include "planner/search/planner_registry.h"
#include "smoothing/methods/smoother_registry.h"

namespace halfstep {

std::vector<std::string> SmootherNames() {
  return {"dichotomy", "dichotomy/published", "halfstep/sqp", "halfstep/barrier"};
}

std::vector<std::string> PlannerNames() { return {"rrt", "astar", "bounding_box"}; }

std::string_view Name(ProgramKind kind) {
  return kind == ProgramKind::kFastest  ? "fastest"
         : kind == ProgramKind::kSmooth ? "smooth"
                                        : "safest";
}

}  // namespace halfstep
