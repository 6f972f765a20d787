#pragma once

#include "smoothing/methods/method_options.h"

namespace halfstep {

/// Options of `halfstep/horizon`: the search of `halfstep/sqp` in windows along the walk and never
/// over the whole, so that time and memory grow linearly with the walk, but among obstacles that
/// move, where all that comes later is looked at again. Its program is not `safest`, whose least
/// slack belongs to the whole walk. Source: smoothing/README.md, "Windows".
struct HorizonOptions {
  int window = 12;  ///< half-steps that are moved together; even, ≥ 2
  int step = 8;     ///< half-steps by which the next window lies further on; even, 2 … window
  int passes = 6;   ///< ≥ 1: over the whole walk at most; they end when nothing is gained
};

/// `smoothing.horizon`: window, step and passes; the rest is of `smoothing.optimizer`.
OptionGroup<HorizonOptions> HorizonGroup();
/// Declares its keys.
void DeclareFields(Fields& fields, HorizonOptions* options);

}  // namespace halfstep
