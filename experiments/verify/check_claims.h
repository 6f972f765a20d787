#pragma once

#include "experiments/verify/certificate_text.h"
#include "experiments/verify/distances.h"
#include "experiments/verify/findings.h"
#include "experiments/verify/played_motion.h"

namespace halfstep::verify {

/// Whether the rows of a certificate say what the trajectory shows: the margin of a row's subject
/// at the interval's midpoint, and that the subject leaves it by no more than `bound` at any row of
/// the trajectory inside. At the midpoint the trajectory interpolates, so margins agree within
/// `tolerance` only ([m], [rad]; speeds: see the source file).
void CheckClaims(const PlayedMotion& motion, const CertificateText& certificate,
                 const std::vector<ClaimRow>& rows, double tolerance, Distances* distances,
                 Findings* findings);

}  // namespace halfstep::verify
