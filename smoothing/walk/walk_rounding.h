#pragma once

#include "smoothing/walk/superposed_walk.h"

namespace halfstep {

/// How far rounding may carry walk.At(at) from the exact walk of the same footsteps and parameters:
/// value, first and second. Times are taken to be off by as much as knots and ends of intervals can
/// be, so it holds of what is exact within that of the instant. Source: smoothing/README.md,
/// "Rounding", 2.
WalkJet RoundingAt(const SuperposedWalk& walk, const LocalTime& at);

/// What half-steps that begin or end within rounding of the interval's ends, and are not under way
/// in its middle, may add to SecondBounds there. The ZMP's second derivative jumps; of that, what
/// its first one may change by, over half the interval.
WalkState SecondRounding(const SuperposedWalk& walk, double begin, double end);

/// How far the local times of half-steps that are under way there may be from the exact ones, ends
/// of intervals and knots included [s].
double LocalTimeRounding(const SuperposedWalk& walk, const LocalTime& at);

/// How far absolute times in a half-step may be from the exact ones [s].
double TimeRounding(const SuperposedWalk& walk, int half_step);

}  // namespace halfstep
