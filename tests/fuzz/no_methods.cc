// Names of methods, planners and programs for the readers of configs, without what they name.

#include "experiments/config/methods.h"
#include "planner/search/planner_registry.h"

namespace halfstep {

std::vector<std::string> MethodNames() {
  return {"dichotomy", "dichotomy/published", "halfstep/sqp", "halfstep/barrier"};
}

std::vector<std::string> PlannerNames() { return {"rrt", "astar", "bounding_box"}; }

std::string_view Name(ProgramKind kind) {
  return kind == ProgramKind::kFastest  ? "fastest"
         : kind == ProgramKind::kSmooth ? "smooth"
                                        : "safest";
}

}  // namespace halfstep
