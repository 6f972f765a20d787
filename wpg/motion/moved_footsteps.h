#pragma once

#include <vector>

#include "wpg/motion/half_step_sequence.h"

namespace halfstep {

/// The footsteps on which a half-step stands, counted by the steps that lead to them; −1: the sole
/// stands where the walk starts.
struct HalfStepFootsteps {
  int support = -1;  ///< of the support foot
  int swing = -1;    ///< where an up half-step leaves the floor, and a down half-step lands
};

/// Those of each half-step of a sequence (n).
std::vector<HalfStepFootsteps> FootstepsOf(const HalfStepSequence& sequence);

/// The sequence in which footstep j stands at X_WF·moves[j], X_WF where it was, at the same height.
/// A half-step that stands on no moved footstep stays to the bit. Precondition: as many moves as
/// steps (std::logic_error).
HalfStepSequence WithFootstepsMoved(const HalfStepSequence& sequence,
                                    const std::vector<Pose2>& moves);

}  // namespace halfstep
