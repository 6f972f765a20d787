#pragma once

#include <vector>

#include "smoothing/margins/margin_evaluator.h"
#include "smoothing/walk/superposed_walk.h"

namespace halfstep {

/// A demand that a walk misses: of one pair of bodies, one body, or the worst subject of a family.
struct MissedDemand {
  Margin worst;      ///< the least margin that was seen
  int instants = 0;  ///< at how many of the instants that were looked at it is missed
};

/// What a walk misses, worst first (MarginLimits::Slack).
struct MissedDemands {
  std::vector<MissedDemand> demands;  ///< worst first
  int instants = 0;                   ///< that were looked at
};

/// Looks at some hundred instants of a walk, at most 20 ms apart unless it is longer than that
/// takes, and around the worst ones. Each margin told is truly missed at its instant; a demand that
/// is missed between instants only may be left out, unless it is that of `witness`, a violation
/// that is known already. A tenth of a second for a robot of 30 bodies.
MissedDemands FindMissedDemands(const MarginEvaluator& evaluator, const SuperposedWalk& walk,
                                const Margin& witness);

}  // namespace halfstep
