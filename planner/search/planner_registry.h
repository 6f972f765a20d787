#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "planner/search/bounding_box_planner.h"
#include "planner/search/footstep_astar.h"
#include "planner/search/footstep_planner.h"
#include "planner/search/footstep_rrt.h"

namespace halfstep {

/// The options of all planners; each takes its own.
struct PlannerOptions {
  RrtOptions rrt;                   ///< of `rrt`
  StepSearchOptions astar;          ///< of astar and astar/classic
  BoundingBoxOptions bounding_box;  ///< of `bounding_box`
};

/// Names of all planners: rrt, astar, astar/classic, bounding_box, and those that were registered.
std::vector<std::string> PlannerNames();

/// The planner of that name, one of PlannerNames() (std::logic_error). The scene is borrowed and
/// must outlive it: bounding_box looks at it, the others ask the query only.
std::unique_ptr<FootstepPlanner> MakePlanner(const std::string& name, const Scene& scene,
                                             const PlannerOptions& options = {});

/// Makes a planner. The scene is borrowed and must outlive it.
using PlannerFactory =
    std::function<std::unique_ptr<FootstepPlanner>(const Scene&, const PlannerOptions&)>;
/// Makes a planner of one's own known by a name, in place of an earlier one of that name, so that
/// `planner.name` of a config may name it. Throws std::invalid_argument for the name of a planner
/// that is built in. Before configs are read that name it, and not while another thread plans.
void RegisterPlanner(const std::string& name, PlannerFactory make);

}  // namespace halfstep
