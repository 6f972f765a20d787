#pragma once

#include <array>

#include "experiments/verify/certificate_text.h"
#include "experiments/verify/described_walk.h"
#include "experiments/verify/distances.h"
#include "experiments/verify/findings.h"

namespace halfstep::verify {

/// Margins of a walk at one instant by verify's own formulas: ZMP, joint, joint speed, foot speed,
/// clearance and self clearance, as in the last six columns of trajectory.csv. Distances are cut
/// off at `cap` [m].
std::array<double, kNumMarginColumns> MarginsAt(const DescribedWalk& walk, const PlayedRow& row,
                                                const CertificateText& certificate, double cap,
                                                Distances* distances);

/// Whether the margin columns of trajectory.csv are what they say, within Tolerances: of a column,
/// of joint speeds, of dynamics, and for distances of slabs.
void CheckMarginColumns(const std::vector<PlayedRow>& rows, const DescribedWalk& walk,
                        const CertificateText& certificate, Distances* distances,
                        Findings* findings);

}  // namespace halfstep::verify
