#pragma once

#include "smoothing/walk/homotopy_parameters.h"
#include "wpg/motion/half_step_sequence.h"

namespace halfstep {

/// The parameters `at`, but those of the half-steps first … last, and of the junctions between
/// them, are as those of the same foot a stride earlier, where there are such; durations are the
/// same fractions of the planned ones. Footsteps stay. A place where a search may begin when steps
/// are alike: nothing is proved of it, and overlaps may exceed their natural bounds.
HomotopyParameters RepeatSteps(const HalfStepSequence& sequence, const HomotopyParameters& at,
                               int first, int last);

}  // namespace halfstep
