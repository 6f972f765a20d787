#pragma once

#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/run/infeasible_plan.h"
#include "experiments/tables/result_tables.h"
#include "smoothing/methods/walk_problem.h"

namespace halfstep {

/// Where the files of a run are.
struct RunPlaces {
  std::string folder;       ///< or the files' names
  std::string not_covered;  ///< what has every thing that is not covered
};

/// What `halfstep run` prints: one row for each method, what limits the overlaps of each, and what
/// the certificates do not cover.
std::string RunTable(const Experiment& experiment, const WalkProblem& problem,
                     const std::vector<MethodRun>& runs, const RunPlaces& places);

/// The same as one JSON object, with what is told of walks that are not feasible.
std::string RunJson(const Experiment& experiment, const WalkProblem& problem,
                    const std::vector<MethodRun>& runs,
                    const std::vector<InfeasibleWalk>& infeasible, const std::string& folder);

}  // namespace halfstep
