#pragma once

#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/tables/result_tables.h"
#include "smoothing/methods/walk_problem.h"

namespace halfstep {

/// What `halfstep run` prints: one row for each method, then what limits the overlaps of each.
std::string RunTable(const Experiment& experiment, const WalkProblem& problem,
                     const std::vector<MethodRun>& runs, const std::string& folder);

/// The same as one JSON object.
std::string RunJson(const MarginEvaluator& evaluator, const std::vector<MethodRun>& runs,
                    const std::string& folder);

}  // namespace halfstep
