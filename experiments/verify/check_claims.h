#pragma once

#include "experiments/verify/certificate_text.h"
#include "experiments/verify/described_walk.h"
#include "experiments/verify/distances.h"
#include "experiments/verify/findings.h"

namespace halfstep::verify {

/// Whether the rows of a certificate are true of the walk of half_steps.csv: at the interval's
/// midpoint a row's subject has the row's margin (a distance is at least that), and at the
/// interval's ends it has fallen below this by no more than `bound`; all but distances are looked
/// at in the quarters as well. The walk itself is evaluated at these instants, so nothing depends
/// on how far apart the rows of trajectory.csv are.
void CheckClaims(const DescribedWalk& walk, const CertificateText& certificate,
                 const std::vector<ClaimRow>& rows, Distances* distances, Findings* findings);

}  // namespace halfstep::verify
