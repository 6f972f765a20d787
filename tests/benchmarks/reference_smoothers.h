#pragma once

#include "smoothing/methods/methods.h"

namespace halfstep {

/// Adds the methods `coordinate` (CoordinateAscent) and `reference` (ReferenceSearch, from the
/// walks of `dichotomy/uniform` and `coordinate` where heights or durations move), as a program
/// adds methods of its own. They know overlaps, heights and durations alone, and take these
/// families and their effort from `smoothing.optimizer`.
void AddReferenceSmoothers(Methods* methods);

}  // namespace halfstep
