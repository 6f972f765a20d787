#pragma once

#include "smoothing/walk/parameter_families.h"

namespace halfstep {

/// The traits of the families that give half-steps forms of their own: kViaLateral, kFootRamp,
/// kFootDelay, kLiftShare. None of them changes natural bounds, times of landing or the ZMP.
/// Source: smoothing/README.md, "Forms".
const ParameterFamilyTraits& FormTraits(ParameterFamily family);

}  // namespace halfstep
