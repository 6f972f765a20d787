#pragma once

#include <string>

#include "experiments/run/planning.h"

namespace halfstep {

/// Text of swept_volumes.json of a run folder, for pictures: the swept volumes by which the planner
/// called each half-step of its plan free, as cells. Cells are merged 2×2×2 as long as there are
/// too many (`cell_m` against `baked_cell_m`), outwards: what is drawn contains the volume.
/// `volumes` are seen from a left support: `size` cells along x, y, z from `lower` [cells], and
/// `runs`, the lengths of runs of free and occupied cells in turn, z fastest, x slowest.
/// `half_steps` has an entry a half-step of the walk: index of its volume, whether it is the mirror
/// image (on a right support), X_WS [m, rad]; null for the first, which is in no set. On levels
/// `volume` is of all bodies but the feet, `feet` are those of the foot that swings and of the one
/// that stands, and `z_m` is the support sole's height. Precondition: solved, with volumes;
/// `sequence` is the plan's.
std::string PlanVolumesJson(const PlannedWalk& walk, const HalfStepSequence& sequence);

}  // namespace halfstep
