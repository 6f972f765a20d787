#pragma once

#include <string>

#include "experiments/verify/certificate_text.h"
#include "experiments/verify/described_walk.h"

namespace halfstep::verify {

/// What is wrong with a row about how long ZMPs go from foot to foot, which names a half-step from
/// 0, or −1: none; "": nothing. Precondition: a row of that family.
std::string FaultOfShift(const DescribedWalk& walk, const ClaimRow& row, int half_step);

}  // namespace halfstep::verify
