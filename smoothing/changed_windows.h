#pragma once

#include <vector>

#include "smoothing/feasibility_test.h"
#include "smoothing/superposed_walk.h"

namespace halfstep {

/// The stretches of absolute time of `walk`, in order and disjoint, outside of which it is the walk
/// of the same sequence at `from`, only earlier or later: [t_i, t_i + T_i] where T_i or the step's
/// height differs, [t_i, t_{i+1} + T_{i+1}] where Δ_i does. Whatever holds of the one walk's
/// postures and rates for all t holds of the other's outside of them. Source: smoothing/README.md,
/// "The incumbent".
std::vector<TimeWindow> ChangedWindows(const HomotopyParameters& from, const SuperposedWalk& walk);

}  // namespace halfstep
