#pragma once

#include "experiments/verify/described_walk.h"
#include "experiments/verify/findings.h"

namespace halfstep::verify {

/// Whether the rows of trajectory.csv are the walk at instants `period` [s] apart from 0 on, and at
/// `end` [s], up to which it was executed: CoM, its derivatives, ZMP, waist, soles, joint angles,
/// support and half-step. So the played motion starts, ends and lands where the walk does. Both are
/// in closed form, so they must agree to rounding.
void CheckRowsOnWalk(const std::vector<PlayedRow>& rows, const DescribedWalk& walk, double period,
                     double end, Findings* findings);

}  // namespace halfstep::verify
