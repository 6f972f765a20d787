#pragma once

#include <string>

#include "smoothing/walk/homotopy_parameters.h"

namespace halfstep {

/// Why no walk of the sequence has these parameters, as CheckParameters() says, with the values
/// that are valid: "overlaps[0]: 1.9 s (valid: at most 0.94 s …)", indices from 0. "": one has.
std::string ComplaintAbout(const HalfStepSequence& sequence, const HomotopyParameters& parameters);

}  // namespace halfstep
