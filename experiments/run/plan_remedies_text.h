#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "smoothing/methods/walk_problem.h"
#include "smoothing/proof/missed_demands.h"

namespace halfstep {

/// FindRemedies in words: a sentence on each that was found, with the key to set, on each footstep
/// for which nothing was, and whether the first of each footstep makes the whole plan feasible.
/// Keys are those of `experiment.config`, whose plan `problem` holds.
std::vector<std::string> PlanRemediesText(const Experiment& experiment, const WalkProblem& problem,
                                          const MissedDemands& missed, const std::stop_token& stop);

}  // namespace halfstep
