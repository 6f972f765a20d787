#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "smoothing/methods/walk_problem.h"
#include "smoothing/proof/missed_demands.h"

namespace halfstep {

/// What makes a plan feasible that misses demands, found by trying: the height of the via point,
/// the duration of the half-steps, and where a footstep lands along its way. For the footsteps that
/// miss most (three at most) each of them is moved away from the planned one until the half-steps
/// that it concerns are feasible by the problem's test; height and duration together where neither
/// helps alone. Where several footsteps miss a demand, height and duration of all of them are tried
/// as well. A sentence on each that was found, with the key to set, on each footstep for which
/// nothing was, and whether the first of each footstep makes the whole plan feasible. Keys are
/// those of `experiment.config`, whose plan `problem` holds. Among obstacles that move nothing is
/// tried, since no step can be looked at by itself.
std::vector<std::string> PlanRemedies(const Experiment& experiment, const WalkProblem& problem,
                                      const MissedDemands& missed, const std::stop_token& stop);

}  // namespace halfstep
