#pragma once

#include "smoothing/walk/parameter_families.h"

namespace halfstep {

struct HomotopyParameters;

/// The traits of the families that move footsteps: footstep_x, footstep_y, footstep_yaw. Called by
/// Traits().
const ParameterFamilyTraits& FootstepTraits(ParameterFamily family);

/// How far each footstep is moved, X_FM seen from where it is planned (n/2); empty: none is.
std::vector<Pose2> MovesOfFootsteps(const HomotopyParameters& parameters);

/// The sequence with its footsteps where the parameters have them.
HalfStepSequence WithFootsteps(const HalfStepSequence& sequence,
                               const HomotopyParameters& parameters);

}  // namespace halfstep
