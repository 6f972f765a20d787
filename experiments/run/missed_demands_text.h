#pragma once

#include <string>
#include <vector>

#include "smoothing/proof/missed_demands.h"

namespace halfstep {

/// What a motion misses and what may help, a sentence each: the worst demand first, then up to nine
/// more with how many there are, then a remedy for each family that is among them.
std::vector<std::string> MissedDemandsText(const MarginEvaluator& evaluator,
                                           const MissedDemands& missed);

}  // namespace halfstep
