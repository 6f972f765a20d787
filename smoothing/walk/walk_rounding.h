#pragma once

#include "smoothing/walk/superposed_walk.h"

namespace halfstep {

/// How far rounding may carry walk.At(at) from the exact walk of the same footsteps and parameters:
/// value, first and second. Times are taken to be off by as much as knots and ends of intervals can
/// be, so it holds of what is exact within that of the instant. Source: smoothing/README.md,
/// "Rounding", 2.
WalkJet RoundingAt(const SuperposedWalk& walk, const LocalTime& at);

/// How far the local times of half-steps that are under way there may be from the exact ones, ends
/// of intervals and knots included [s].
double LocalTimeRounding(const SuperposedWalk& walk, const LocalTime& at);

/// How far absolute times in a half-step may be from the exact ones [s].
double TimeRounding(const SuperposedWalk& walk, int half_step);

}  // namespace halfstep
