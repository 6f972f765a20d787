#pragma once

#include "smoothing/walk/parameter_families.h"

namespace halfstep {

/// The traits of the families that give half-steps forms of their own: kViaLateral, kViaAlong,
/// kFootRamp, kFootDelay, kLiftShare, kZmpShift, kZmpBumpRamp. The ZMP's shift moves natural bounds
/// and the times of lift-off and landing; the others do not.
/// Source: smoothing/README.md, "Forms".
const ParameterFamilyTraits& FormTraits(ParameterFamily family);

}  // namespace halfstep
