#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "planner/search/best_planner.h"
#include "planner/search/bounding_box_planner.h"
#include "planner/search/footstep_astar.h"
#include "planner/search/footstep_planner.h"
#include "planner/search/footstep_rrt.h"

namespace halfstep {

/// The options of all planners; each takes its own.
struct PlannerOptions {
  RrtOptions rrt;                   ///< of `rrt`, and of the trees of `best`
  StepSearchOptions astar;          ///< of astar and astar/classic; the cells of `best`
  BoundingBoxOptions bounding_box;  ///< of `bounding_box`
};

/// Makes a planner. The scene is borrowed and must outlive it.
using PlannerFactory =
    std::function<std::unique_ptr<FootstepPlanner>(const Scene&, const PlannerOptions&)>;

/// A planner by its name.
struct NamedPlanner {
  std::string name;     ///< as `planner.name` of a config has it
  std::string meaning;  ///< one line, for `halfstep list planners`
  PlannerFactory make;  ///< what makes it
};

/// The planners that a config may name. A value: a program takes Standard(), adds its own, and
/// hands it to what reads configs.
class Planners {
 public:
  /// best, rrt, astar, astar/classic, bounding_box.
  static Planners Standard();
  /// These are built in: Add() replaces none of them.
  explicit Planners(std::vector<NamedPlanner> built_in);

  /// Adds a planner of one's own, in place of an earlier one of that name. Throws
  /// std::invalid_argument for the name of a planner that is built in.
  void Add(NamedPlanner planner);

  /// All planners, those that were added last.
  const std::vector<NamedPlanner>& all() const& { return all_; }
  const std::vector<NamedPlanner>& all() const&& = delete;  // `for` would dangle
  std::vector<std::string> Names() const;                   ///< in the same order
  /// The planner of that name, one of Names() (std::logic_error). The scene is borrowed and must
  /// outlive it: bounding_box looks at it, the others ask the query only.
  std::unique_ptr<FootstepPlanner> Make(const std::string& name, const Scene& scene,
                                        const PlannerOptions& options = {}) const;

 private:
  std::vector<NamedPlanner> all_;
  size_t built_in_;  // so many of them
};

}  // namespace halfstep
