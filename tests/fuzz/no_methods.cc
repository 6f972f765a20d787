// Names of methods, planners and programs for the readers of configs, without what they name.

#include "planner/search/planner_registry.h"
#include "smoothing/margins/own_margin.h"
#include "smoothing/methods/smoother_registry.h"
#include "smoothing/program/walk_cost.h"

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

const std::vector<std::unique_ptr<const OwnStatement>>& OwnMargins() {
  static const std::vector<std::unique_ptr<const OwnStatement>> none;
  return none;
}

const std::vector<std::shared_ptr<const WalkCost>>& WalkCosts() {
  static const std::vector<std::shared_ptr<const WalkCost>> none;
  return none;
}

}  // namespace halfstep
