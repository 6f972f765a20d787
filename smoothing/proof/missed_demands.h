#pragma once

#include <vector>

#include "smoothing/margins/margin_evaluator.h"
#include "smoothing/walk/superposed_walk.h"

namespace halfstep {

/// A demand that a walk misses: of one pair of bodies, one body, or the worst subject of a family.
struct MissedDemand {
  /// The least margin that was seen; of instants that are equally bad but for rounding, the first.
  Margin worst;
  int instants = 0;  ///< at how many of the instants that were looked at it is missed
  /// The footstep to blame, from 0: the one under way at that instant. Of a foot that stands, it is
  /// the one that put the foot there, or −1 where the foot has stood there since the start.
  int footstep = 0;
  bool stands = false;  ///< whether the demand is missed by a foot because of where it stands
};

/// What a walk misses: legs that do not reach first, since there is no motion then, and the rest by
/// MarginLimits::Slack, worst first. Of slacks that differ by less than a thousandth the earliest
/// is first.
struct MissedDemands {
  std::vector<MissedDemand> demands;  ///< worst first
  int instants = 0;                   ///< that were looked at
};

/// Looks at some hundred instants of a walk, at most 20 ms apart unless it is longer than that
/// takes, and around the worst ones; and every 5 ms, as the rows of trajectory.csv are, for what
/// was not seen at those. Each margin told is truly missed at its instant; a demand that is missed
/// between instants only may be left out, unless it is that of `witness`, a violation that is known
/// already. Some tenths of a second for a robot of 30 bodies.
MissedDemands FindMissedDemands(const MarginEvaluator& evaluator, const SuperposedWalk& walk,
                                const Margin& witness);

}  // namespace halfstep
