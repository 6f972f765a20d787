#pragma once

#include "experiments/verify/certificate_text.h"
#include "experiments/verify/described_walk.h"
#include "experiments/verify/distances.h"
#include "experiments/verify/findings.h"

namespace halfstep::verify {

/// Whether the rows of a certificate say what the walk of half_steps.csv does: the margin of a
/// row's subject at the interval's midpoint, and that the subject leaves it by no more than `bound`
/// at both ends and at the quarters in between. The walk is evaluated there itself, so nothing
/// depends on how far apart the rows of trajectory.csv are.
void CheckClaims(const DescribedWalk& walk, const CertificateText& certificate,
                 const std::vector<ClaimRow>& rows, Distances* distances, Findings* findings);

}  // namespace halfstep::verify
