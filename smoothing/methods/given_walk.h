#pragma once

#include <optional>

#include "smoothing/methods/method_options.h"
#include "smoothing/methods/smoothing_monitor.h"
#include "smoothing/methods/smoothing_result.h"
#include "smoothing/methods/walk_problem.h"
#include "smoothing/walk/homotopy_parameters.h"

namespace halfstep {

/// The walk of the method `given`; none: the one that the problem starts from. No keys: configs
/// name files, which only a run can read.
inline OptionGroup<std::optional<HomotopyParameters>> GivenWalkGroup() { return {"given", ""}; }

/// The method that searches nothing: the walk of `given`, checked by the problem's test like any
/// other's; without it, the walk that the problem starts from. Ends as kConverged when it is
/// feasible, and as kFailed, with the margin that it misses, when it is not; the result's
/// parameters are those given in either case. Precondition: `given` passes CheckParameters().
SmoothingResult TakeGivenWalk(const WalkProblem& problem,
                              const std::optional<HomotopyParameters>& given,
                              SmoothingMonitor& monitor);

}  // namespace halfstep
