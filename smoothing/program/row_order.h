#pragma once

#include <vector>

#include "smoothing/margins/margin.h"

namespace halfstep {

/// Families of margins that have rows of their own in the overlap program, in the order of the rows
/// of a half-step or instant.
const std::vector<MarginFamily>& RowFamilies();

/// The place among RowFamilies() of a family, or of the one whose row it shares; −1: it has none.
int RowOf(MarginFamily family);

}  // namespace halfstep
