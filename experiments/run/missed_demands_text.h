#pragma once

#include <string>
#include <vector>

#include "smoothing/proof/missed_demands.h"
#include "wpg/motion/half_step_sequence.h"

namespace halfstep {

/// What a motion along `sequence` misses and what may help, a line each: ten demands, or the
/// worst of each family where these are more, the worst first ("footstep 1 (right), half-step up,
/// at 1.48 s: RLEG_LINK5 is 2.2 mm inside bar; 5.0 mm demanded (at 2 of 301 instants)"), then how
/// many there are besides, then a remedy for each family that is among them.
std::vector<std::string> MissedDemandsText(const MarginEvaluator& evaluator,
                                           const HalfStepSequence& sequence,
                                           const MissedDemands& missed);

}  // namespace halfstep
