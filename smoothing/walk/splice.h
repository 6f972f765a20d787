#pragma once

#include <vector>

#include "smoothing/walk/homotopy_parameters.h"
#include "smoothing/walk/parameter_table.h"
#include "smoothing/walk/superposed_walk.h"
#include "wpg/motion/half_step_sequence.h"

namespace halfstep {

/// A walk as data: its half-steps, and a point of their homotopy.
struct WalkPlan {
  HalfStepSequence sequence;      ///< placed in W
  HomotopyParameters parameters;  ///< of that sequence

  /// The walk as a function of time.
  SuperposedWalk Walk() const { return {sequence, parameters}; }
};

/// The number m of half-steps that two walks have in common from the beginning: half-steps 0 … m −
/// 1 have the same kind, place, shape, T, η and start in both, to the bit.
int CommonHalfSteps(const SuperposedWalk& a, const SuperposedWalk& b);

/// A time up to which two walks are equal to the bit [s]: when the first half-step that they do not
/// have in common begins in one of them. +∞ for equal walks. Source: smoothing/README.md,
/// "Successors".
double AgreeUntil(const SuperposedWalk& a, const SuperposedWalk& b);

/// Where the feet stand, by Index(Side), when half-step `last` has ended; the swing foot of an up
/// half-step stands where it will land as planned.
std::array<Foothold, 2> StanceAfter(const HalfStepSequence& sequence, int last);
/// Half-steps `begin` … `end` − 1 by themselves, as they are planned: steps, from rest to rest.
/// Precondition: both are even, 0 ≤ begin < end ≤ n.
HalfStepSequence PlannedPart(const HalfStepSequence& sequence, int begin, int end);

/// The walk in which half-step `last` + 1 begins at `begin` [s], and everything after it as much
/// later. It agrees with `walk` until the earlier of both beginnings. Throws std::logic_error
/// unless there is a half-step after `last`, and `begin` lies no further before or behind its end
/// than an overlap or a rest may be long.
WalkPlan Delayed(const WalkPlan& walk, int last, double begin);

/// The walk that takes `footsteps` after half-step `last`, without overlaps from there on; it
/// agrees with `walk` until half-step `last` + 1 begins in one of them. When `last` is an up
/// half-step, the first footstep is the landing of the foot that it lifts, with the step's via
/// height; its duration is that of the new down half-step. Throws std::logic_error when there are
/// no footsteps after an up half-step, or the first is not of the foot that was lifted.
WalkPlan Changed(const WalkPlan& walk, int last, const std::vector<Footstep>& footsteps);

/// The parameters, of every family, of everything that has begun when half-steps 0 … `last` have,
/// at their values. With them fixed, a method finds successors.
std::vector<FixedParameter> FixedByBeginning(const WalkPlan& walk, int last);

}  // namespace halfstep
