#pragma once

#include <string>

#include "experiments/verify/certificate_text.h"
#include "experiments/verify/described_walk.h"
#include "experiments/verify/findings.h"

namespace halfstep::verify {

/// What is wrong with a row about how long ZMPs go from foot to foot, which names a half-step from
/// 0, or −1: none; "": nothing. Precondition: a row of that family.
std::string FaultOfShift(const DescribedWalk& walk, const ClaimRow& row, int half_step);

/// Whether the ZMP of each half-step goes from foot to foot for as long as demanded, and both feet
/// stand as long from each landing to the next lift-off. Nothing is said where nothing is demanded.
void CheckDoubleSupport(const DescribedWalk& walk, const CertificateText& certificate,
                        Findings* findings);

}  // namespace halfstep::verify
