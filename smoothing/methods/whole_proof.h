#pragma once

#include "smoothing/methods/smoothing_monitor.h"
#include "smoothing/methods/walk_problem.h"

namespace halfstep {

/// Whether the walk of `parameters` is proved for all its time in one go. Proofs of what a search
/// changes are made where that is; what comes later in the walk is at another time then, where
/// rounding differs. Its work is not counted.
bool HoldsWhole(const WalkProblem& problem, const HomotopyParameters& parameters,
                SmoothingMonitor& monitor);

/// Makes `before`, which cost `cost`, the incumbent again unless the present one is the same or
/// holds as a whole.
void KeepWhatHolds(const WalkProblem& problem, const AcceptedWalk& before, double cost,
                   SmoothingMonitor& monitor);

}  // namespace halfstep
