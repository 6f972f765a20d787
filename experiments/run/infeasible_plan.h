#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "experiments/run/experiment_run.h"

namespace halfstep {

/// Why the plan of a run is not feasible and what would help, a line each, to be told under a
/// heading: MissedDemandsText, PlanRemedies, and that `smoothing.repair_plan` may do it. Empty
/// where the run was stopped before it was known. Trying remedies ends with `stop`.
std::vector<std::string> InfeasiblePlanText(const ExperimentRun& run, const std::stop_token& stop);

}  // namespace halfstep
