#pragma once

#include "smoothing/walk/homotopy_parameters.h"

namespace halfstep {

/// How far each footstep is moved, X_FM seen from where it is planned (n/2); empty: none is.
std::vector<Pose2> MovesOfFootsteps(const HomotopyParameters& parameters);

/// The sequence with its footsteps where the parameters have them.
HalfStepSequence WithFootsteps(const HalfStepSequence& sequence,
                               const HomotopyParameters& parameters);

}  // namespace halfstep
