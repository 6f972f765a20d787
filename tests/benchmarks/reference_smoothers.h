#pragma once

namespace halfstep {

/// Makes the methods `coordinate` (CoordinateAscent) and `reference` (ReferenceSearch, from the
/// walks of `dichotomy/uniform` and `coordinate` where heights or durations move) known by their
/// names, as a program registers methods of its own. They know overlaps, heights and durations
/// alone, and take these families and their deadline from SmootherOptions::optimizer. Call it as
/// RegisterSmoother() is to be called.
void RegisterReferenceSmoothers();

}  // namespace halfstep
