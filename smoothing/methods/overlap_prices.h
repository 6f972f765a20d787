#pragma once

#include <vector>

#include "smoothing/margins/margin_evaluator.h"
#include "smoothing/methods/smoothing_result.h"
#include "smoothing/program/overlap_program.h"
#include "smoothing/walk/superposed_walk.h"

namespace halfstep {

/// Fills `price` of every junction that a margin limits: the derivative of that margin with respect
/// to the junction's overlap, at the instant and in the walk given, says how much longer the
/// overlap, and shorter the walk, would be if one unit of the family's scale less were demanded (1
/// cm of clearance, 0.1 m/s of foot speed …). To first order, the other overlaps as they are.
/// Source: smoothing/README.md, "What an overlap costs".
void AddPrices(const SuperposedWalk& walk, const MarginEvaluator& evaluator,
               std::vector<JunctionResult>* junctions);

/// Fills `multiplier` of every junction that a margin limits: the program's multipliers at
/// `parameters`, by our own estimate whatever the solver, of the rows of that family in the
/// half-steps on both sides. Rows nearly active count. It is not a number where it is not
/// determined: within the bounds of the variables none of these rows changes, to first order, by as
/// much as counts as nearly active, or the multipliers promise more time than the walk lasts.
/// Returns the multiplications that it took, for Work::linear_algebra.
long AddMultipliers(const OverlapProgram& program, const HomotopyParameters& parameters,
                    std::vector<JunctionResult>* junctions);

}  // namespace halfstep
